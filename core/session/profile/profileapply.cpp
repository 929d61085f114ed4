// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/profile/profileapply.h"

#include "core/bus/operations.h"
#include "core/session/deviceplace.h"
#include "core/session/texts.h"

#include <algorithm>

namespace dynascope {
namespace {

bool isSelected(const ProfileApplyOptions &options, std::size_t joint)
{
    return options.joints.empty() || options.joints.contains(joint);
}

QString placeName(const JointComparison &joint)
{
    return QStringLiteral("%1 (ID %2)").arg(joint.name).arg(joint.found ? joint.found->id : 0);
}

/// Where the file asks for what can't be; empty: nowhere.
QString faultIn(const Profile &profile, const JointComparison &joint)
{
    for (const RegisterComparison &row : joint.rows) {
        const bool isFault =
            row.state == RegisterComparison::State::Wrong || row.state == RegisterComparison::State::NotThere;
        if (isFault)
            return QStringLiteral("%1:%2:%3: %4: %5; nothing was written")
                .arg(profile.file)
                .arg(row.line)
                .arg(row.column)
                .arg(joint.name, row.why);
    }
    return {};
}

/// Everybody else at its rate, for no Secondary ID may be one of these.
std::set<int> idsBeside(const ProfileComparison &comparison, const Found &found)
{
    std::set<int> ids;
    const auto add = [&](const Found &other) {
        if (other.baudRate == found.baudRate && other.id != found.id)
            ids.insert(other.id);
    };
    for (const JointComparison &joint : comparison.joints) {
        if (joint.found)
            add(*joint.found);
    }
    for (const Found &other : comparison.others)
        add(other);
    return ids;
}

Result<JointApply> planJoint(const JointComparison &joint, const ProfileComparison &comparison,
                             const ProfileApplyOptions &options)
{
    JointApply apply;
    apply.joint = joint.joint;
    apply.name = joint.name;
    apply.found = *joint.found;
    apply.table = joint.table;
    std::vector<WantedSetting> wanted;
    for (const RegisterComparison &row : joint.rows) {
        wanted.push_back({row.field, row.wanted->raw});
        if (row.state != RegisterComparison::State::Differs)
            continue;
        ++apply.differences;
        const Field &field = joint.table->fields()[static_cast<std::size_t>(row.field)];
        apply.needsTorqueOff = apply.needsTorqueOff || (joint.hasTorque && field.needsTorqueOff());
        for (const QString &reset : field.resets) {
            const Field *other = joint.table->find(reset);
            const bool isNamed = std::ranges::find(joint.rows, reset, &RegisterComparison::name) != joint.rows.end();
            if (other && other->isWritable() && !isNamed && !apply.resets.contains(reset))
                apply.resets << reset;
        }
    }
    SettingsOptions settings;
    settings.mayTurnTorqueOff = options.mayTurnTorqueOff;
    settings.putTorqueBack = options.putTorqueBack;
    settings.otherIds = idsBeside(comparison, *joint.found);
    auto plan = planSettings(*joint.table, placeOf(*joint.found, *joint.table, placeName(joint)), joint.found->firmware,
                             wanted, settings);
    if (!plan)
        return tl::unexpected(plan.error());
    apply.settings = std::move(*plan);
    return apply;
}

/// A device of the line, whether a joint names it or not.
struct OnLine {
    Found found;
    QString name;
    ControlTablePtr table; ///< nullptr: of an unknown model
    const JointComparison *joint = nullptr;

    const Field *secondary() const { return table ? table->find(Known::SecondaryId) : nullptr; }
    MoveDevice asMover() const
    {
        return table ? moveDevice(found, *table, name) : moveDevice(found, name);
    }
};

std::vector<OnLine> everybody(const ProfileComparison &comparison, const Catalog &catalog)
{
    std::vector<OnLine> all;
    for (const JointComparison &joint : comparison.joints) {
        if (joint.found)
            all.push_back({*joint.found, placeName(joint), {}, &joint});
    }
    for (const Found &other : comparison.others)
        all.push_back({other,
                       ProfileText::tr("%1 (ID %2)").arg(modelName(catalog, other.modelNumber)).arg(other.id),
                       {},
                       nullptr});
    for (OnLine &device : all)
        device.table = catalog.find(device.found.modelNumber, device.found.firmware);
    return all;
}

bool mustMove(const OnLine &device, const ProfileApplyOptions &options)
{
    return device.joint && device.joint->state == JointComparison::State::AtOtherBaud
           && isSelected(options, device.joint->joint);
}

} // namespace

std::size_t ProfileApplyPlan::differences() const
{
    std::size_t sum = 0;
    for (const JointApply &joint : joints)
        sum += joint.differences;
    return sum;
}

bool ProfileApplyPlan::needsTorqueOff() const
{
    return std::ranges::any_of(joints, &JointApply::needsTorqueOff);
}

Result<ProfileApplyPlan> planProfileApply(const Profile &profile, const ProfileComparison &comparison,
                                          const ProfileApplyOptions &options)
{
    ProfileApplyPlan plan;
    for (const JointComparison &joint : comparison.joints) {
        if (!isSelected(options, joint.joint) || joint.state == JointComparison::State::AsWanted)
            continue;
        const auto unread =
            std::ranges::find(joint.rows, RegisterComparison::State::Unread, &RegisterComparison::state);
        if (joint.state != JointComparison::State::Differs) {
            plan.obstacles.push_back({joint.joint, joint.name, joint.why});
            continue;
        }
        if (const QString fault = faultIn(profile, joint); !fault.isEmpty())
            return failure(ErrorKind::InvalidArgument, fault);
        if (unread != joint.rows.end()) {
            plan.obstacles.push_back(
                {joint.joint, joint.name, ProfileText::tr("%1: %2").arg(unread->name, unread->why)});
            continue;
        }
        auto apply = planJoint(joint, comparison, options);
        if (!apply)
            return tl::unexpected(apply.error());
        plan.joints.push_back(std::move(*apply));
    }
    return plan;
}

MoveSurveyPlan planProfileSurvey(const ProfileComparison &comparison, const Catalog &catalog,
                                 const ProfileApplyOptions &options)
{
    MoveSurveyPlan plan;
    const std::vector<OnLine> all = everybody(comparison, catalog);
    if (std::ranges::none_of(all, [&](const OnLine &device) { return mustMove(device, options); }))
        return plan;
    for (const OnLine &device : all) {
        if (const Field *field = device.secondary())
            plan.secondaries.push_back({placeOf(device.found, *device.table, device.name), field->address});
    }
    return plan;
}

Result<MovePlan> planProfileMoves(const Profile &profile, const ProfileComparison &comparison, const Catalog &catalog,
                                  const MoveSurvey &survey, const ProfileApplyOptions &options)
{
    const std::vector<OnLine> all = everybody(comparison, catalog);
    if (std::ranges::none_of(all, [&](const OnLine &device) { return mustMove(device, options); }))
        return MovePlan();
    std::vector<MoveDevice> devices;
    std::size_t asked = 0; // in the survey's order
    for (const OnLine &device : all) {
        devices.push_back(device.asMover());
        if (device.secondary()) {
            const auto id = asked < survey.secondaries.size() ? survey.secondaries[asked] : std::nullopt;
            ++asked;
            if (!id)
                return failure(ErrorKind::NotConfirmed,
                               ProfileText::tr("the Secondary ID of %1 could not be read").arg(device.name));
            devices.back().secondaryId = *id <= MaximumId ? *id : -1; // beyond: it has none
        }
        if (mustMove(device, options)) {
            const ProfileJoint &joint = profile.joints[device.joint->joint];
            devices.back().goal = {joint.baudRate, joint.id};
        }
    }
    auto plan = planMoves(std::move(devices));
    if (plan)
        plan->turnTorqueOff = options.mayTurnTorqueOff;
    return plan;
}

bool ProfileOutcome::isDone(const ProfileApplyPlan &plan) const
{
    return !ended && joints.size() == plan.joints.size() && std::ranges::all_of(joints, [](const JointOutcome &joint) {
        return joint.outcome && joint.outcome->isDone() && !joint.outcome->ended
               && joint.outcome->count(SettingState::Left) == 0;
    });
}

std::size_t ProfileOutcome::written() const
{
    std::size_t sum = 0;
    for (const JointOutcome &joint : joints)
        sum += joint.outcome ? joint.outcome->count(SettingState::Written) : 0;
    return sum;
}

ProfileOutcome applyProfile(JobContext &context, const ProfileApplyPlan &plan, const ProfileApplyHooks &hooks)
{
    ProfileOutcome all;
    for (const JointApply &joint : plan.joints) {
        if (const auto go = context.checkpoint(); !go) {
            all.ended = go.error();
            break;
        }
        if (hooks.begun)
            hooks.begun(joint);
        const SettingsHooks writes = hooks.writes ? hooks.writes(joint) : SettingsHooks();
        auto outcome = applySettings(context, joint.settings, writes);
        if (hooks.ended)
            hooks.ended(joint, outcome);
        const std::optional<Error> error = !outcome ? std::optional(outcome.error()) : outcome->ended;
        all.joints.push_back({joint.joint, std::move(outcome)});
        if (error && endsAll(*error)) {
            all.ended = *error;
            break;
        }
    }
    return all;
}

} // namespace dynascope
