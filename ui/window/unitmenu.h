// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/table/units.h"

#include <QObject>

class QAction;
class QMenu;

namespace dynascope {

/// What a person chose last; degrees and currents where nobody did.
UnitPreferences savedUnits();
void saveUnits(const UnitPreferences &units);

/// The menu in which units are chosen, once for everything the window shows. Remembers the choice.
class UnitMenu : public QObject
{
    Q_OBJECT

public:
    /// Adds itself to `menu`, which outlives it.
    explicit UnitMenu(QMenu &menu, QObject *parent = nullptr);

signals:
    void chosen(const dynascope::UnitPreferences &units);

private:
    void choose(const UnitPreferences &units);
    void tick();

    struct Angle {
        UnitPreferences units;
        QAction *action = nullptr;
    };
    UnitPreferences m_units;
    std::vector<Angle> m_angles;
    QAction *m_torque = nullptr;
};

} // namespace dynascope
