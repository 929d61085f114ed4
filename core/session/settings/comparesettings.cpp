// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/settings/applysettings.h"

#include "core/session/settings/settingsorder.h"
#include "core/session/texts.h"

#include <algorithm>

namespace dynascope {
namespace {

void askFor(SettingsOutcome &outcome, Consent consent, const QString &why)
{
    outcome.missing = consent;
    outcome.why = SettingsText::tr("%1; nothing was written").arg(why);
}

} // namespace

bool SettingsOutcome::isDone() const
{
    return missing == Consent::None && !ended && count(SettingState::Differs) + count(SettingState::Failed) == 0;
}

std::size_t SettingsOutcome::count(SettingState state) const
{
    return static_cast<std::size_t>(std::ranges::count(results, state, &SettingResult::state));
}

Result<void> checkIdentity(const SettingsPlan &plan, const RegisterImage &image)
{
    const auto model = plan.modelNumber ? image.number(*plan.modelNumber) : std::nullopt;
    const auto version = plan.firmwareVersion ? image.number(*plan.firmwareVersion) : std::nullopt;
    const std::int64_t firmware = version.value_or(plan.firmware); // not read: nothing speaks against it
    if (model && *model != plan.place.modelNumber) {
        return failure(ErrorKind::NotFound,
                       SettingsText::tr("Another model answers as ID %1 at %2 bps, not %3; nothing was written")
                           .arg(plan.place.id)
                           .arg(plan.place.baudRate)
                           .arg(plan.place.name));
    }
    if (plan.firmware >= 0 && firmware != plan.firmware) {
        return failure(
            ErrorKind::NotFound,
            SettingsText::tr("%1 has firmware %2, not %3: another device, or its registers may mean something else; "
                             "nothing was written")
                .arg(plan.place.name)
                .arg(firmware)
                .arg(plan.firmware));
    }
    return {};
}

SettingsOutcome compareSettings(const SettingsPlan &plan, const RegisterImage &image)
{
    SettingsOutcome outcome;
    outcome.hadTorque = plan.torque && image.number(*plan.torque).value_or(0) != 0;
    for (const SettingsStep &step : plan.steps) {
        SettingResult result;
        result.before = result.after = image.bytes(step.where);
        const bool isSame = step.isKept || (!result.before.empty() && result.before == step.to);
        result.state = isSame ? SettingState::Same : SettingState::Differs;
        if (!isSame && outcome.hadTorque && !step.isFixed) {
            outcome.needsTorqueOff = outcome.needsTorqueOff || step.isLocked;
            outcome.moves = outcome.moves || step.isGoal;
        }
        outcome.results.push_back(std::move(result));
    }
    return outcome;
}

Result<void> checkDifferences(const SettingsPlan &plan, const RegisterImage &image, SettingsOutcome &outcome)
{
    RegisterImage end = image;
    bool hasGoals = false;
    for (const SettingsStep &step : plan.steps) {
        if (!step.isKept)
            end.take(step.where.address, step.to);
    }
    for (std::size_t i = 0; i < plan.steps.size(); ++i) {
        const SettingsStep &step = plan.steps[i];
        if (step.isKept || outcome.results[i].state != SettingState::Differs)
            continue;
        const KnownRange range = rangeOf(step, [&](const RegisterPlace &at) { return end.number(at); });
        const QString problem = rangeProblem(step, RegisterImage::numberOf(step.where, step.to), range);
        if (!problem.isEmpty())
            return failure(ErrorKind::InvalidArgument,
                           SettingsText::tr("%1: %2; nothing was written").arg(plan.place.name, problem));
        hasGoals = hasGoals || step.isGoal;
    }
    if (outcome.needsTorqueOff && !plan.options.mayTurnTorqueOff)
        askFor(outcome, Consent::TorqueOff,
               SettingsText::tr("%1 is under torque, which locks its EEPROM").arg(plan.place.name));
    else if (outcome.moves && !outcome.needsTorqueOff && !plan.options.mayMove)
        askFor(outcome, Consent::Motion, SettingsText::tr("%1 is under torque and would move").arg(plan.place.name));
    else if (hasGoals && !plan.torque && !plan.options.mayMove)
        askFor(outcome, Consent::Motion, SettingsText::tr("Nobody knows whether %1 would move").arg(plan.place.name));
    return {};
}

} // namespace dynascope
