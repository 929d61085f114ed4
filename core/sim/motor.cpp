// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/motor.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace dynascope::sim {

namespace {

constexpr std::array<const char16_t *, MotorModel::FigureCount> Names{
    u"voltage", u"stall torque", u"stall current", u"free speed", u"gear ratio", u"standby current", u"weight",
    u"inertia", u"friction", u"heat", u"overload current",
};

// What is chosen, and how. Nothing here is in a data sheet; the constants are such that a free 90° step at factory
// gains looks as users of XM430, XL430 and XL330 see it.
//
//   Generic        figures of a model of which nothing is known: one in the middle of the range.
//   Stall          some series state a continuous load instead (torque, current, speed). The line from the free speed
//                  through that load ends at the stall torque, which is at least 1.5 times a stated maximum torque; the
//                  current there follows from the torque per ampere of the maximum or, less the free current, of the
//                  continuous load. Torque per ampere is at most 0.9 of what back-EMF allows.
//   Inertia        that of the rotor times the square of the gear ratio. A rotor of a servo of mass m has
//                  1.03e-5 · m^(5/3) kg·m², as bodies of one shape do: 1.6 g·cm² for XM430. The time constant at the
//                  shaft stays within 5 and 40 ms; where the gear ratio isn't stated it is 20 ms.
//   Friction       dry: 2.5 % of the stall torque, with a cored motor 3.5 %; where the free current is stated, half of
//                  the torque that it makes. Viscous: as much again at the free speed. A third more holds what
//                  stands (plant.cpp).
//   Heat           60 % of the mass at 1 J/(g·K) for the case, a tenth of that for the winding; cooling by the surface,
//                  m^(2/3). A stalled XM430 passes its temperature limit after one to two minutes and takes about a
//                  quarter of an hour to cool.
//   Overload       more than 60 % of the stall current; 1.5 times a stated continuous current.
constexpr double GenericVoltage = 12, GenericTorque = 2.5, GenericCurrent = 1.4, GenericSpeed = 55;
// V, N·m, A, rev/min; kg, A
constexpr double GenericMass = 0.07, GenericStandby = 0.05;
constexpr double OverMaximum = 1.5, BackEmfShare = 0.9;
constexpr double RotorInertia = 1.03e-5;
constexpr double ShortestTime = 0.005, UsualTime = 0.020, LongestTime = 0.040; // s
constexpr double CorelessFriction = 0.025, CoredFriction = 0.035;
constexpr double CaseHeat = 600, WindingHeat = 60;            // J/(kg·K)
constexpr double WindingToCase = 0.86, CaseToAmbient = 1.51;  // K/W · kg^(1/2), K/W · kg^(2/3)
constexpr double OverloadOfStall = 0.6, OverloadOfContinuous = 1.5;

/// A figure that is stated and can be one, or 0.
double stated(const QJsonObject &figures, const char16_t *key)
{
    const double value = figures.value(QStringView(key)).toDouble();
    return std::isfinite(value) && value > 0 && value < 1e6 ? value : 0;
}

double take(MotorModel &motor, MotorModel::Figure figure, double stated, double otherwise)
{
    if (stated > 0)
        motor.known |= 1U << figure;
    return stated > 0 ? stated : otherwise;
}

double frictionShare(const QJsonObject &figures)
{
    return figures.value(u"type").toString() == u"cored" ? CoredFriction : CorelessFriction;
}

/// N·m/A from a maximum or continuous load; 0 where neither is stated.
double statedTorqueConstant(const QJsonObject &figures, const MotorModel &motor)
{
    const double torque = stated(figures, u"continuousTorque");
    const double current = stated(figures, u"continuousCurrent") - stated(figures, u"freeCurrent");
    const double maximum = stated(figures, u"maxTorque"), atMaximum = stated(figures, u"maxCurrent");
    const double most = BackEmfShare * motor.voltage / motor.freeRadians();
    if (maximum > 0 && atMaximum > 0)
        return std::min(maximum / atMaximum, most);
    return torque > 0 && current > 0 ? std::min(torque / current, most) : 0.0;
}

void chooseStall(MotorModel &motor, const QJsonObject &figures)
{
    const double constant = statedTorqueConstant(figures, motor);
    const double speed = stated(figures, u"continuousSpeed");
    const double torque = stated(figures, u"continuousTorque");
    double stall = OverMaximum * stated(figures, u"maxTorque");
    if (torque > 0 && speed > 0 && speed < motor.freeSpeed)
        stall = std::max(stall, torque / (1 - speed / motor.freeSpeed));
    const bool derived = stall > 0 && constant > 0;
    motor.stallTorque = take(motor, MotorModel::StallTorque, stated(figures, u"stallTorque"),
                             derived ? stall : GenericTorque);
    const double push = motor.stallTorque * (1 + frictionShare(figures));
    motor.stallCurrent = take(motor, MotorModel::StallCurrent, stated(figures, u"stallCurrent"),
                              derived ? push / constant : GenericCurrent * GenericVoltage / motor.voltage);
}

void chooseFriction(MotorModel &motor, const QJsonObject &figures)
{
    motor.coulomb = frictionShare(figures) * motor.stallTorque;
    if (const double current = stated(figures, u"freeCurrent"); current > 0)
        motor.coulomb = std::min(motor.torqueConstant() * current / 2, motor.stallTorque / 4);
    motor.viscous = motor.coulomb / motor.freeRadians();
}

void chooseInertia(MotorModel &motor)
{
    const double perTime = motor.stallTorque / motor.freeRadians();
    const bool fromRotor = motor.isKnown(MotorModel::GearRatio) && motor.isKnown(MotorModel::Mass);
    const double rotor = RotorInertia * std::pow(motor.mass, 5.0 / 3) * motor.gearRatio * motor.gearRatio;
    motor.inertia = fromRotor ? std::clamp(rotor, ShortestTime * perTime, LongestTime * perTime) : UsualTime * perTime;
}

void chooseHeat(MotorModel &motor)
{
    motor.caseHeat = CaseHeat * motor.mass;
    motor.windingHeat = WindingHeat * motor.mass;
    motor.windingToCase = WindingToCase / std::sqrt(motor.mass);
    motor.caseToAmbient = CaseToAmbient / std::pow(motor.mass, 2.0 / 3);
}

QStringList named(const MotorModel &motor, bool known)
{
    QStringList names;
    for (int figure = 0; figure < MotorModel::FigureCount; ++figure) {
        if (motor.isKnown(static_cast<MotorModel::Figure>(figure)) == known)
            names.append(QString::fromUtf16(Names[static_cast<std::size_t>(figure)]));
    }
    return names;
}

} // namespace

MotorModel motorFromFigures(const QString &name, const QJsonObject &figures)
{
    MotorModel motor;
    motor.name = name;
    motor.voltage = take(motor, MotorModel::Voltage, stated(figures, u"voltage"), GenericVoltage);
    motor.freeSpeed = take(motor, MotorModel::FreeSpeed, stated(figures, u"freeSpeed"), GenericSpeed);
    motor.gearRatio = take(motor, MotorModel::GearRatio, stated(figures, u"gearRatio"), 1);
    motor.mass = take(motor, MotorModel::Mass, stated(figures, u"weight") / 1000, GenericMass);
    motor.standbyCurrent =
        take(motor, MotorModel::StandbyCurrent, stated(figures, u"standbyCurrent") / 1000, GenericStandby);
    chooseStall(motor, figures);
    chooseFriction(motor, figures);
    chooseInertia(motor);
    chooseHeat(motor);
    const double continuous = stated(figures, u"continuousCurrent");
    motor.overloadCurrent = motor.isKnown(MotorModel::StallCurrent) || continuous <= 0
                                ? OverloadOfStall * motor.stallCurrent
                                : OverloadOfContinuous * continuous;
    return motor;
}

QStringList MotorModel::knownFigures() const
{
    return named(*this, true);
}

QStringList MotorModel::chosenFigures() const
{
    return named(*this, false);
}

} // namespace dynascope::sim
