// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/monitor.h"

#include <QMimeData>

#include <memory>
#include <vector>

namespace dynascope {

/// Fields dragged from the table to a plot.
inline constexpr auto WatchMimeType = "application/x-dynascope-watch";

std::unique_ptr<QMimeData> watchesToMime(const std::vector<Watch> &watches);
std::vector<Watch> watchesFromMime(const QMimeData *mime); ///< empty where it holds none, or is damaged

} // namespace dynascope
