// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/profile/profile.h"

#include "core/session/journal/journalwrites.h"
#include "core/session/texts.h"

#include <algorithm>
#include <array>
#include <set>

namespace dynascope {
namespace {

bool beginsWithOneOf(const QString &name, std::initializer_list<QLatin1String> words)
{
    return std::ranges::any_of(words, [&](QLatin1String word) { return name.startsWith(word); });
}

} // namespace

const ProfileRegister *ProfileJoint::find(QStringView registerName) const
{
    const QString wanted = normalizedName(registerName);
    const auto found = std::ranges::find_if(
        registers, [&](const ProfileRegister &each) { return normalizedName(each.name) == wanted; });
    return found == registers.end() ? nullptr : &*found;
}

std::vector<int> Profile::baudRates() const
{
    std::set<int> rates;
    for (const ProfileJoint &joint : joints)
        rates.insert(joint.baudRate);
    return {rates.begin(), rates.end()};
}

const ProfileJoint *Profile::at(int baudRate, int id) const
{
    const auto found = std::ranges::find_if(
        joints, [&](const ProfileJoint &joint) { return joint.baudRate == baudRate && joint.id == id; });
    return found == joints.end() ? nullptr : &*found;
}

const Profile::Default *Profile::defaultOf(int modelNumber, QStringView registerName) const
{
    const QString wanted = normalizedName(registerName);
    const auto found = std::ranges::find_if(defaults, [&](const Default &each) {
        return (each.modelNumber < 0 || each.modelNumber == modelNumber) && normalizedName(each.name) == wanted;
    });
    return found == defaults.end() ? nullptr : &*found;
}

ProfileUse profileUse(const ControlTable &table, const Field &field)
{
    if (!field.isWritable())
        return ProfileUse::ReadOnly;
    if (&field == table.find(Known::Id) || field.name.startsWith(u"Baud Rate"))
        return ProfileUse::Place;
    if (&field == table.find(Known::TorqueEnable) || isGoal(field) || isIndirectData(field)
        || beginsWithOneOf(field.name, {QLatin1String("PWM Offset"), QLatin1String("Current Offset"),
                                        QLatin1String("Velocity Offset")})) // Y series: added to what the motor follows
        return ProfileUse::Motion;
    // With another protocol the device answers nobody here any more.
    if (field.name == u"Hybrid Save" || field.name == u"Protocol Type")
        return ProfileUse::Order;
    if (field.name == u"Homing Offset")
        return ProfileUse::Calibration;
    if (beginsWithOneOf(field.name, {QLatin1String("LED"), QLatin1String("Bus Watchdog"),
                                     QLatin1String("External Port Data"), QLatin1String("Digital Output")}))
        return ProfileUse::State;
    return ProfileUse::Setting;
}

QString whyNotInProfile(ProfileUse use, const Field &field)
{
    switch (use) {
    case ProfileUse::ReadOnly: return ProfileText::tr("%1 can't be written").arg(field.name);
    case ProfileUse::Place: return ProfileText::tr("%1 is said by the joint's \"id\" and \"baud\"").arg(field.name);
    case ProfileUse::Motion:
        return ProfileText::tr("%1 would move the motor, which a profile never does").arg(field.name);
    case ProfileUse::Order:
        return ProfileText::tr("%1 makes the device do something; a profile only says what is so").arg(field.name);
    case ProfileUse::Setting:
    case ProfileUse::Calibration:
    case ProfileUse::State: break;
    }
    return {};
}

} // namespace dynascope
