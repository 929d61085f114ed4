// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/ratelimit_values.h"

#include <QString>

#include <chrono>

namespace dynascope {

QString hertzText(double hertz);                       ///< "812 Hz", "9.8 Hz", "0.11 Hz"
QString intervalText(std::chrono::milliseconds interval); ///< how often is wanted: "as often as possible", "10 Hz"

/// What takes time, a few words: "Return Delay Time of 3 devices".
QString limitName(const RateLimit &limit, int baudRate);
/// What it is, and what can be done about it.
QString limitHelp(const RateLimit &limit, int baudRate);
/// What its button says; empty where it has no remedy.
QString remedyText(const RateLimit &limit);
/// "812 → 1040 Hz"; empty where it has no remedy.
QString gainText(const RateLimit &limit, double now);

} // namespace dynascope
