// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/window/unitmenu.h"

#include "ui/common/icons.h"

#include <QAction>
#include <QActionGroup>
#include <QMenu>
#include <QSettings>

#include <algorithm>
#include <array>

namespace dynascope {

namespace {

const QString AngleKey = QStringLiteral("window/angleUnit");
const QString TorqueKey = QStringLiteral("window/torqueForCurrent");

struct AngleName {
    const char *name; ///< in the settings
    UnitPreferences units;
};

UnitPreferences rawNumbers()
{
    UnitPreferences units;
    units.raw = true;
    return units;
}

const std::array<AngleName, 5> &angleNames()
{
    static const std::array<AngleName, 5> names{{{"degrees", AngleUnit::Degrees},
                                                 {"radians", AngleUnit::Radians},
                                                 {"turns", AngleUnit::Turns},
                                                 {"pulses", AngleUnit::Pulses},
                                                 {"raw", rawNumbers()}}};
    return names;
}

bool isSameAngle(const UnitPreferences &one, const UnitPreferences &other)
{
    return one.raw == other.raw && one.angle == other.angle;
}

} // namespace

UnitPreferences savedUnits()
{
    const QSettings settings;
    const QString name = settings.value(AngleKey).toString();
    const auto *const known = std::ranges::find_if(
        angleNames(), [&name](const AngleName &angle) { return name == QLatin1String(angle.name); });
    UnitPreferences units = known == angleNames().end() ? UnitPreferences() : known->units;
    units.torque = settings.value(TorqueKey, false).toBool();
    return units;
}

void saveUnits(const UnitPreferences &units)
{
    QSettings settings;
    const auto *const known = std::ranges::find_if(
        angleNames(), [&units](const AngleName &angle) { return isSameAngle(angle.units, units); });
    if (known != angleNames().end())
        settings.setValue(AngleKey, QString::fromLatin1(known->name));
    settings.setValue(TorqueKey, units.torque);
}

UnitMenu::UnitMenu(QMenu &parentMenu, QObject *parent) : QObject(parent), m_units(savedUnits())
{
    QMenu *menu = parentMenu.addMenu(icon(QStringLiteral("units")), tr("&Units"));
    menu->setObjectName(QStringLiteral("unitMenu"));
    menu->setToolTipsVisible(true);
    auto *angles = new QActionGroup(this);
    const std::array<std::pair<QString, QString>, 5> texts{
        {{tr("&Degrees"), tr("Positions as 180.00 °")},
         {tr("&Radians"), tr("Positions as 3.142 rad")},
         {tr("&Turns"), tr("Positions as 0.5000 turn")},
         {tr("&Pulses"), tr("Positions in the encoder's own steps, everything else in its unit")},
         {tr("Ra&w numbers"), tr("Everything as it stands in the register; names of modes and bits stay")}}};
    for (std::size_t i = 0; i < texts.size(); ++i) {
        const AngleName &angle = angleNames()[i];
        QAction *action = menu->addAction(texts[i].first);
        action->setObjectName(QStringLiteral("unit-%1").arg(QLatin1String(angle.name)));
        action->setToolTip(texts[i].second);
        action->setCheckable(true);
        angles->addAction(action);
        m_angles.push_back({angle.units, action});
        connect(action, &QAction::triggered, this, [this, units = angle.units] {
            UnitPreferences next = units;
            next.torque = m_units.torque;
            choose(next);
        });
    }
    menu->addSeparator();
    m_torque = menu->addAction(tr("Currents as tor&que"));
    m_torque->setObjectName(QStringLiteral("unit-torque"));
    m_torque->setToolTip(tr("Nm instead of mA, where the manufacturer states the torque constant of the model"));
    m_torque->setCheckable(true);
    connect(m_torque, &QAction::triggered, this, [this](bool on) {
        UnitPreferences next = m_units;
        next.torque = on;
        choose(next);
    });
    tick();
}

void UnitMenu::choose(const UnitPreferences &units)
{
    m_units = units;
    saveUnits(units);
    tick();
    emit chosen(units);
}

void UnitMenu::tick()
{
    for (const Angle &angle : m_angles)
        angle.action->setChecked(isSameAngle(angle.units, m_units));
    m_torque->setChecked(m_units.torque);
    m_torque->setEnabled(!m_units.raw);
}

} // namespace dynascope
