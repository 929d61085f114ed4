// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/dashboard/alarmmodel.h"

#include "ui/common/icons.h"
#include "ui/common/texts.h"

#include <algorithm>

namespace dynascope {
namespace {

/// The day only where it is another one.
QString timeText(const QDateTime &at, const QDate &today)
{
    return at.toString(at.date() == today ? QStringLiteral("HH:mm:ss") : QStringLiteral("yyyy-MM-dd HH:mm:ss"));
}

} // namespace

AlarmModel::AlarmModel(const AlarmWatch &watch, QObject *parent) : QAbstractTableModel(parent), m_watch(watch)
{
    connect(&watch, &AlarmWatch::alarmsChanged, this, &AlarmModel::refresh);
    refresh();
}

void AlarmModel::refresh()
{
    const auto &list = m_watch.alarms().list();
    std::vector<Alarm> now(list.rbegin(), list.rend());
    // Mostly one is added on top or one ends: rows that stay keep selection and cursor.
    const quint64 newest = m_alarms.empty() ? 0 : m_alarms.front().number;
    const auto known = std::ranges::find_if(now, [newest](const Alarm &alarm) { return alarm.number <= newest; });
    const bool stay = std::equal(known, now.end(), m_alarms.begin(), m_alarms.end(),
                                 [](const Alarm &one, const Alarm &other) { return one.number == other.number; });
    if (!stay) {
        beginResetModel();
        m_alarms = std::move(now);
        endResetModel();
        return;
    }
    const auto added = static_cast<int>(known - now.begin());
    if (added > 0)
        beginInsertRows({}, 0, added - 1);
    m_alarms = std::move(now);
    if (added > 0)
        endInsertRows();
    if (rowCount() > added)
        emit dataChanged(index(added, 0), index(rowCount() - 1, AlarmColumns - 1));
}

const Alarm *AlarmModel::alarm(int row) const
{
    return row >= 0 && row < rowCount() ? &m_alarms[static_cast<std::size_t>(row)] : nullptr;
}

std::size_t AlarmModel::active() const
{
    return static_cast<std::size_t>(std::ranges::count_if(m_alarms, &Alarm::isActive));
}

int AlarmModel::rowCount(const QModelIndex &parent) const
{
    return parent.isValid() ? 0 : static_cast<int>(m_alarms.size());
}

int AlarmModel::columnCount(const QModelIndex &parent) const
{
    return parent.isValid() ? 0 : AlarmColumns;
}

QString AlarmModel::text(const Alarm &alarm, AlarmColumn column) const
{
    const QDate today = QDate::currentDate();
    switch (column) {
    case AlarmColumn::Time: return timeText(alarm.raised, today);
    case AlarmColumn::Device: return alarm.name;
    case AlarmColumn::Kind: return alarmKindText(alarm.kind);
    case AlarmColumn::Cause: return withMinus(alarm.cause);
    case AlarmColumn::Cleared:
        if (alarm.isActive())
            return tr("lasts");
        return alarm.deviceWent ? tr("%1, device went").arg(timeText(alarm.cleared, today))
                                : timeText(alarm.cleared, today);
    }
    return {};
}

QVariant AlarmModel::data(const QModelIndex &index, int role) const
{
    if (!checkIndex(index, CheckIndexOption::IndexIsValid))
        return {};
    const Alarm &alarm = m_alarms[static_cast<std::size_t>(index.row())];
    const auto column = static_cast<AlarmColumn>(index.column());
    const bool isOver = alarm.level == AlarmLevel::Over;
    switch (role) {
    case Qt::DisplayRole: return text(alarm, column);
    case Qt::AccessibleTextRole:
        return column != AlarmColumn::Kind ? text(alarm, column)
               : isOver                    ? tr("%1, beyond its limit").arg(text(alarm, column))
                                           : tr("%1, near its limit").arg(text(alarm, column));
    case Qt::DecorationRole:
        if (column != AlarmColumn::Kind)
            return {};
        return icon(isOver ? QStringLiteral("error") : QStringLiteral("warning"), !alarm.isActive() ? IconTint::Dimmed
                                                                                  : isOver          ? IconTint::Bad
                                                                                           : IconTint::Warning);
    case ActiveRole: return alarm.isActive();
    case Qt::ToolTipRole: return plainToolTip(QStringLiteral("%1: %2").arg(alarm.name, withMinus(alarm.cause)));
    default: return {};
    }
}

QVariant AlarmModel::headerData(int section, Qt::Orientation orientation, int role) const
{
    if (orientation != Qt::Horizontal || section < 0 || section >= AlarmColumns)
        return {};
    if (role == Qt::TextAlignmentRole)
        return static_cast<int>(Qt::AlignLeft | Qt::AlignVCenter);
    if (role != Qt::DisplayRole)
        return {};
    switch (static_cast<AlarmColumn>(section)) {
    case AlarmColumn::Time: return tr("Time");
    case AlarmColumn::Device: return tr("Device");
    case AlarmColumn::Kind: return tr("Alarm");
    case AlarmColumn::Cause: return tr("Cause");
    case AlarmColumn::Cleared: return tr("Over at");
    }
    return {};
}

} // namespace dynascope
