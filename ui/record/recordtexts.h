// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>

#include <chrono>

namespace dynascope {

struct RecorderStatus;

QString sizeText(qint64 bytes);                 ///< "0.3 MB", "1234.5 MB", "20.1 GB"
QString lengthText(std::chrono::seconds length); ///< "0:02:07"
/// What a recording that has ended came to: "Recorded 12 345 samples in 0:02:07, 1.2 MB: /home/…".
QString endText(const RecorderStatus &status, std::chrono::seconds length);

} // namespace dynascope
