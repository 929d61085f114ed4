// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/profile/profilecomparison.h"
#include "core/session/texts.h"

#include <algorithm>

namespace dynascope {
namespace {

std::vector<RegisterComparison> compareRegisters(const ProfileJoint &joint, const ControlTable &table,
                                                 const RegisterImage &image)
{
    using State = RegisterComparison::State;
    const RegisterLookup held = lookupIn(table, image);
    const std::vector<WantedValue> wanted = wantedValues(joint, table, held);
    const RegisterLookup after = lookupAfter(table, wanted, held);
    std::vector<RegisterComparison> rows;
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        const ProfileRegister &each = joint.registers[i];
        RegisterComparison row;
        row.name = each.name;
        row.written = each.text;
        row.line = each.line;
        row.column = each.column;
        const Field *field = wanted[i].field;
        if (!field) {
            row.state = State::NotThere;
            row.why = ProfileText::tr("this firmware has no %1").arg(each.name);
            rows.push_back(std::move(row));
            continue;
        }
        row.field = table.indexOf(field);
        row.area = field->area;
        row.heldAs = effective(*field, held);
        row.wantedAs = effective(*field, after);
        if (const auto raw = held(field->name))
            row.held = profileValue(table, *field, *raw, held);
        if (wanted[i].raw)
            row.wanted = profileValue(table, *field, *wanted[i].raw, after);
        else
            row.why = wanted[i].raw.error().text;
        row.state = !row.wanted                        ? State::Wrong
                    : !row.held                        ? State::Unread
                    : row.wanted->raw == row.held->raw ? State::Same
                                                       : State::Differs;
        if (row.state == State::Unread)
            row.why = ProfileText::tr("the device does not show it");
        rows.push_back(std::move(row));
    }
    return rows;
}

/// Where nothing is compared: what it is instead.
JointComparison::State stateOfPlace(const ProfileJoint &joint, const JointReading &reading, const Catalog &catalog,
                                    QString &why)
{
    using State = JointComparison::State;
    if (!reading.found && reading.elsewhere) {
        why = ProfileText::tr("answers at %1 bps, not at %2").arg(reading.elsewhere->baudRate).arg(joint.baudRate);
        return State::AtOtherBaud;
    }
    if (!reading.found) {
        const bool isSilent = !reading.error || reading.error->kind == ErrorKind::NotSent; // missed, not asked again
        why = isSilent ? ProfileText::tr("nobody answers with ID %1").arg(joint.id) : reading.error->text;
        return State::Missing;
    }
    if (reading.found->modelNumber != joint.modelNumber) {
        why =
            ProfileText::tr("a %1 is there, not a %2").arg(modelName(catalog, reading.found->modelNumber), joint.model);
        return State::OtherModel;
    }
    if (!reading.found->doubt.isEmpty()) {
        why = reading.found->doubt;
        return State::Doubtful;
    }
    if (reading.error) {
        why = reading.error->text;
        return State::Unreadable;
    }
    if (reading.found->firmware < joint.firmware) {
        why = ProfileText::tr("its firmware is %1, the profile asks for %2 or newer")
                  .arg(reading.found->firmware)
                  .arg(joint.firmware);
        return State::OldFirmware;
    }
    return State::AsWanted;
}

JointComparison compareJoint(const ProfileJoint &joint, const JointReading &reading, const Catalog &catalog)
{
    using State = JointComparison::State;
    JointComparison result;
    result.name = joint.name;
    result.found = reading.found ? reading.found : reading.elsewhere;
    result.state = stateOfPlace(joint, reading, catalog, result.why);
    if (result.found && result.found->modelNumber == joint.modelNumber)
        result.table = catalog.find(joint.modelNumber, result.found->firmware);
    if (!result.isReadable() || !result.table)
        return result;
    if (const Field *torque = result.table->find(Known::TorqueEnable))
        result.hasTorque = lookupIn(*result.table, reading.image)(torque->name).value_or(0) != 0;
    result.rows = compareRegisters(joint, *result.table, reading.image);
    if (result.state == State::AsWanted && result.count(RegisterComparison::State::Same) < result.rows.size())
        result.state = State::Differs;
    return result;
}

} // namespace

std::size_t JointComparison::count(RegisterComparison::State wanted) const
{
    return static_cast<std::size_t>(std::ranges::count(rows, wanted, &RegisterComparison::state));
}

bool ProfileComparison::isAsWanted() const
{
    return others.empty() && notes.isEmpty() && count(JointComparison::State::AsWanted) == joints.size();
}

std::size_t ProfileComparison::count(JointComparison::State wanted) const
{
    return static_cast<std::size_t>(std::ranges::count(joints, wanted, &JointComparison::state));
}

std::size_t ProfileComparison::count(RegisterComparison::State wanted) const
{
    std::size_t sum = 0;
    for (const JointComparison &joint : joints)
        sum += joint.count(wanted);
    return sum;
}

ProfileComparison compareProfile(const Profile &profile, const ProfileReading &reading, const Catalog &catalog)
{
    ProfileComparison comparison;
    for (std::size_t i = 0; i < profile.joints.size(); ++i) {
        const JointReading none;
        comparison.joints.push_back(
            compareJoint(profile.joints[i], i < reading.joints.size() ? reading.joints[i] : none, catalog));
        comparison.joints.back().joint = i;
    }
    comparison.others = reading.others;
    comparison.notes = reading.notes;
    return comparison;
}

QString wordOf(JointComparison::State state)
{
    switch (state) {
    case JointComparison::State::AsWanted: return QStringLiteral("as-wanted");
    case JointComparison::State::Differs: return QStringLiteral("differs");
    case JointComparison::State::Missing: return QStringLiteral("missing");
    case JointComparison::State::AtOtherBaud: return QStringLiteral("at-other-baud");
    case JointComparison::State::OtherModel: return QStringLiteral("other-model");
    case JointComparison::State::OldFirmware: return QStringLiteral("old-firmware");
    case JointComparison::State::Unreadable: return QStringLiteral("unreadable");
    case JointComparison::State::Doubtful: return QStringLiteral("doubtful");
    }
    return {};
}

QString wordOf(RegisterComparison::State state)
{
    switch (state) {
    case RegisterComparison::State::Same: return QStringLiteral("same");
    case RegisterComparison::State::Differs: return QStringLiteral("differs");
    case RegisterComparison::State::NotThere: return QStringLiteral("not-there");
    case RegisterComparison::State::Wrong: return QStringLiteral("wrong");
    case RegisterComparison::State::Unread: return QStringLiteral("unread");
    }
    return {};
}

} // namespace dynascope
