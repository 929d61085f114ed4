// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/dashboard/dashboardmodel.h"

#include "ui/common/texts.h"

#include <algorithm>
#include <utility>

namespace dynascope {
namespace {

constexpr std::chrono::seconds KeptOrder{1};

const DashboardRow *find(const std::vector<DashboardRow> &rows, DeviceKey key)
{
    const auto at = std::ranges::find(rows, key, &DashboardRow::key);
    return at == rows.end() ? nullptr : &*at;
}

} // namespace

DashboardModel::DashboardModel(const Session &session, const AlarmWatch &watch, QObject *parent)
    : QAbstractTableModel(parent), m_session(session), m_watch(watch)
{
}

/// In the order of lines, baud rates and IDs.
std::vector<DashboardRow> DashboardModel::makeRows() const
{
    std::vector<DashboardRow> rows;
    for (const Device *device : m_session.devices()) {
        if (const Vitals *vitals = m_watch.vitals(device->key()))
            rows.push_back(dashboardRow(*device, *vitals, m_watch.alarms(), m_units));
    }
    return rows;
}

void DashboardModel::refresh(LineTime now)
{
    std::vector<DashboardRow> wanted = makeRows();
    removeOthers(wanted);
    const bool isNew = wanted.size() != m_rows.size();
    insertMissing(wanted);
    std::ranges::stable_sort(wanted, {}, &DashboardRow::severity);
    std::vector<DeviceKey> keys;
    for (const DashboardRow &row : wanted)
        keys.push_back(row.key);
    update(std::move(wanted));
    if (std::ranges::equal(m_rows, keys, {}, &DashboardRow::key))
        return;
    if (!isNew && m_ordered && now - *m_ordered < KeptOrder)
        return;
    m_ordered = now;
    order(std::move(keys));
}

void DashboardModel::removeOthers(const std::vector<DashboardRow> &wanted)
{
    m_isChanging = true;
    for (int row = rowCount() - 1; row >= 0; --row) {
        if (find(wanted, m_rows[static_cast<std::size_t>(row)].key))
            continue;
        beginRemoveRows({}, row, row);
        m_rows.erase(m_rows.begin() + row);
        endRemoveRows();
    }
    m_isChanging = false;
}

void DashboardModel::insertMissing(const std::vector<DashboardRow> &wanted)
{
    for (const DashboardRow &row : wanted) {
        if (find(m_rows, row.key))
            continue;
        beginInsertRows({}, rowCount(), rowCount());
        m_rows.push_back(row);
        endInsertRows();
    }
}

/// The rows stay where they are.
void DashboardModel::update(std::vector<DashboardRow> wanted)
{
    for (int row = 0; row < rowCount(); ++row) {
        DashboardRow &shown = m_rows[static_cast<std::size_t>(row)];
        const auto now = std::ranges::find(wanted, shown.key, &DashboardRow::key);
        if (now == wanted.end() || *now == shown)
            continue;
        shown = std::move(*now);
        emit dataChanged(index(row, 0), index(row, DashboardColumns - 1));
    }
}

void DashboardModel::order(std::vector<DeviceKey> wanted)
{
    emit layoutAboutToBeChanged({}, VerticalSortHint);
    const std::vector<DashboardRow> before = m_rows;
    for (std::size_t i = 0; i < wanted.size(); ++i)
        m_rows[i] = *find(before, wanted[i]);
    const QModelIndexList old = persistentIndexList();
    QModelIndexList moved;
    for (const QModelIndex &one : old)
        moved << index(rowOf(before[static_cast<std::size_t>(one.row())].key), one.column());
    changePersistentIndexList(old, moved);
    emit layoutChanged({}, VerticalSortHint);
}

const DashboardRow *DashboardModel::row(int row) const
{
    return row >= 0 && row < rowCount() ? &m_rows[static_cast<std::size_t>(row)] : nullptr;
}

int DashboardModel::rowOf(DeviceKey key) const
{
    const auto at = std::ranges::find(m_rows, key, &DashboardRow::key);
    return at == m_rows.end() ? -1 : static_cast<int>(at - m_rows.begin());
}

int DashboardModel::rowCount(const QModelIndex &parent) const
{
    return parent.isValid() ? 0 : static_cast<int>(m_rows.size());
}

int DashboardModel::columnCount(const QModelIndex &parent) const
{
    return parent.isValid() ? 0 : DashboardColumns;
}

QVariant DashboardModel::data(const QModelIndex &index, int role) const
{
    if (!checkIndex(index, CheckIndexOption::IndexIsValid))
        return {};
    const DashboardRow &row = m_rows[static_cast<std::size_t>(index.row())];
    const auto column = static_cast<DashboardColumn>(index.column());
    if (role == SeverityRole)
        return static_cast<int>(row.severity);
    if (role == Qt::TextAlignmentRole) {
        const bool isText = column == DashboardColumn::Device || column == DashboardColumn::State;
        return static_cast<int>((isText ? Qt::AlignLeft : Qt::AlignRight) | Qt::AlignVCenter);
    }
    if (const auto vital = vitalOf(column)) {
        const DashboardCell &cell = row.cells[static_cast<std::size_t>(*vital)];
        switch (role) {
        case Qt::DisplayRole:
        case Qt::AccessibleTextRole:
            return cell.number.isEmpty() ? QStringLiteral("–")
                   : cell.unit.isEmpty() ? cell.number
                                         : cell.number + u' ' + cell.unit;
        case Qt::ToolTipRole: return plainToolTip(cell.help);
        case NumberRole: return cell.number;
        case UnitRole: return cell.unit;
        case PartRole: return cell.part ? QVariant(*cell.part) : QVariant();
        case LevelRole: return static_cast<int>(cell.level);
        default: return {};
        }
    }
    switch (role) {
    case Qt::DisplayRole:
        return column == DashboardColumn::Device ? row.name
               : column == DashboardColumn::Id   ? QString::number(row.id)
                                                 : row.state;
    case Qt::AccessibleTextRole:
        return column == DashboardColumn::Device ? QStringLiteral("%1, %2").arg(row.name, severityText(row.severity))
                                                 : data(index, Qt::DisplayRole);
    case Qt::ToolTipRole:
        return plainToolTip(
            column == DashboardColumn::State && !row.stateHelp.isEmpty()
                ? row.stateHelp
                : QStringLiteral("%1, ID %2: %3").arg(row.name).arg(row.id).arg(severityText(row.severity)));
    case LevelRole:
        return static_cast<int>(column == DashboardColumn::State
                                    ? row.cells[static_cast<std::size_t>(Vital::Error)].level
                                    : AlarmLevel::None);
    default: return {};
    }
}

QVariant DashboardModel::headerData(int section, Qt::Orientation orientation, int role) const
{
    if (orientation != Qt::Horizontal || section < 0 || section >= DashboardColumns)
        return {};
    const auto column = static_cast<DashboardColumn>(section);
    switch (role) {
    case Qt::DisplayRole: return dashboardHeading(column);
    case Qt::ToolTipRole: return dashboardHelp(column);
    case Qt::TextAlignmentRole: {
        const bool isText = column == DashboardColumn::Device || column == DashboardColumn::State;
        return static_cast<int>((isText ? Qt::AlignLeft : Qt::AlignRight) | Qt::AlignVCenter);
    }
    default: return {};
    }
}

QString DashboardModel::summary() const
{
    QStringList parts{m_rows.size() == 1 ? tr("1 device") : tr("%1 devices").arg(m_rows.size())};
    for (const Severity severity :
         {Severity::Fault, Severity::Silent, Severity::Over, Severity::Near, Severity::Unknown}) {
        if (const auto count = std::ranges::count(m_rows, severity, &DashboardRow::severity))
            parts << QStringLiteral("%1 %2").arg(count).arg(severityText(severity));
    }
    if (parts.size() == 1 && !m_rows.empty())
        parts << tr("all good");
    return parts.join(QStringLiteral(" · "));
}

QString DashboardModel::limitsSummary() const
{
    const auto all = static_cast<qsizetype>(m_rows.size());
    const auto own = std::ranges::count(m_rows, LimitSource::Device, &DashboardRow::limits);
    if (all == 0)
        return {};
    if (own == all)
        return tr("Limits: the devices' own registers");
    if (own == 0)
        return tr("Limits: factory values, until the devices' own are read");
    return tr("Limits: own registers of %1 of %2 devices, else factory values").arg(own).arg(all);
}

} // namespace dynascope
