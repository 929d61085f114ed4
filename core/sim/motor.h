// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QJsonObject>
#include <QString>
#include <QStringList>

#include <cstdint>

namespace dynascope::sim {

/// The electric motor with its gearbox, at the output shaft, as data sheets state it: a linear DC motor. Copper is
/// taken as cold: its resistance doesn't rise with the temperature, as no data sheet says at which its figures hold.
/// What a data sheet states is known; the rest is chosen, by the rules in motor.cpp.
struct MotorModel {
    enum Figure {
        Voltage, StallTorque, StallCurrent, FreeSpeed, GearRatio, StandbyCurrent, Mass, Inertia, Friction, Heat,
        OverloadCurrent,
        FigureCount
    };

    QString name;
    double voltage = 12.0;        ///< V, at which the figures hold
    double stallTorque = 0;       ///< N·m
    double stallCurrent = 0;      ///< A
    double freeSpeed = 0;         ///< rev/min
    double gearRatio = 1;
    double standbyCurrent = 0.04; ///< A, the electronics alone
    double mass = 0.08;           ///< kg
    double inertia = 0;           ///< kg·m², rotor and gears as felt at the shaft
    double coulomb = 0;           ///< N·m
    double viscous = 0;           ///< N·m·s/rad
    double windingHeat = 1;       ///< J/K
    double windingToCase = 1;     ///< K/W
    double caseHeat = 1;          ///< J/K
    double caseToAmbient = 1;     ///< K/W
    double overloadCurrent = 0;   ///< A: more than this for a while is an overload
    std::uint32_t known = 0;      ///< a bit for each Figure that a data sheet states

    bool isKnown(Figure figure) const { return (known >> figure) & 1U; }
    QStringList knownFigures() const; ///< "stall torque"...
    QStringList chosenFigures() const;

    double resistance() const { return voltage / stallCurrent; } ///< Ω
    /// N·m/A. The stall torque of the data sheet is what leaves the shaft, so it is already less the friction.
    double torqueConstant() const { return (stallTorque + coulomb) / stallCurrent; }
    double freeRadians() const { return freeSpeed * 0.10471975511965977; } ///< rad/s
    double freeCurrent() const { return (coulomb + viscous * freeRadians()) / torqueConstant(); } ///< A
    /// V·s/rad. More than the torque constant: the difference is what the gears lose under load.
    double backEmf() const { return (voltage - resistance() * freeCurrent()) / freeRadians(); }
};

/// A whole motor of the figures in one entry of resources/motors.json, which may be empty: what isn't there is chosen.
MotorModel motorFromFigures(const QString &name, const QJsonObject &figures);

/// The motor of a model, by the catalog's name ("XM430-W350", also with a suffix: "XM430-W350-T"); one that is in the
/// middle of the range where the model is unknown. Never null; lives as long as the program. The file is read when it
/// is first asked for. Any thread.
const MotorModel *findMotor(QStringView model);
const MotorModel &genericMotor();

} // namespace dynascope::sim
