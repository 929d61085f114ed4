// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/journal/journalmodel.h"

#include "core/session/journal/journaltexts.h"
#include "core/session/journal/undoplan.h"
#include "ui/common/texts.h"

#include <QLocale>
#include <QPalette>

#include <algorithm>
#include <chrono>

namespace dynascope {
namespace {

using namespace std::chrono_literals;

constexpr std::size_t MostRows = 2000; ///< `dxl journal` lists them all
constexpr auto RefreshInterval = 200ms;

} // namespace

JournalModel::JournalModel(const Journal &journal, const Catalog &catalog, QObject *parent)
    : QAbstractTableModel(parent), m_journal(journal), m_catalog(catalog)
{
    m_timer.setSingleShot(true);
    m_timer.setInterval(RefreshInterval);
    connect(&m_timer, &QTimer::timeout, this, &JournalModel::refresh);
    connect(&journal, &Journal::entriesChanged, this, [this] {
        if (!m_timer.isActive())
            m_timer.start();
    });
    refresh();
}

void JournalModel::refresh()
{
    const auto &all = m_journal.entries();
    std::vector<JournalEntry> entries;
    for (auto entry = all.rbegin(); entry != all.rend() && entries.size() < MostRows; ++entry)
        entries.push_back(*entry);
    m_undone = undoneEntries(all);
    // Mostly some are added on top: rows that stay keep selection and cursor.
    const auto known = m_entries.empty()
                           ? entries.end()
                           : std::ranges::find(entries, m_entries.front().number, &JournalEntry::number);
    const auto isKnown = [](const JournalEntry &now, const JournalEntry &then) { return now.number == then.number; };
    const auto left = static_cast<std::size_t>(entries.end() - known);
    if (known != entries.end() && left <= m_entries.size()
        && std::equal(known, entries.end(), m_entries.begin(), isKnown)) {
        const auto added = static_cast<int>(known - entries.begin());
        return insertNewest(std::move(entries), added);
    }
    beginResetModel();
    m_entries = std::move(entries);
    endResetModel();
}

void JournalModel::insertNewest(std::vector<JournalEntry> entries, int added)
{
    const auto stay = static_cast<int>(entries.size()) - added;
    if (stay < rowCount()) {
        beginRemoveRows({}, stay, rowCount() - 1);
        m_entries.resize(static_cast<std::size_t>(stay));
        endRemoveRows();
    }
    if (added > 0)
        beginInsertRows({}, 0, added - 1);
    m_entries = std::move(entries);
    if (added > 0)
        endInsertRows();
    if (stay > 0)
        emit dataChanged(index(added, 0), index(added + stay - 1, JournalColumns - 1));
}

int JournalModel::rowCount(const QModelIndex &parent) const
{
    return parent.isValid() ? 0 : static_cast<int>(m_entries.size());
}

int JournalModel::columnCount(const QModelIndex &parent) const
{
    return parent.isValid() ? 0 : JournalColumns;
}

qint64 JournalModel::numberAt(int row) const
{
    return m_entries[static_cast<std::size_t>(row)].number;
}

int JournalModel::rowOf(qint64 number) const
{
    const auto at = std::ranges::find(m_entries, number, &JournalEntry::number);
    return at == m_entries.end() ? -1 : static_cast<int>(at - m_entries.begin());
}

QString JournalModel::stateText(const JournalEntry &entry) const
{
    const bool done = entry.state == JournalState::Done;
    if (entry.undoes > 0)
        return done ? tr("undo of %1").arg(entry.undoes) : tr("undo of %1, failed").arg(entry.undoes);
    if (entry.redoes > 0)
        return done ? tr("redo of %1").arg(entry.redoes) : tr("redo of %1, failed").arg(entry.redoes);
    switch (entry.state) {
    case JournalState::Begun: return tr("end not noted");
    case JournalState::Unconfirmed: return tr("not confirmed");
    case JournalState::Failed: return tr("failed");
    case JournalState::Done: break;
    }
    return m_undone.contains(entry.number) ? tr("undone") : QString();
}

QString JournalModel::authorText(JournalAuthor author)
{
    switch (author) {
    case JournalAuthor::Window: return tr("window");
    case JournalAuthor::CommandLine: return tr("dxl");
    case JournalAuthor::Profile: return tr("profile");
    case JournalAuthor::Undo: return tr("undo");
    case JournalAuthor::Stop: return tr("STOP");
    case JournalAuthor::Packing: return tr("packing");
    }
    return {};
}

QString JournalModel::kindText(JournalKind kind)
{
    switch (kind) {
    case JournalKind::Write: return tr("write");
    case JournalKind::Reboot: return tr("reboot");
    case JournalKind::FactoryReset: return tr("factory reset");
    case JournalKind::Clear: return tr("clear");
    case JournalKind::Backup: return tr("backup");
    case JournalKind::Restore: return tr("restore");
    case JournalKind::Packet: return tr("packet");
    }
    return {};
}

QString JournalModel::text(const JournalEntry &entry, JournalColumn column) const
{
    switch (column) {
    case JournalColumn::Number: return QString::number(entry.number);
    case JournalColumn::Time: return QLocale().toString(entry.at.toLocalTime(), QStringLiteral("yyyy-MM-dd HH:mm:ss"));
    case JournalColumn::By: return authorText(entry.by);
    case JournalColumn::Device: return deviceText(entry.device);
    case JournalColumn::Register:
        return entry.kind == JournalKind::Write ? whatText(entry) : kindText(entry.kind);
    case JournalColumn::Change: return withBaudTexts(changeText(m_catalog, entry));
    case JournalColumn::State: return stateText(entry);
    }
    return {};
}

QVariant JournalModel::data(const QModelIndex &index, int role) const
{
    if (!index.isValid())
        return {};
    const JournalEntry &entry = m_entries[static_cast<std::size_t>(index.row())];
    const auto column = static_cast<JournalColumn>(index.column());
    if (role == Qt::DisplayRole)
        return text(entry, column);
    if (role == Qt::TextAlignmentRole && column == JournalColumn::Number)
        return QVariant(Qt::AlignRight | Qt::AlignVCenter);
    if (role == Qt::ToolTipRole && column == JournalColumn::State && !entry.note.isEmpty())
        return withBaudTexts(entry.note).toHtmlEscaped();
    if (role == Qt::ToolTipRole && entry.kind == JournalKind::Write) {
        QStringList lines;
        for (const RegisterChange &change : entry.changes) {
            const QString line =
                tr("%1: %2 → %3")
                    .arg(registerText(change), valueText(m_catalog, entry.device, change, change.before),
                         valueText(m_catalog, entry.device, change, change.after));
            lines << withBaudTexts(line).toHtmlEscaped();
        }
        return lines.join(QStringLiteral("<br>"));
    }
    return {};
}

QVariant JournalModel::headerData(int section, Qt::Orientation orientation, int role) const
{
    if (orientation != Qt::Horizontal || role != Qt::DisplayRole)
        return QAbstractTableModel::headerData(section, orientation, role);
    switch (static_cast<JournalColumn>(section)) {
    case JournalColumn::Number: return tr("No.");
    case JournalColumn::Time: return tr("Time");
    case JournalColumn::By: return tr("By");
    case JournalColumn::Device: return tr("Device");
    case JournalColumn::Register: return tr("Register");
    case JournalColumn::Change: return tr("Change");
    case JournalColumn::State: return tr("State");
    }
    return {};
}

} // namespace dynascope
