// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/dxl/dxl.h"

#include "app/dxl/chooseport.h"
#include "app/dxl/commands.h"
#include "app/dxl/interrupt.h"
#include "app/dxl/modelscommand.h"
#include "core/bus/seriallinefactory.h"
#include "core/session/journal/journal.h"
#include "core/session/procedures/movefile.h"
#include "core/table/usertables.h"

namespace dynascope::dxl {

namespace {

ExitCode performOnLine(const Work &work)
{
    switch (work.options.command) {
    case Command::Backup: return backupCommand(work);
    case Command::Clear: return clearCommand(work);
    case Command::Commission: return commissionCommand(work);
    case Command::Compare: return compareCommand(work);
    case Command::Info: return infoCommand(work);
    case Command::Move: return moveCommand(work);
    case Command::Packet: return packetCommand(work);
    case Command::Ping: return pingCommand(work);
    case Command::Profile: return profileCommand(work);
    case Command::Read: return readCommand(work);
    case Command::Reboot: return rebootCommand(work);
    case Command::Record: return recordCommand(work);
    case Command::Reset: return resetCommand(work);
    case Command::Restore: return restoreCommand(work);
    case Command::Scan: return scanCommand(work);
    case Command::Stats: return statsCommand(work);
    case Command::Stop: return stopCommand(work);
    case Command::Table: return tableCommand(work);
    case Command::Torque:
    case Command::Led: return switchCommand(work);
    case Command::Watch: return watchCommand(work);
    case Command::Write: return writeCommand(work);
    case Command::Completion:
    case Command::Convert:
    case Command::Journal:
    case Command::Models:
    case Command::Ports:
    case Command::Replay:
    case Command::Sim:
    case Command::Version: break; // need no line
    }
    return ExitCode::Usage;
}

/// The demo behind "sim" ends with this program, and what was written to it, too.
bool isJournalled(const Options &options)
{
    switch (options.command) {
    case Command::Backup:
    case Command::Clear:
    case Command::Commission:
    case Command::Led:
    case Command::Move:
    case Command::Packet:
    case Command::Profile:
    case Command::Reboot:
    case Command::Reset:
    case Command::Restore:
    case Command::Stop:
    case Command::Torque:
    case Command::Write: return options.port != QLatin1String("sim");
    default: return false;
    }
}

ExitCode connectAndPerform(const Catalog &catalog, Options options, Output &output)
{
    heedSignals();
    if (options.port.isEmpty()) {
        const auto chosen = choosePort(SerialPortList().ports());
        if (!chosen)
            return output.refuse(chosen.error());
        options.port = *chosen;
        output.note(QStringLiteral("on %1, the one adapter that is there").arg(options.port));
    }
    const MoveFile moves = moveFileOf(options);
    const bool goesOn = options.command == Command::Move || options.command == Command::Commission;
    if (!goesOn && moves.exists()) {
        const auto left = moves.load();
        output.note(left ? unfinishedText(*left) + QStringLiteral("; dxl move --resume goes on, --forget leaves it so")
                         : left.error().text + QStringLiteral(": ") + moves.path());
    }
    const auto connection = Connection::open(catalog, options);
    if (!connection)
        return output.fail(connection.error());
    Journal journal(isJournalled(options) ? Journal::usualFolder() : QString(), Journal::Reading::Newest);
    QObject::connect(&journal, &Journal::failed,
                     [&output](const QString &why) { output.note(why + QStringLiteral("; it is tried again before the end")); });
    return performOnLine({options, catalog, (*connection)->bus(), output, journal});
}

ExitCode perform(const Options &options, Output &output)
{
    auto catalog = Catalog::builtIn();
    if (!catalog)
        return output.fail(catalog.error());
    // A file that is checked doesn't stand in its own way, and the others aren't asked about.
    const bool checks = options.command == Command::Models && options.models.act == ModelsArguments::Act::Check;
    const QString checked = checks ? QString::fromStdString(options.models.file) : QString();
    for (const Error &refused : addUserTables(*catalog, userTablesFolder(), checked).refused) {
        if (!checks)
            output.note(refused.text);
    }
    if (options.command == Command::Compare && options.idList.empty())
        return compareFilesCommand(*catalog, options, output);
    switch (options.command) {
    case Command::Completion: return completionCommand(*catalog, options, output);
    case Command::Convert: return convertCommand(options, output);
    case Command::Journal: return journalCommand(*catalog, options, output);
    case Command::Models: return modelsCommand(*catalog, options.models, output);
    case Command::Ports: return portsCommand(output);
    case Command::Replay: return replayCommand(options, output);
    case Command::Sim: return simCommand(*catalog, options, output);
    case Command::Version: return versionCommand(output);
    default: return connectAndPerform(*catalog, options, output);
    }
}

/// Being interrupted is how `stats` and `record` may end, with their report.
ExitCode finalCode(const Options &options, const Output &output, ExitCode code)
{
    const bool mayBe = options.command == Command::Stats || options.command == Command::Record;
    if (interrupted() && (!mayBe || code != ExitCode::Done))
        return ExitCode::Interrupted;
    if (!output.isClosed() || code != ExitCode::Done)
        return code;
    return output.hasFailed() ? ExitCode::Failed : ExitCode::Unread;
}

} // namespace

int run(int argc, const char *const *argv)
{
    const auto options = parseOptions(argc, argv);
    if (!options)
        return static_cast<int>(options.error());
    Output output(options->json);
    const ExitCode code = perform(*options, output);
    output.finish();
    const ExitCode last = finalCode(*options, output, code);
    if (last == ExitCode::Interrupted && code != last) // else it has said what it came to
        output.note(QStringLiteral("interrupted; nothing more was sent"));
    return static_cast<int>(last);
}

} // namespace dynascope::dxl
