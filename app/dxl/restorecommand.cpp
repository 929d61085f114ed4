// SPDX-License-Identifier: GPL-3.0-or-later
// From a backup's file to a device: planned, shown, asked, written, read back.
#include "app/dxl/backupcommand.h"
#include "app/dxl/directjob.h"
#include "app/dxl/restarting.h"
#include "app/dxl/target.h"
#include "core/session/backup/restore.h"
#include "core/session/settings/settingsjournal.h"

#include <algorithm>

namespace dynascope::dxl {

namespace {

using RowState = RestoreRow::State;

/// One device, one file.
class Restoring
{
public:
    Restoring(const Work &work, const Backup &file, Device &device)
        : m_work(work), m_options(work.options.backup), m_file(file), m_device(device)
    {
    }

    ExitCode run()
    {
        const auto now = backupDevice(m_work, m_device);
        if (!now)
            return fail(now.error());
        RestoreOptions options;
        options.settings.mayTurnTorqueOff = m_options.torqueOff;
        options.settings.putTorqueBack = m_options.torqueBack;
        options.calibration = m_options.calibration;
        options.only = m_options.only;
        options.except = m_options.except;
        auto plan = planRestore(m_file, *now, placeOf(m_device), options);
        if (!plan)
            return m_work.output.refuse(plan.error());
        m_plan = std::move(*plan);
        tellWhatStays();
        if (m_options.dryRun) {
            show(nullptr);
            return ExitCode::Done;
        }
        return write();
    }

private:
    ExitCode fail(const Error &error)
    {
        showDeviceFailure(m_work, m_device.id(), error);
        return ExitCode::Failed;
    }

    void tellWhatStays() const
    {
        for (const RestoreRow &row : m_plan.rows) {
            if (row.state == RowState::NotCarried)
                m_work.output.note(QStringLiteral("could not be carried: %1: %2").arg(row.name, row.why));
            else if (row.state == RowState::Left && row.use == BackupUse::Calibration)
                m_work.output.note(
                    QStringLiteral("left: %1: %2; --calibration yes restores it").arg(row.name, row.why));
            else if (row.state == RowState::Left && row.use == BackupUse::Place && !m_options.withIdAndBaud)
                m_work.output.note(
                    QStringLiteral("left: %1, which is %2 in the backup; --with-id-and-baud moves the device")
                        .arg(row.name, row.wantedText));
        }
    }

    bool moves() const
    {
        return m_options.withIdAndBaud && (m_file.id != m_device.id() || m_file.baudRate != m_device.found().baudRate);
    }

    Options moveOptions() const
    {
        Options options = m_work.options;
        options.command = Command::Move;
        options.move = {};
        if (m_file.id != m_device.id())
            options.move.ids = {{m_device.id(), m_file.id}};
        if (m_file.baudRate != options.baudRate) {
            options.move.toBaud = m_file.baudRate;
            options.move.movers = {m_device.id()};
        }
        options.move.turnTorqueOff = m_options.torqueOff;
        return options;
    }

    ExitCode write()
    {
        const Options move = moveOptions();
        const Work moving{move, m_work.catalog, m_work.bus, m_work.output, m_work.journal};
        if (moves()) { // refused before anything is written
            if (const auto can = checkMove(moving); !can)
                return can.error().kind == ErrorKind::InvalidArgument ? m_work.output.refuse(can.error())
                                                                      : fail(can.error());
        }
        const auto count = m_plan.count(RowState::Differs);
        if (count > 0
            && !mayGoOn(m_work, QStringLiteral("%1 registers of %2 are to be written").arg(count).arg(m_device.name())))
            return ExitCode::Usage;
        DirectJob job(m_work.bus);
        JournalEntry as;
        as.by = JournalAuthor::CommandLine;
        as.device = journalDevice(m_device.found(), m_device.model(), m_work.options.port);
        const ControlTablePtr table = m_work.catalog.find(m_device.found().modelNumber, m_device.found().firmware);
        const auto outcome = applySettings(job, m_plan.settings, noted(&m_work.journal, as, table));
        if (!outcome)
            return fail(outcome.error());
        if (outcome->missing != Consent::None)
            return m_work.output.refuse(
                {ErrorKind::InvalidArgument, outcome->why + QStringLiteral("; --torque-off allows it")});
        show(&*outcome);
        if (const ExitCode code = tell(*outcome); code != ExitCode::Done)
            return code;
        return moves() ? moveCommand(moving) : ExitCode::Done;
    }

    ExitCode tell(const SettingsOutcome &outcome) const
    {
        for (const SettingResult &result : outcome.results) {
            if (result.state == SettingState::Failed)
                m_work.output.fail({ErrorKind::NotConfirmed, result.why});
        }
        if (outcome.ended)
            m_work.output.fail(
                {outcome.ended->kind, outcome.ended->text + QStringLiteral("; the same once more goes on")});
        if (outcome.torqueStaysOff())
            m_work.output.note(outcome.torqueNote.isEmpty() ? QStringLiteral("its torque was turned off and stays so")
                                                            : outcome.torqueNote);
        return outcome.isDone() ? ExitCode::Done : ExitCode::Failed;
    }

    /// Of a row that was to be written what became of it; nullptr: nothing was yet.
    const SettingResult *resultOf(const RestoreRow &row, const SettingsOutcome *outcome) const
    {
        if (!outcome || row.field < 0)
            return nullptr;
        const Field &field = m_device.table()->fields()[static_cast<std::size_t>(row.field)];
        for (std::size_t i = 0; i < m_plan.settings.steps.size(); ++i) {
            if (m_plan.settings.steps[i].where.address == field.address)
                return &outcome->results[i];
        }
        return nullptr;
    }

    void show(const SettingsOutcome *outcome)
    {
        std::vector<Document> registers;
        QStringList lines;
        qint64 written = 0;
        for (const RestoreRow &row : m_plan.rows) {
            if (row.state == RowState::Same)
                continue;
            const SettingResult *result = resultOf(row, outcome);
            const bool isWritten = result && result->state == SettingState::Written;
            written += isWritten ? 1 : 0;
            Document one;
            one.add("register", row.name).add("state", isWritten ? QStringLiteral("written") : wordOf(row.state));
            if (row.now)
                one.add("old", qint64(*row.now));
            one.add("new", qint64(row.wanted));
            const QString why = result && !result->why.isEmpty() ? result->why : row.why;
            if (!why.isEmpty())
                one.add("note", why);
            registers.push_back(one);
            if (row.state == RowState::Differs && (!outcome || isWritten))
                lines << QStringLiteral("%1: %2 -> %3").arg(row.name, row.nowText, row.wantedText);
        }
        lines << QStringLiteral("%1: %2 registers %3, %4 the same")
                     .arg(m_device.name())
                     .arg(outcome ? written : static_cast<qint64>(m_plan.count(RowState::Differs)))
                     .arg(outcome ? QStringLiteral("written") : QStringLiteral("would be written"))
                     .arg(m_plan.count(RowState::Same));
        Document document;
        document.add("id", qint64(m_device.id()))
            .add("file", m_file.file)
            .addFlag("dry_run", !outcome)
            .add("written", written)
            .add("same", qint64(m_plan.count(RowState::Same)))
            .add("registers", registers);
        m_work.output.result(lines.join(u'\n'), document);
    }

    const Work &m_work;
    const BackupOptions &m_options;
    const Backup &m_file;
    Device &m_device;
    RestorePlan m_plan;
};

} // namespace

ExitCode restoreCommand(const Work &work)
{
    if (work.options.backup.inServo)
        return inServoCommand(work, true);
    const auto file = loadBackup(work.options.backup.file, work.catalog);
    if (!file) // nothing was sent yet
        return work.output.refuse(file.error());
    Targets targets = findTargets(work, 1);
    if (!targets.areAll())
        return targets.code;
    return Restoring(work, *file, targets.devices.front()).run();
}

} // namespace dynascope::dxl
