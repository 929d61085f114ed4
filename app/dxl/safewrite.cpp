// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/dxl/safewrite.h"

#include "app/dxl/directjob.h"
#include "app/dxl/showvalue.h"
#include "core/session/consequences.h"
#include "core/session/deviceplace.h"
#include "core/session/settings/settingsjournal.h"

#include <algorithm>
#include <map>

namespace dynascope::dxl {
namespace {

QString wordOf(ConsequenceKind kind)
{
    switch (kind) {
    case ConsequenceKind::NeedsTorqueOff: return QStringLiteral("needs torque off");
    case ConsequenceKind::Resets: return QStringLiteral("resets");
    case ConsequenceKind::MovesPosition: return QStringLiteral("moves position");
    case ConsequenceKind::BeyondLimits: return QStringLiteral("beyond limits");
    case ConsequenceKind::Jumps: return QStringLiteral("jumps");
    case ConsequenceKind::Turns: return QStringLiteral("turns");
    case ConsequenceKind::TorqueByGoal: return QStringLiteral("torque by goal");
    case ConsequenceKind::StartsByItself: return QStringLiteral("starts by itself");
    case ConsequenceKind::ChangesPlace: return QStringLiteral("changes place");
    case ConsequenceKind::ChangesProtocol: return QStringLiteral("changes protocol");
    case ConsequenceKind::AnswersLess: return QStringLiteral("answers less");
    case ConsequenceKind::LosesProtection: return QStringLiteral("loses protection");
    }
    return {};
}

Document documentOf(const Device &device, const Field &field, std::int64_t raw)
{
    Document document;
    document.add("id", qint64(device.id()))
        .add("field", field.name)
        .add("address", qint64(field.address))
        .add("raw", qint64(raw));
    return document;
}

void explain(const Work &work, const Device &device, const RegisterLookup &now, const Assignment &assignment)
{
    const Field &field = *assignment.field;
    const auto all = consequencesOf(*device.table(), now, field, assignment.raw);
    if (all.empty())
        work.output.result(device.id(), QStringLiteral("%1: nothing besides its value").arg(field.name),
                           documentOf(device, field, assignment.raw));
    for (const Consequence &one : all) {
        Document document = documentOf(device, field, assignment.raw);
        document.add("consequence", wordOf(one.kind)).add("text", one.text);
        std::vector<Document> registers;
        QString text = QStringLiteral("%1: %2").arg(field.name, one.text);
        for (const ExpectedChange &change : one.registers) {
            Document known;
            known.add("register", change.name);
            if (change.before)
                known.add("old", qint64(*change.before));
            if (change.after)
                known.add("new", qint64(*change.after));
            registers.push_back(known);
            if (one.kind == ConsequenceKind::Resets)
                text += QStringLiteral("\n    ") + changeText(*device.table(), now, change);
        }
        if (!registers.empty())
            document.add("registers", registers);
        work.output.result(device.id(), text, document);
    }
}

Error withoutName(const Device &device, const Assignment &assignment)
{
    return {ErrorKind::InvalidArgument, QStringLiteral("%1: nobody knows what %2 is; nothing was written")
                                            .arg(device.name(), assignment.argument.text())};
}

/// Each register that was wanted, then what else there is to know.
ExitCode show(const Work &work, Device &device, const SettingsPlan &plan, const SettingsOutcome &outcome)
{
    ExitCode code = ExitCode::Done;
    for (std::size_t i = 0; i < plan.steps.size(); ++i) {
        const SettingResult &result = outcome.results[i];
        const Field &field = *device.table()->at(plan.steps[i].where.address);
        const bool holds = result.state == SettingState::Same || result.state == SettingState::Written;
        const bool isTold = !plan.steps[i].isKept || result.state != SettingState::Same;
        if (isTold && holds && !result.after.empty()) {
            showField(work.output, device, field, rawFromBytes(field, result.after));
        } else if (result.state == SettingState::Left) {
            work.output.note(work.output.named(device.id(), result.why));
        } else if (result.state == SettingState::Failed) {
            Document document;
            document.add("id", qint64(device.id())).add("field", field.name).add("error", result.why);
            work.output.failedResult(document);
            code = work.output.fail(
                {ErrorKind::NotConfirmed, work.output.named(device.id(), QStringLiteral("%1: %2").arg(field.name, result.why))});
        }
    }
    if (!outcome.torqueNote.isEmpty())
        work.output.note(work.output.named(device.id(), outcome.torqueNote));
    else if (outcome.torqueStaysOff())
        work.output.note(work.output.named(device.id(), QStringLiteral("torque was turned off for it, and stays off")));
    else if (outcome.torqueIsBack)
        work.output.note(work.output.named(device.id(), QStringLiteral("torque is on, with the goal at rest")));
    return code;
}

} // namespace

ExitCode explainWrites(const Work &work, Device &device, const std::vector<Assignment> &assignments)
{
    std::map<QString, std::optional<std::int64_t>> known;
    device.forget();
    const RegisterLookup now = [&](QStringView name) -> std::optional<std::int64_t> {
        const Field *field = device.table()->find(name);
        if (!field || device.isMute())
            return std::nullopt;
        const auto at = known.find(field->name);
        if (at != known.end())
            return at->second;
        const auto raw = device.read(*field);
        return known[field->name] = raw ? std::optional(*raw) : std::nullopt;
    };
    for (const Assignment &assignment : assignments) {
        if (!assignment.field || !device.table())
            return work.output.refuse(withoutName(device, assignment));
        explain(work, device, now, assignment);
        known[assignment.field->name] = assignment.raw;
    }
    return ExitCode::Done;
}

Result<SettingsPlan> planSafely(const Work &work, const Device &device, const std::vector<Assignment> &assignments)
{
    if (!device.table())
        return tl::unexpected(withoutName(device, assignments.front()));
    SettingsOptions options;
    options.mayTurnTorqueOff = options.keepResets = true;
    options.mayMove = true; // a goal that is written is meant to move it
    options.putTorqueBack = work.options.torqueBack;
    for (const std::uint8_t id : work.options.idList) {
        if (id != device.id())
            options.otherIds.insert(id);
    }
    std::vector<WantedSetting> wanted;
    for (const Assignment &assignment : assignments) {
        if (!assignment.field)
            return tl::unexpected(withoutName(device, assignment));
        if (assignment.field == device.table()->find(Known::TorqueEnable) && assignment.raw == 1)
            options.turnTorqueOn = true;
        else
            wanted.push_back({device.table()->indexOf(assignment.field), assignment.raw});
    }
    return planSettings(*device.table(), placeOf(device.found(), *device.table(), device.name()),
                        device.found().firmware, wanted, options);
}

ExitCode writeSafely(const Work &work, Device &device, const SettingsPlan &plan)
{
    if (const auto there = device.enter(); !there)
        return work.output.fail(there.error());
    device.forget();
    JournalEntry as;
    as.by = JournalAuthor::CommandLine;
    as.device = journalDevice(device.found(), device.model(), work.options.port);
    DirectJob job(device.bus());
    const auto table = work.catalog.find(device.found().modelNumber, device.found().firmware);
    const auto outcome = applySettings(job, plan, noted(&work.journal, as, table));
    if (!outcome)
        return work.output.fail(outcome.error());
    const ExitCode code = show(work, device, plan, *outcome);
    if (!outcome->ended)
        return code;
    return work.output.fail({outcome->ended->kind,
                             work.output.named(device.id(), QStringLiteral("%1; %2 of %3 registers hold what was wanted")
                                                                .arg(outcome->ended->text)
                                                                .arg(outcome->count(SettingState::Written)
                                                                     + outcome->count(SettingState::Same))
                                                                .arg(outcome->results.size()))});
}

} // namespace dynascope::dxl
