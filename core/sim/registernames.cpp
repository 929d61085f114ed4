// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/registerfile.h"

namespace dynascope::sim {
namespace {

/// A register's name and, where another series calls it otherwise, that one too.
struct Name {
    const char16_t *name;
    const char16_t *otherwise = nullptr;
};

constexpr std::array<Name, static_cast<std::size_t>(Reg::Count)> RegisterNames{{
    {u"Model Number"},
    {u"Firmware Version"},
    {u"ID"},
    {u"Baud Rate"},
    {u"Return Delay Time"},
    {u"Drive Mode"},
    {u"Operating Mode", u"Control Mode"},
    {u"Secondary ID"},
    {u"Protocol Type"},
    {u"Homing Offset"},
    {u"Moving Threshold"},
    {u"Temperature Limit", u"Motor Temperature Limit"},
    {u"Max Voltage Limit"},
    {u"Min Voltage Limit"},
    {u"PWM Limit", u"Max Torque"},
    {u"Current Limit", u"Torque Limit"},
    {u"Velocity Limit"},
    {u"Max Position Limit", u"CCW Angle Limit"},
    {u"Min Position Limit", u"CW Angle Limit"},
    {u"Startup Configuration"},
    {u"PWM Slope"},
    {u"Shutdown"},
    {u"In-Position Threshold"},
    {u"Following Error Threshold"},
    {u"Torque Enable"},
    {u"LED", u"LED Red"},
    {u"Status Return Level"},
    {u"Registered Instruction"},
    {u"Hardware Error Status"},
    {u"Error Code"},
    {u"Hybrid Save"},
    {u"Velocity I Gain"},
    {u"Velocity P Gain"},
    {u"Position D Gain", u"D Gain"},
    {u"Position I Gain", u"I Gain"},
    {u"Position P Gain", u"P Gain"},
    {u"Feedforward 2nd Gain"},
    {u"Feedforward 1st Gain"},
    {u"Bus Watchdog"},
    {u"Goal PWM", u"Torque Limit"},
    {u"Goal Current", u"Goal Torque"},
    {u"Goal Velocity", u"Moving Speed"},
    {u"Profile Acceleration", u"Goal Acceleration"},
    {u"Profile Velocity"},
    {u"Profile Acceleration Time"},
    {u"Profile Time"},
    {u"Goal Position"},
    {u"Realtime Tick"},
    {u"Moving"},
    {u"Moving Status"},
    {u"Present PWM"},
    {u"Present Current"},
    {u"Present Load"},
    {u"Present Velocity", u"Present Speed"},
    {u"Present Position"},
    {u"Velocity Trajectory"},
    {u"Position Trajectory"},
    {u"Present Input Voltage", u"Present Voltage"},
    {u"Present Temperature", u"Present Motor Temperature"},
    {u"Backup Ready"},
}};

} // namespace

const Field *findRegister(const ControlTable &table, Reg reg)
{
    const Name &names = RegisterNames[static_cast<std::size_t>(reg)];
    const Field *field = table.find(QStringView(names.name));
    if (!field && names.otherwise)
        field = table.find(QStringView(names.otherwise));
    // Torque Limit bounds the current where it is kept (PRO), and the PWM where it is a goal (XL-320).
    if (field && field->name == u"Torque Limit" && (field->area == Area::Eeprom) != (reg == Reg::CurrentLimit))
        return nullptr;
    return field;
}

} // namespace dynascope::sim
