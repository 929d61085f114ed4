// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/journal/journaltexts.h"

#include "core/session/texts.h"
#include "core/table/catalog.h"
#include "core/table/units.h"

namespace dynascope {
namespace {

/// What comes from a file and stands in a comment stays in its line.
QString oneLine(QString text)
{
    for (QChar &each : text) {
        if (!each.isPrint())
            each = u' ';
    }
    return text;
}

QString quoted(const QString &text)
{
    QString escaped = oneLine(text);
    return u'\'' + escaped.replace(u'\'', QStringLiteral("'\\''")) + u'\'';
}

QString assignment(const RegisterChange &change)
{
    QString name = registerText(change);
    return name.replace(u' ', u'_') + u'=' + bytesText(change.after, change.isSigned);
}

QString commandOf(const JournalEntry &entry)
{
    const QString begin = QStringLiteral("dxl --port %1 --baud %2 ")
                              .arg(quoted(entry.device.line), QString::number(entry.device.baudRate));
    const QString id = QString::number(entry.device.id);
    switch (entry.kind) {
    case JournalKind::Write:
        if (entry.changes.empty())
            return begin + QStringLiteral("write ") + id;
        return begin + QStringLiteral("write %1 %2").arg(id, quoted(assignment(entry.changes.front())));
    case JournalKind::Reboot: return begin + QStringLiteral("reboot ") + id;
    case JournalKind::FactoryReset: return begin + QStringLiteral("reset %1 %2").arg(quoted(entry.note), id);
    case JournalKind::Clear: return begin + QStringLiteral("clear %1 %2").arg(quoted(entry.note), id);
    case JournalKind::Backup: return begin + QStringLiteral("backup --in-servo ") + id;
    case JournalKind::Restore: return begin + QStringLiteral("restore --in-servo ") + id;
    case JournalKind::Packet: return begin + QStringLiteral("packet --hex ") + quoted(entry.note);
    }
    return {};
}

bool mayBeRepeated(const JournalEntry &entry)
{
    if (entry.kind == JournalKind::Reboot)
        return true;
    if (entry.kind != JournalKind::Write || entry.changes.empty())
        return false;
    const RegisterChange *main = &entry.changes.front(); // by its address alone it may be torque or a goal
    return !main->name.isEmpty() && !main->after.empty()
           && (main->name != nameOf(Known::TorqueEnable) || main->after.front() == 0);
}

} // namespace

QString valueText(const Catalog &catalog, const JournalDevice &device, const RegisterChange &change, const Bytes &value)
{
    const ControlTablePtr table = catalog.find(device.modelNumber, device.firmware);
    const Field *field = table ? table->at(change.address) : nullptr;
    if (!field || change.name != field->name || value.size() != field->size)
        return bytesText(value, change.isSigned);
    const EffectiveField units = effective(*field, [](QStringView) { return std::optional<std::int64_t>(); });
    return valueText(*field, units, table->resolution(), rawFromBytes(*field, value));
}

QString whatText(const JournalEntry &entry)
{
    if (entry.kind != JournalKind::Write || entry.changes.empty())
        return wordOf(entry.kind);
    const auto others = static_cast<int>(entry.changes.size()) - 1;
    if (others == 0)
        return registerText(entry.changes.front());
    return JournalText::tr("%1 and %2 more").arg(registerText(entry.changes.front())).arg(others);
}

QString changeText(const Catalog &catalog, const JournalEntry &entry)
{
    if (entry.kind != JournalKind::Write || entry.changes.empty())
        return oneLine(entry.note);
    const RegisterChange &main = entry.changes.front();
    return QStringLiteral("%1 → %2").arg(valueText(catalog, entry.device, main, main.before),
                                         valueText(catalog, entry.device, main, main.after));
}

QString scriptOf(std::span<const JournalEntry> entries)
{
    QString script =
        QStringLiteral("#!/bin/sh\n# Written by dxl journal export. Stops at the first command that fails.\n"
                       "set -e\n");
    for (const JournalEntry &entry : entries) {
        if (entry.state == JournalState::Failed)
            continue;
        script += QStringLiteral("\n# %1, %2, %3, %4\n")
                      .arg(QString::number(entry.number), entry.at.toString(Qt::ISODate),
                           oneLine(deviceText(entry.device)), wordOf(entry.by));
        if (!mayBeRepeated(entry))
            script += QStringLiteral("# left to you: ");
        script += commandOf(entry) + u'\n';
    }
    return script;
}

} // namespace dynascope
