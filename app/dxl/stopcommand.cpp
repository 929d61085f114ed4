// SPDX-License-Identifier: GPL-3.0-or-later
// STOP from the command line. Torque-off goes out as soon as it is known to whom: at once where the model is given,
// else after a device's own Ping, or that of all. Never blindly: 64 is EEPROM in some series.
#include "app/dxl/commands.h"
#include "app/dxl/target.h"
#include "core/session/journal/journalnote.h"
#include "core/bus/operations.h"
#include "core/bus/stopsequence.h"

#include <algorithm>
#include <map>
#include <set>

namespace dynascope::dxl {

namespace {

/// Who is to be stopped at one baud rate.
struct Joint {
    Found found;
    QString model;                              ///< as the device or the person said
    std::optional<std::uint16_t> torqueAddress; ///< nothing: an unknown model
};

struct Stopping {
    std::vector<Joint> joints;
    std::map<std::uint8_t, Error> silent; ///< by ID: could not be asked what it is, and why
    Result<void> sent;                    ///< fails where the line is gone
};

Joint jointOf(const Work &work, const Found &found)
{
    const ControlTablePtr table = work.catalog.find(found.modelNumber, found.firmware);
    const Field *torque = table ? table->find(Known::TorqueEnable) : nullptr;
    Joint joint{found, modelName(work.catalog, found.modelNumber), {}};
    if (torque)
        joint.torqueAddress = torque->address;
    return joint;
}

/// `device` is the place in `joints`.
StopPlan planFor(const std::vector<Joint> &joints)
{
    std::vector<StopTarget> targets;
    for (std::size_t i = 0; i < joints.size(); ++i) {
        const Joint &joint = joints[i];
        if (joint.torqueAddress)
            targets.push_back({static_cast<quint32>(i), joint.found.id, joint.found.baudRate, *joint.torqueAddress,
                               joint.found.modelNumber});
    }
    return StopPlan(std::move(targets));
}

Found foundFrom(const PingReply &reply, int baudRate)
{
    return {reply.id, baudRate, reply.modelNumber, reply.firmware, reply.alert, {}};
}

/// The person said what they are.
Stopping stopAs(const Work &work, const ControlTable &table)
{
    Stopping stopping;
    const int baudRate = work.bus.line().baudRate();
    const Field *torque = table.find(Known::TorqueEnable);
    for (const std::uint8_t id : work.options.idList) {
        Found found;
        found.id = id;
        found.baudRate = baudRate;
        stopping.joints.push_back({found, table.model(), torque ? std::optional(torque->address) : std::nullopt});
    }
    stopping.sent = sendTorqueOff(work.bus, planFor(stopping.joints), baudRate);
    return stopping;
}

/// Each is told as soon as it has said what it is, and all once more at the end.
Stopping stopNamed(const Work &work)
{
    Stopping stopping;
    const int baudRate = work.bus.line().baudRate();
    for (const std::uint8_t id : work.options.idList) {
        const auto reply = ping(work.bus, id);
        if (!reply && endsAll(reply.error())) {
            stopping.sent = tl::unexpected(reply.error());
            return stopping;
        }
        if (!reply) {
            stopping.silent[id] = reply.error();
            continue;
        }
        stopping.joints.push_back(jointOf(work, foundFrom(*reply, baudRate)));
        const StopPlan its = planFor({stopping.joints.back()});
        for (const Bytes &packet : its.packets(baudRate)) {
            if (const auto sent = work.bus.sendOnly(packet); !sent) {
                stopping.sent = sent;
                return stopping;
            }
        }
    }
    stopping.sent = sendTorqueOff(work.bus, planFor(stopping.joints), baudRate);
    return stopping;
}

/// Whoever answers a Ping to all; no second look before the packets are out.
Stopping stopAll(const Work &work)
{
    Stopping stopping;
    const int baudRate = work.bus.line().baudRate();
    const auto answers = work.bus.broadcastPing(MaximumId, [&](const Reply &reply) {
        const PingReply ping{reply.id, static_cast<std::uint16_t>(littleEndian(reply.data, 2)), reply.data[2],
                             reply.alert};
        stopping.joints.push_back(jointOf(work, foundFrom(ping, baudRate)));
    });
    stopping.sent = sendTorqueOff(work.bus, planFor(stopping.joints), baudRate);
    if (stopping.sent && !answers)
        stopping.sent = tl::unexpected(answers.error());
    return stopping;
}

void show(const Work &work, const Joint &joint, const StopOutcome &outcome)
{
    const QString name = joint.model.isEmpty() ? QString() : joint.model + QStringLiteral(", ");
    Document document;
    document.add("id", qint64(joint.found.id)).add("baud", qint64(joint.found.baudRate)).add("model", joint.model);
    document.addFlag("off", outcome.off);
    if (!outcome.off)
        document.add("error", outcome.text);
    work.output.result(
        QStringLiteral("ID %1: %2%3")
            .arg(QString::number(joint.found.id), name,
                 outcome.off ? QStringLiteral("torque is off") : QStringLiteral("not confirmed: ") + outcome.text),
        document);
}

/// Noted once it has been sent: nothing waits for a file.
void noteStop(const Work &work, const Joint &joint, const StopOutcome &outcome)
{
    JournalEntry entry;
    entry.by = JournalAuthor::Stop;
    entry.device = journalDevice(joint.found, joint.model, work.options.port);
    entry.changes = {{nameOf(Known::TorqueEnable).toString(), *joint.torqueAddress, false, {}, {0}, {}}};
    JournalNote note(&work.journal, entry);
    entry.state = outcome.off ? JournalState::Done : JournalState::Unconfirmed;
    if (outcome.off)
        entry.changes.front().shown = {0};
    note.finish(entry);
}

ExitCode worse(ExitCode one, ExitCode other)
{
    return one == ExitCode::Failed || other == ExitCode::Done ? one : other;
}

/// Reads back, prints, and says what it came to.
ExitCode verify(const Work &work, const Stopping &stopping)
{
    const int baudRate = work.bus.line().baudRate();
    std::vector<StopOutcome> outcomes = verifyTorqueOff(work.bus, planFor(stopping.joints), baudRate);
    ExitCode code = ExitCode::Done;
    for (std::size_t i = 0; i < stopping.joints.size(); ++i) {
        const Joint &joint = stopping.joints[i];
        const auto known = std::ranges::find(outcomes, static_cast<quint32>(i), &StopOutcome::device);
        StopOutcome outcome;
        if (known != outcomes.end())
            outcome = *known;
        else if (!joint.torqueAddress)
            outcome.text = QStringLiteral("nothing was sent, since it isn't known where it has its Torque Enable");
        else
            outcome.text = QStringLiteral("sent, but nobody looked whether it is off");
        show(work, joint, outcome);
        if (joint.torqueAddress)
            noteStop(work, joint, outcome);
        if (!outcome.off)
            code = worse(code, joint.torqueAddress ? ExitCode::Unconfirmed : ExitCode::Failed);
    }
    return code;
}

/// `silent` and `found` are of all rates.
ExitCode stopAtRates(const Work &work, const std::vector<int> &bauds, const ControlTable *table,
                     std::map<std::uint8_t, Error> &silent, std::set<std::uint8_t> &found)
{
    ExitCode code = ExitCode::Done;
    for (const int baudRate : bauds) {
        if (const auto set = work.bus.setBaudRate(baudRate); !set) {
            // Of several rates nobody expects every port to do each.
            if (bauds.size() == 1 || set.error().kind == ErrorKind::PortLost)
                code = work.output.fail(set.error());
            continue;
        }
        const Stopping stopping = table                         ? stopAs(work, *table)
                                  : work.options.idList.empty() ? stopAll(work)
                                                                : stopNamed(work);
        silent.insert(stopping.silent.begin(), stopping.silent.end());
        for (const Joint &joint : stopping.joints)
            found.insert(joint.found.id);
        code = worse(code, verify(work, stopping));
        if (!stopping.sent)
            return work.output.fail(stopping.sent.error());
    }
    return code;
}

} // namespace

ExitCode stopCommand(const Work &work)
{
    const Options &options = work.options;
    const Catalog::ModelInfo *model = options.model.isEmpty() ? nullptr : work.catalog.model(options.model);
    if (!model && !options.model.isEmpty())
        return work.output.refuse({ErrorKind::NotFound, QStringLiteral("there is no model \"%1\"").arg(options.model)});
    const ControlTablePtr table = model ? work.catalog.find(model->modelNumber, model->newestFirmware) : nullptr;
    work.output.expectMany();
    const std::vector<int> bauds =
        work.bus.line().canSetBaudRate() ? options.bauds : std::vector{work.bus.line().baudRate()};
    std::map<std::uint8_t, Error> silent;
    std::set<std::uint8_t> found;
    ExitCode code = stopAtRates(work, bauds, table.get(), silent, found);
    for (const auto &[id, error] : silent) {
        if (found.contains(id))
            continue;
        Joint joint;
        joint.found.id = id;
        joint.found.baudRate = bauds.back();
        show(work, joint, {0, false, bauds.size() > 1 ? error.text : withAdvice(error, options).text});
        code = ExitCode::Failed;
    }
    if (found.empty() && silent.empty() && code == ExitCode::Done) {
        return work.output.fail(
            {ErrorKind::NothingReceived,
             QStringLiteral(
                 "nobody answered, so nobody is known to be off; for devices at other baud rates: dxl --port "
                 "%1 stop --bauds all")
                 .arg(options.port)});
    }
    return code;
}

} // namespace dynascope::dxl
