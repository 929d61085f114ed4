// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/motor.h"

namespace dynascope::sim {

namespace {

// Known: voltage, stall torque, stall current, free speed (at the recommended voltage), standby current, mass.
//
// Chosen, so that a free 90° step at default gains looks as users of these servos see it:
//   inertia   a rotor of 0.4 to 2 g·cm² times the square of the gear ratio (353.5, 258.5, 288.4);
//   coulomb   2.5 to 4 % of the stall torque; viscous: as much again at about full speed;
//   heat      60 % of the mass at 1 J/(g·K) for the case, a tenth of that for the winding; a stalled servo passes its
//             temperature limit after one to two minutes and takes about a quarter of an hour to cool.
constexpr MotorModel motors[] = {
    {u"XM430-W350", 12.0, 4.1, 2.3, 46, 0.040, 0.0820, 0.0200, 0.100, 0.0200, 5.0, 3.0, 50, 8.0},
    {u"XL430-W250", 11.1, 1.4, 1.3, 57, 0.052, 0.0572, 0.0080, 0.045, 0.0060, 3.5, 4.0, 34, 11.0},
    {u"XL330-M288", 5.0, 0.52, 1.47, 103, 0.017, 0.0180, 0.0012, 0.018, 0.0012, 1.1, 6.0, 11, 22.0},
};

constexpr MotorModel generic = {u"generic", 12.0, 2.5, 1.4, 55, 0.050, 0.0700, 0.0100, 0.070, 0.0100, 4.0, 3.5, 42, 9.0};

} // namespace

const MotorModel *findMotor(QStringView model)
{
    for (const MotorModel &motor : motors) {
        if (!model.startsWith(motor.name, Qt::CaseInsensitive))
            continue;
        if (model.size() == motor.name.size() || model.at(motor.name.size()) == u'-')
            return &motor;
    }
    return &generic;
}

const MotorModel &genericMotor()
{
    return generic;
}

} // namespace dynascope::sim
