// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/profilerun.h"

#include <QWidget>

class QCheckBox;
class QTreeWidget;
class QTreeWidgetItem;

namespace dynascope {

/// What applying a profile would write, in its order, and what may be done for it. Writes nothing.
class ProfilePlanPage : public QWidget
{
    Q_OBJECT

public:
    explicit ProfilePlanPage(QWidget *parent = nullptr);

    /// Plans for these joints; also after an option was changed.
    void show(const ProfileRun &run, const std::set<std::size_t> &joints);
    void setUnits(const UnitPreferences &units) { m_units = units; }

    const Result<ProfileRun::Planned> &planned() const { return m_planned; }
    ProfileApplyOptions options() const;
    bool moves() const;
    std::size_t writes() const { return m_writes; } ///< registers that differ
    QStringList underTorque() const;                ///< joints whose torque is in the way, and may not be turned off
    QStringList obstacles() const;                  ///< joints to which nothing can be written, and why

signals:
    void changed(); ///< an option

private:
    QCheckBox *addOption(const char *name, const QString &text, const QString &toolTip);
    void fill(const ProfileRun &run);
    void addMoves(const MovePlan &plan);
    void addJoint(const JointApply &joint, const JointComparison &comparison);
    void addWrites(QTreeWidgetItem &under, const JointApply &joint, const JointComparison &comparison);
    void addStep(QTreeWidgetItem &under, const QString &what, const QString &now, const QString &then,
                 const QString &where);

    QTreeWidget *m_steps;
    QCheckBox *m_move;
    QCheckBox *m_torqueOff;
    QCheckBox *m_torqueBack;
    std::set<std::size_t> m_joints;
    std::set<std::size_t> m_away; ///< joints at another baud rate
    Result<ProfileRun::Planned> m_planned = ProfileRun::Planned();
    UnitPreferences m_units;
    std::size_t m_writes = 0;
};

} // namespace dynascope
