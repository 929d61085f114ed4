// SPDX-License-Identifier: GPL-3.0-or-later
// Two backups side by side, each of a file or of a device.
#include "app/dxl/backupcommand.h"
#include "app/dxl/target.h"
#include "core/session/backup/comparebackups.h"

#include <algorithm>

namespace dynascope::dxl {

namespace {

using State = ComparedRegister::State;

QString statusText(const ComparedRegister &row)
{
    QString text;
    switch (row.state) {
    case State::Same: text = QStringLiteral("same"); break;
    case State::Differs: text = QStringLiteral("differs"); break;
    case State::OnlyHere: text = QStringLiteral("only in A"); break;
    case State::OnlyThere: text = QStringLiteral("only in B"); break;
    case State::OtherMeaning: text = QStringLiteral("not comparable: ") + row.why; break;
    }
    switch (row.use) {
    case BackupUse::Calibration: return text + QStringLiteral(" (of the single device)");
    case BackupUse::Place: return text + QStringLiteral(" (ID or baud rate)");
    case BackupUse::Reading: return text + QStringLiteral(" (reading)");
    default: return text;
    }
}

Document documentOf(const ComparedRegister &row)
{
    Document document;
    document.add("register", row.name).add("use", wordOf(row.use)).add("state", wordOf(row.state));
    if (row.here)
        document.add("a", qint64(*row.here)).add("a_text", row.hereText);
    if (row.there)
        document.add("b", qint64(*row.there)).add("b_text", row.thereText);
    if (!row.why.isEmpty())
        document.add("note", row.why);
    return document;
}

QString sideText(const Backup &backup)
{
    const QString what = QStringLiteral("%1, firmware %2").arg(backup.name()).arg(backup.firmware);
    return backup.file.isEmpty() ? what : QStringLiteral("%1: %2").arg(backup.file, what);
}

ExitCode show(const Backup &a, const Backup &b, const Options &options, Output &output)
{
    const std::vector<ComparedRegister> all = compareBackups(a, b);
    std::vector<QStringList> rows{{QStringLiteral("Register"), QStringLiteral("A"), QStringLiteral("B"), QString()}};
    std::vector<Document> documents;
    for (const ComparedRegister &row : all) {
        if (!options.backup.all && (row.isSame() || row.isReading()))
            continue;
        rows.push_back({row.name, row.hereText, row.thereText, statusText(row)});
        documents.push_back(documentOf(row));
    }
    const std::size_t same = countOf(all, State::Same);
    const auto counted = static_cast<std::size_t>(
        std::ranges::count_if(all, [](const ComparedRegister &row) { return !row.isReading(); }));
    QString text = QStringLiteral("A: %1\nB: %2\n").arg(sideText(a), sideText(b));
    if (rows.size() > 1)
        text += aligned(rows, {0, 3}) + u'\n';
    text += QStringLiteral("%1 same, %2 not").arg(same).arg(counted - same);
    Document document;
    document.add("a", sideText(a))
        .add("b", sideText(b))
        .add("same", qint64(same))
        .add("differing", qint64(counted - same))
        .add("registers", documents);
    output.result(text, document);
    return counted == same ? ExitCode::Done : ExitCode::Failed;
}

} // namespace

ExitCode compareFilesCommand(const Catalog &catalog, const Options &options, Output &output)
{
    std::vector<Backup> backups;
    for (const CompareSide &side : options.backup.sides) {
        auto backup = loadBackup(side.file, catalog);
        if (!backup)
            return output.refuse(backup.error());
        backups.push_back(std::move(*backup));
    }
    return show(backups.front(), backups.back(), options, output);
}

ExitCode compareCommand(const Work &work)
{
    std::vector<Backup> backups;
    for (const CompareSide &side : work.options.backup.sides) {
        Device device(work.bus, static_cast<std::uint8_t>(std::max(0, side.id)));
        const auto known = side.id < 0 ? Result<void>() : device.identify(work.catalog);
        auto backup = !known        ? Result<Backup>(tl::unexpected(withAdvice(known.error(), work.options)))
                      : side.id < 0 ? loadBackup(side.file, work.catalog)
                                    : backupDevice(work, device);
        if (!backup)
            return side.id < 0 ? work.output.refuse(backup.error()) : work.output.fail(backup.error());
        backups.push_back(std::move(*backup));
    }
    return show(backups.front(), backups.back(), work.options, work.output);
}

} // namespace dynascope::dxl
