// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/settings/settingsplan.h"

#include "core/session/journal/journalwrites.h"
#include "core/session/settings/settingsorder.h"
#include "core/session/texts.h"
#include "core/table/indirect.h"

#include <algorithm>

namespace dynascope {
namespace {

constexpr int LargestSecondaryId = 252; ///< beyond it is switched off
constexpr std::int64_t AnswersPingAlone = 0, ThisProtocol = 2;

bool isAny(const ControlTable &table, const Field &field, std::initializer_list<Known> of)
{
    return std::ranges::any_of(of, [&](Known known) { return table.find(known) == &field; });
}

bool isNamed(const Field &field, QStringView name)
{
    return field.name == name;
}

/// Written by a plan it could only be what it is.
bool isFixed(const ControlTable &table, const Field &field)
{
    return isAny(table, field, {Known::Id, Known::BaudRate}) || isNamed(field, u"Protocol Type");
}

RegisterPlace placeOf(const Field &field)
{
    return {field.address, field.size, field.isSigned};
}

/// What changes the link, or is no setting.
QString ownMatter(const ControlTable &table, const DevicePlace &place, const Field &field, std::int64_t raw,
                  const std::set<int> &otherIds)
{
    if (&field == table.find(Known::Id) && raw != place.id)
        return SettingsText::tr("ID is not changed among other settings: give the device its new ID first");
    if (&field == table.find(Known::BaudRate) && table.baudRate(static_cast<int>(raw)) != place.baudRate)
        return SettingsText::tr(
            "Baud Rate is not changed among other settings: move the device to its new baud rate first");
    if (isNamed(field, u"Protocol Type") && raw != ThisProtocol)
        return SettingsText::tr("Protocol Type stays at Protocol 2.0: the device would not be found any more");
    if (&field == table.find(Known::StatusReturnLevel) && raw == AnswersPingAlone)
        return SettingsText::tr(
            "Status Return Level 0 is not set among other settings: nothing could be read back any more");
    if (&field == table.find(Known::TorqueEnable))
        return SettingsText::tr("Torque Enable is no setting: torque is switched by hand");
    if (isNamed(field, u"Hybrid Save"))
        return SettingsText::tr("Hybrid Save is an order, not a setting");
    if (isIndirectData(field))
        return SettingsText::tr("%1 leads to another register: set that one").arg(field.name);
    const bool isTaken = raw == place.id || otherIds.contains(static_cast<int>(raw));
    if (&field == table.find(Known::SecondaryId) && raw <= LargestSecondaryId && isTaken)
        return SettingsText::tr("Secondary ID %1 is the ID of a device of this line").arg(raw);
    return {};
}

SettingBound boundOf(const ControlTable &table, const Bound &bound)
{
    SettingBound result{bound.number, {}, bound.negated};
    if (const Field *reg = bound.reg.isEmpty() ? nullptr : table.find(bound.reg))
        result.reg = placeOf(*reg);
    return result;
}

std::vector<SettingRange> rangesOf(const ControlTable &table, const Field &field)
{
    std::vector<SettingRange> ranges;
    for (const Alternate &alternate : field.alternates) {
        const Field *decider = table.find(alternate.reg);
        if (!decider)
            continue;
        ranges.push_back({placeOf(*decider), alternate.mask, alternate.values,
                          boundOf(table, alternate.minimum.isSet() ? alternate.minimum : field.minimum),
                          boundOf(table, alternate.maximum.isSet() ? alternate.maximum : field.maximum)});
    }
    ranges.push_back({{}, 0, {}, boundOf(table, field.minimum), boundOf(table, field.maximum)});
    return ranges;
}

SettingsStep stepOf(const ControlTable &table, const DevicePlace &place, const Field &field)
{
    SettingsStep step;
    step.where = placeOf(field);
    step.name = field.name;
    step.isGoal = isGoal(field);
    step.isLocked = field.needsTorqueOff();
    step.isFixed = isFixed(table, field);
    if (&field == table.find(Known::ReturnDelayTime))
        step.tells = SettingsStep::Tells::ReturnDelay;
    if (&field == table.find(Known::StatusReturnLevel))
        step.tells = SettingsStep::Tells::ReturnLevel;
    step.ranges = rangesOf(table, field);
    step.affected = spansOf(table, place.id, among(affectedBy(table, field, true)));
    return step;
}

void addReads(SettingsPlan &plan, const ControlTable &table, const std::vector<const Field *> &fields)
{
    std::vector<const Field *> compared = fields, affected;
    const auto take = [&](const Field *field, std::optional<RegisterPlace> &where) {
        if (!field)
            return;
        compared.push_back(field);
        where = placeOf(*field);
    };
    take(table.find(u"Model Number"), plan.modelNumber);
    take(table.find(u"Firmware Version"), plan.firmwareVersion);
    take(table.find(Known::TorqueEnable), plan.torque);
    take(modeRegister(table), plan.mode);
    plan.restingGoals = restingGoalsOf(table);
    const Field *drive = table.find(u"Drive Mode");
    if (drive && std::ranges::find(drive->bits, TorqueOnByGoalBit, &BitField::first) != drive->bits.end()) {
        plan.driveModeAddress = drive->address;
        compared.push_back(drive);
    }
    for (const Field *field : fields) {
        for (const QString &name : limitingRegisters(*field)) {
            if (const Field *limit = table.find(name))
                compared.push_back(limit);
        }
        for (const Field *other : affectedBy(table, *field, true))
            affected.push_back(other);
    }
    plan.reads = spansOf(table, plan.place.id, among(std::move(compared)));
    plan.affectedReads = spansOf(table, plan.place.id, among(std::move(affected)));
}

Error about(const DevicePlace &place, const QString &problem)
{
    return {ErrorKind::InvalidArgument, SettingsText::tr("%1: %2; nothing was written").arg(place.name, problem)};
}

/// Under the wanted values; what these don't tell is looked at once it has been read.
QString beyondRange(const SettingsStep &step, const SettingsPlan &plan)
{
    const KnownRange range = rangeOf(step, [&](const RegisterPlace &where) -> std::optional<std::int64_t> {
        for (const SettingsStep &other : plan.steps) {
            if (other.where == where && !other.to.empty())
                return RegisterImage::numberOf(where, other.to);
        }
        return std::nullopt;
    });
    return rangeProblem(step, RegisterImage::numberOf(step.where, step.to), range);
}

} // namespace

const Field *modeRegister(const ControlTable &table)
{
    const Field *mode = table.find(Known::OperatingMode);
    return mode ? mode : table.find(u"Control Mode");
}

std::vector<RestingGoal> restingGoalsOf(const ControlTable &table)
{
    const Field *mode = modeRegister(table);
    std::vector<RestingGoal> goals;
    const auto add = [&](QStringView name, std::vector<std::int64_t> modes, const Field *present = nullptr) {
        const Field *goal = table.find(name);
        if (!goal || !goal->isWritable() || (present && present->size != goal->size))
            return;
        goals.push_back({std::move(modes), placeOf(*goal), goal->name,
                         present ? std::optional(placeOf(*present)) : std::nullopt});
    };
    const Field *position = table.find(Known::PresentPosition);
    const bool isJointOrWheel = mode && isNamed(*mode, u"Control Mode"); // XL-320
    if (isJointOrWheel)
        add(u"Moving Speed", {1});
    if (position)
        add(u"Goal Position",
            !mode            ? std::vector<std::int64_t>()
            : isJointOrWheel ? std::vector<std::int64_t>{2}
                             : std::vector<std::int64_t>{3, 4, 5},
            position);
    if (!mode || isJointOrWheel)
        return goals;
    add(u"Goal Velocity", {1});
    add(u"Goal Current", {0});
    add(u"Goal Torque", {0}); // PRO
    add(u"Goal PWM", {16});
    return goals;
}

const RestingGoal *restingGoalIn(const std::vector<RestingGoal> &goals, std::optional<std::int64_t> mode)
{
    const auto at = std::ranges::find_if(goals, [&](const RestingGoal &goal) {
        return goal.modes.empty() || (mode && std::ranges::find(goal.modes, *mode) != goal.modes.end());
    });
    return at == goals.end() ? nullptr : &*at;
}

KnownRange rangeOf(const SettingsStep &step, const NumberAt &numberAt)
{
    const auto value = [&](const SettingBound &bound) {
        if (bound.number || !bound.reg)
            return bound.number;
        const std::optional<std::int64_t> at = numberAt(*bound.reg);
        return at && bound.isNegated ? std::optional(-*at) : at;
    };
    for (const SettingRange &range : step.ranges) {
        if (range.decider) {
            const std::optional<std::int64_t> at = numberAt(*range.decider);
            if (!at)
                return {}; // this or the next one, nobody knows
            const std::int64_t masked = *at & static_cast<std::int64_t>(range.mask);
            if (std::ranges::find(range.values, masked) == range.values.end())
                continue;
        }
        return {value(range.minimum), value(range.maximum)};
    }
    return {};
}

QString rangeProblem(const SettingsStep &step, std::int64_t raw, const KnownRange &range)
{
    if ((!range.minimum || raw >= *range.minimum) && (!range.maximum || raw <= *range.maximum))
        return {};
    const auto text = [](const std::optional<std::int64_t> &bound) {
        return bound ? QString::number(*bound) : SettingsText::tr("anything");
    };
    return SettingsText::tr("%1 can be %2 to %3, not %4")
        .arg(step.name, text(range.minimum), text(range.maximum), QString::number(raw));
}

QString settingProblem(const ControlTable &table, const DevicePlace &place, const WantedSetting &wanted,
                       const SettingsOptions &options)
{
    const auto fields = table.fields();
    if (wanted.field < 0 || wanted.field >= static_cast<int>(fields.size()))
        return SettingsText::tr("There is no register number %1").arg(wanted.field);
    const Field &field = fields[static_cast<std::size_t>(wanted.field)];
    if (!field.isWritable())
        return field.mayBeTried() ? SettingsText::tr("Nobody knows whether %1 may be written").arg(field.name)
                                  : SettingsText::tr("%1 can only be read").arg(field.name);
    if (wanted.raw < smallestRaw(field) || wanted.raw > largestRaw(field))
        return SettingsText::tr("%1 does not fit into %2").arg(wanted.raw).arg(field.name);
    if (!field.values.empty() && std::ranges::find(field.values, wanted.raw, &EnumValue::value) == field.values.end())
        return SettingsText::tr("%1 has no value %2").arg(field.name).arg(wanted.raw);
    return ownMatter(table, place, field, wanted.raw, options.otherIds);
}

Result<SettingsPlan> planSettings(const ControlTable &table, const DevicePlace &place, int firmware,
                                  const std::vector<WantedSetting> &wanted, const SettingsOptions &options)
{
    if (table.description().isRaw)
        return failure(
            ErrorKind::NotSupported,
            SettingsText::tr("%1: the registers of this model are not known; nothing was written").arg(place.name));
    SettingsPlan plan;
    plan.place = place;
    plan.firmware = firmware;
    plan.options = options;
    std::vector<const Field *> fields;
    for (const WantedSetting &one : wanted) {
        if (const QString problem = settingProblem(table, place, one, options); !problem.isEmpty())
            return tl::unexpected(about(place, problem));
        const Field *field = &table.fields()[static_cast<std::size_t>(one.field)];
        if (std::ranges::find(fields, field) != fields.end())
            return tl::unexpected(about(place, SettingsText::tr("%1 is wanted twice").arg(field->name)));
        fields.push_back(field);
    }
    std::vector<const Field *> all = fields;
    for (const Field *field : fields) {
        for (const QString &name : options.keepResets ? field->resets : QStringList()) {
            const Field *reset = table.find(name);
            if (reset && reset->isWritable() && std::ranges::find(all, reset) == all.end())
                all.push_back(reset);
        }
    }
    for (const Field *field : inOrder(table, all)) {
        SettingsStep step = stepOf(table, place, *field);
        const auto at = std::ranges::find(fields, field);
        step.isKept = at == fields.end();
        if (!step.isKept)
            step.to = bytesFromRaw(*field, wanted[static_cast<std::size_t>(at - fields.begin())].raw);
        plan.steps.push_back(std::move(step));
    }
    for (const SettingsStep &step : plan.steps) {
        if (step.isKept)
            continue;
        if (const QString problem = beyondRange(step, plan); !problem.isEmpty())
            return tl::unexpected(about(place, problem));
    }
    addReads(plan, table, all);
    return plan;
}

} // namespace dynascope
