// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/plot/axisscaler.h"
#include "ui/plot/tracedata.h"

#include <vector>

namespace dynascope {

/// A value axis for each unit among the traces. The first ones in sight get labels, one left and the others right.
class PlotScales
{
public:
    struct Scale {
        QString unit;
        AxisScaler scaler;
        bool isUsed = false;   ///< a visible trace has this unit
        bool isByHand = false; ///< a person chose its range: the data doesn't move it
    };

    /// Follows the traces' units; a unit keeps its range while it is hidden.
    void setTraces(std::span<const TraceData> traces);
    void setMostSteps(int most);
    /// Fits each axis that isn't by hand to what is in view.
    void fit(std::span<const TraceData> traces, const TimeView &view, LineTime now);
    void setByHand(bool byHand); ///< all; those that no longer are begin afresh
    bool isAnyByHand() const;
    /// By hand, also of a unit whose traces are yet to come.
    void setRange(const QString &unit, double minimum, double maximum);

    const AxisRange &range(const QString &unit) const;
    /// 0 left, from 1 on right; none where so many units are not in sight.
    const Scale *labelled(int side) const;
    std::vector<Scale *> of(int side); ///< labelled() there, or all: −1
    const std::vector<Scale> &scales() const { return m_scales; }

private:
    struct Waiting {
        QString unit;
        double minimum, maximum;
    };
    void takeWaiting(Scale &scale);

    std::vector<Scale> m_scales;
    std::vector<Waiting> m_waiting; ///< chosen, but there is no trace yet
};

} // namespace dynascope
