// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/settingscommands.h"

#include "core/session/settings/settingsjournal.h"

namespace dynascope {
namespace {

/// Of a device that has many: what it did not take.
QString problemText(const SettingsOutcome &outcome)
{
    if (outcome.missing != Consent::None)
        return outcome.why;
    if (outcome.ended)
        return outcome.ended->text;
    QStringList texts;
    for (const SettingResult &result : outcome.results) {
        if (result.state == SettingState::Failed)
            texts << result.why;
    }
    if (!outcome.torqueNote.isEmpty())
        texts << outcome.torqueNote;
    return texts.join(QStringLiteral("; "));
}

} // namespace

SettingsCommands::SettingsCommands(Session &session, Commands &commands, QObject *parent)
    : QObject(parent), m_session(session), m_commands(commands)
{
}

void SettingsCommands::apply(Device &device, const std::vector<WantedSetting> &wanted, SettingsOptions options,
                             Done done, JournalAuthor by)
{
    const auto refuse = [&](const Error &error) {
        emit m_commands.failed(&device, error);
        if (done)
            done(tl::unexpected(error));
    };
    const bool moves = options.mayMove || options.putTorqueBack || options.turnTorqueOn;
    if (m_commands.isStopped() && moves && !options.compareOnly)
        return refuse({ErrorKind::Stopped, tr("STOP is held: release it before anything moves again")});
    if (!device.line())
        return refuse({ErrorKind::NotFound, tr("%1 is not connected").arg(device.displayName())});
    for (const auto &other : device.line()->devices()) {
        if (other.get() != &device && other->baudRate() == device.baudRate())
            options.otherIds.insert(other->id());
    }
    const auto plan = planSettings(device.table(), placeOf(device), device.firmware(), wanted, options);
    if (!plan)
        return refuse(plan.error());
    for (const WantedSetting &one : wanted) {
        if (!options.compareOnly && device.value(one.field).raw != one.raw)
            device.setPending(one.field, one.raw);
    }
    device.line()->bus().run<SettingsOutcome>(
        Priority::Click, this,
        [plan = *plan, hooks = hooksFor(device, by)](JobContext &context) {
            return applySettings(context, plan, posted(context, hooks));
        },
        [this, key = device.key(), plan = *plan, wanted, done = std::move(done)](const Result<SettingsOutcome> &outcome) {
            finish(key, wanted, plan, outcome);
            if (done)
                done(outcome);
        });
}

/// On the GUI thread: the journal, and the values as they come.
SettingsHooks SettingsCommands::hooksFor(const Device &device, JournalAuthor by)
{
    JournalEntry as;
    as.by = by;
    as.device = journalDevice(device);
    SettingsHooks shown;
    shown.ended = [this, key = device.key()](const SettingsWrite &, std::span<const PollValue>,
                                             const Result<std::vector<PollValue>> &after) {
        Device *present = m_session.device(key);
        if (!present || !after)
            return;
        for (const PollValue &value : *after)
            present->take(value);
    };
    return notedAhead(m_commands.journal(), as, device.sharedTable(), shown);
}

void SettingsCommands::finish(DeviceKey key, const std::vector<WantedSetting> &wanted, const SettingsPlan &plan,
                              const Result<SettingsOutcome> &outcome)
{
    Device *device = m_session.device(key);
    if (!device)
        return;
    for (const WantedSetting &one : wanted)
        device->clearPending(one.field);
    if (!outcome) {
        if (outcome.error().kind != ErrorKind::Cancelled)
            emit m_commands.failed(device, outcome.error());
        return;
    }
    device->line()->answered(*device);
    show(*device, wanted, plan, *outcome);
    if (outcome->torqueIsBack)
        emit torqueTurnedOn(key);
    const QString problem = problemText(*outcome);
    if (!problem.isEmpty())
        emit m_commands.failed(device, outcome->ended.value_or(Error{ErrorKind::NotConfirmed, problem}));
    else if (!plan.options.compareOnly && outcome->torqueStaysOff())
        emit m_commands.succeeded(device, tr("%1: written, and its torque stays off").arg(device->displayName()));
}

void SettingsCommands::show(Device &device, const std::vector<WantedSetting> &wanted, const SettingsPlan &plan,
                            const SettingsOutcome &outcome)
{
    for (std::size_t i = 0; i < plan.steps.size(); ++i) {
        const SettingResult &result = outcome.results[i];
        const Field *field = device.table().at(plan.steps[i].where.address);
        const int index = field ? device.table().indexOf(field) : -1;
        if (index < 0)
            continue;
        if (!result.after.empty() && !outcome.ended)
            device.takeReadBack(index, rawFromBytes(*field, result.after));
        const bool isWanted = std::ranges::find(wanted, index, &WantedSetting::field) != wanted.end();
        if (result.state == SettingState::Failed && isWanted)
            device.setFailed(index, result.why);
    }
    const int torque = device.table().indexOf(Known::TorqueEnable);
    if (torque >= 0 && outcome.torqueTurnedOff && !outcome.ended)
        device.takeReadBack(torque, outcome.torqueIsBack ? 1 : 0);
    else if (torque >= 0 && outcome.torqueTurnedOff)
        device.setUnconfirmed(torque, 0, outcome.ended->text);
}

} // namespace dynascope
