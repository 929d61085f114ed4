// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QStringView>

namespace dynascope::sim {

/// The electric motor with its gearbox, at the output shaft, as data sheets state it: a linear DC motor. Copper is taken
/// as cold: resistance doesn't rise with the temperature, as the data sheets' figures don't say at which they hold.
struct MotorModel {
    QStringView name;

    // Known, from the data sheet at `voltage`.
    double voltage = 12.0;       ///< V
    double stallTorque = 4.1;    ///< N·m
    double stallCurrent = 2.3;   ///< A
    double freeSpeed = 46;       ///< rev/min
    double standbyCurrent = 0.04; ///< A, the electronics alone
    double mass = 0.082;         ///< kg

    // Chosen: no data sheet tells. See motor.cpp.
    double inertia = 0.02;         ///< kg·m², rotor and gears as felt at the shaft
    double coulomb = 0.1;          ///< N·m
    double viscous = 0.02;         ///< N·m·s/rad
    double windingHeat = 4;        ///< J/K
    double windingToCase = 4;      ///< K/W
    double caseHeat = 50;          ///< J/K
    double caseToAmbient = 8;      ///< K/W

    double resistance() const { return voltage / stallCurrent; } ///< Ω
    /// N·m/A. The stall torque of the data sheet is what leaves the shaft, so it is already less the friction.
    double torqueConstant() const { return (stallTorque + coulomb) / stallCurrent; }
    double freeRadians() const { return freeSpeed * 0.10471975511965977; } ///< rad/s
    double freeCurrent() const { return (coulomb + viscous * freeRadians()) / torqueConstant(); } ///< A
    /// V·s/rad. More than the torque constant: the difference is what the gears lose under load.
    double backEmf() const { return (voltage - resistance() * freeCurrent()) / freeRadians(); }
};

/// The motor of a model, by the catalog's name ("XM430-W350", also with a suffix: "XM430-W350-T"); one that is in the
/// middle of the range where the model is unknown. Never null; lives as long as the program.
const MotorModel *findMotor(QStringView model);
const MotorModel &genericMotor();

} // namespace dynascope::sim
