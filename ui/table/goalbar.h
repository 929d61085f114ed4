// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/table/goalslider.h"

#include <QFrame>

namespace dynascope {

/// The registers that set the goal in this Operating Mode, the main one first; empty where there is none.
std::vector<int> goalFields(const Device &device);

/// The goals that the present Operating Mode uses, each with its slider. Keeps its place while torque is off, so that
/// nothing jumps at STOP.
class GoalBar : public QFrame
{
    Q_OBJECT

public:
    explicit GoalBar(GoalSlider::Writer writer, QWidget *parent = nullptr);

    /// Follows the first, writes to all. `whom` says whose goals they are where that isn't plain.
    void setDevices(const std::vector<Device *> &devices, const QString &whom = {});
    void setUnits(const UnitPreferences &units);

private:
    void choose();

    GoalSlider *m_first;
    GoalSlider *m_second;
    std::vector<QPointer<Device>> m_devices;
    std::vector<int> m_fields;
};

} // namespace dynascope
