// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/eventlog.h"
#include "ui/plot/tracedata.h"

#include <QPalette>
#include <QRectF>

#include <set>

class QPainter;

namespace dynascope {

/// What happened to the devices of a panel, as small marks along the upper edge of its plot. Told apart by shape as well
/// as by colour: restart ◆, alert !, torque ▲ on ▼ off, write ■.
struct PlotMarks {
    const EventLog *log = nullptr; ///< none: nothing is marked
    std::set<DeviceKey> devices;   ///< whose events are shown, and those of none

    static constexpr qreal Size = 9; ///< in pixels

    void paint(QPainter &painter, const TimeView &view, const QRectF &area, const QPalette &palette) const;
    /// What is marked at this place; empty where nothing is.
    QString textAt(const QPointF &at, const TimeView &view, const QRectF &area) const;

private:
    template <typename Visit>
    void each(const TimeView &view, const QRectF &area, Visit visit) const;
};

} // namespace dynascope
