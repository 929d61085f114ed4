// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/plot/tracedata.h"

namespace dynascope {

using namespace std::chrono_literals;

inline constexpr QRgb Red = 0xFFFF0000;

inline TraceData traceOf(const History &history, const QString &unit = QStringLiteral("mA"))
{
    TraceData trace;
    trace.history = &history;
    trace.unit = unit;
    trace.color = QColor::fromRgb(Red);
    trace.field = QStringLiteral("servo");
    return trace;
}

inline TimeView secondsPerColumn(int columns, int first = 0)
{
    return {1s, first, columns, {}};
}

} // namespace dynascope
