// SPDX-License-Identifier: GPL-3.0-or-later
// What the cells hold, and how the devices compare.
#include "ui/table/fieldtablemodel.h"

#include "core/table/indirect.h"

#include <algorithm>

namespace dynascope {

const Field &FieldTableModel::field(int row, int device) const
{
    const int with = m_rows.deviceWith(row, device);
    return deviceAt(with).table().fields()[static_cast<std::size_t>(m_rows.fieldOf(row, with))];
}

const FieldValue &FieldTableModel::value(int row, int device) const
{
    static const FieldValue nothing;
    const int index = m_rows.fieldOf(row, device);
    return index < 0 ? nothing : deviceAt(device).value(index);
}

ComparedCell FieldTableModel::compared(int row, int device) const
{
    const Device &of = deviceAt(device);
    const int index = m_rows.fieldOf(row, device);
    return {&field(row, device), of.effective(index), of.table().resolution(), of.value(index).raw};
}

QVariant FieldTableModel::rowData(int row, const Column &column, int role) const
{
    const int with = m_rows.deviceWith(row, column.device);
    switch (role) {
    case FieldRole: return row;
    case FieldDataRole: return QVariant::fromValue(&field(row, with));
    case EffectiveRole: return QVariant::fromValue(deviceAt(with).effective(m_rows.fieldOf(row, with)));
    case ControlTableRole: return QVariant::fromValue(deviceAt(with).sharedTable());
    case ResolutionRole: return deviceAt(with).table().resolution();
    case AbsentRole: return column.kind == ColumnKind::Device ? absence(row, column.device) : QString();
    case AddressesRole: return addresses(row);
    case RamStateRole: return static_cast<int>(ramState(row, column));
    case WatchedRole: return static_cast<int>(watched(row));
    case Qt::CheckStateRole:
        return column.kind == ColumnKind::Plot ? QVariant(static_cast<int>(watched(row))) : QVariant();
    case ChangedFromDefaultRole:
    case DiffersRole: {
        const auto is = [&](int device) {
            return role == DiffersRole ? differs(row, device) : isChangedFromDefault(row, device);
        };
        if (isValueKind(column.kind) && column.kind != ColumnKind::All)
            return is(column.device);
        for (int device = 0; device < static_cast<int>(m_devices.size()); ++device) {
            if (is(device))
                return true;
        }
        return false;
    }
    default: break;
    }
    if (column.kind == ColumnKind::All)
        return allData(row, role);
    return isValueKind(column.kind) ? valueData(row, column.device, role) : QVariant();
}

QVariant FieldTableModel::valueData(int row, int device, int role) const
{
    const FieldValue &value = this->value(row, device);
    switch (role) {
    case RawRole:
    case Qt::EditRole: return value.raw ? QVariant(static_cast<qlonglong>(*value.raw)) : QVariant();
    case StateRole: return static_cast<int>(value.state);
    case ErrorRole: return value.error;
    case FadeRole: return m_tracker.fade(device, row);
    case PendingRole:
        return value.pending && m_tracker.showsPending(device, row) ? QVariant(static_cast<qlonglong>(*value.pending))
                                                                    : QVariant();
    case LockRole: {
        const QString none = absence(row, device);
        return none.isEmpty() ? deviceAt(device).lockReason(m_rows.fieldOf(row, device), true) : none;
    }
    case PointsAtRole: {
        const std::optional<std::int64_t> address = pointsAt(row, device);
        return address ? QVariant(static_cast<qlonglong>(*address)) : QVariant();
    }
    default: return {};
    }
}

/// The column for all says what they have in common.
QVariant FieldTableModel::allData(int row, int role) const
{
    switch (role) {
    case MixedRole: return isMixed(row);
    case LockRole: return lockOfAll(row);
    case RawRole:
    case Qt::EditRole:
    case PointsAtRole: return isMixed(row) ? QVariant() : valueData(row, m_rows.deviceWith(row), role);
    case StateRole: {
        FieldState state = FieldState::Fresh;
        for (int device = 0; device < static_cast<int>(m_devices.size()); ++device) {
            const FieldValue &value = this->value(row, device);
            if (m_rows.fieldOf(row, device) >= 0 && !value.raw)
                return static_cast<int>(FieldState::Unknown);
            if (value.state == FieldState::Stale)
                state = FieldState::Stale;
        }
        return static_cast<int>(state);
    }
    default: return {};
    }
}

QString FieldTableModel::absence(int row, int device) const
{
    if (m_rows.fieldOf(row, device) >= 0)
        return {};
    const Device &of = deviceAt(device);
    return tr("Not on this model: %1 with firmware %2 has no %3.")
        .arg(of.displayName())
        .arg(of.firmware())
        .arg(field(row, device).name);
}

/// Any two of those that have it, whether or not it is a setting.
bool FieldTableModel::isMixed(int row) const
{
    const int first = m_rows.deviceWith(row);
    const ComparedCell reference = compared(row, first);
    for (int device = first + 1; device < static_cast<int>(m_devices.size()); ++device) {
        if (m_rows.fieldOf(row, device) >= 0 && holdDifferent(reference, compared(row, device)))
            return true;
    }
    return false;
}

std::optional<std::int64_t> FieldTableModel::pointsAt(int row, int device) const
{
    const int index = m_rows.fieldOf(row, device);
    if (index < 0)
        return std::nullopt;
    const Device &of = deviceAt(device);
    const Field &own = field(row, device);
    if (indirectAddressNumber(own) > 0)
        return of.value(index).raw;
    const int address = indirectAddressOf(of.table(), own);
    return address < 0 ? std::nullopt : of.value(address).raw;
}

bool FieldTableModel::differs(int row, int device) const
{
    const int first = m_rows.deviceWith(row);
    return device != first && m_rows.fieldOf(row, device) >= 0 && isSharedSetting(field(row, device))
           && holdDifferent(compared(row, first), compared(row, device));
}

bool FieldTableModel::isChangedFromDefault(int row, int device) const
{
    const Field &of = field(row, device);
    const auto raw = value(row, device).raw;
    return of.isWritable() && of.initial && raw && *raw != *of.initial;
}

Qt::CheckState FieldTableModel::watched(int row) const
{
    int count = 0;
    int all = 0;
    for (int device = 0; device < static_cast<int>(m_devices.size()); ++device) {
        const int index = m_rows.fieldOf(row, device);
        all += index >= 0 ? 1 : 0;
        count += index >= 0 && m_actions.isWatched({deviceAt(device).key(), index}) ? 1 : 0;
    }
    return count == 0 ? Qt::Unchecked : count == all ? Qt::Checked : Qt::PartiallyChecked;
}

/// The one that matters most.
RamState FieldTableModel::ramState(int row, const Column &column) const
{
    const bool isOfOne = isValueKind(column.kind) && column.kind != ColumnKind::All;
    RamState state = RamState::NotSet;
    for (int i = 0; m_actions.ramState && i < static_cast<int>(m_devices.size()); ++i) {
        const int index = m_rows.fieldOf(row, i);
        if (index >= 0 && (!isOfOne || column.device == i))
            state = std::max(state, m_actions.ramState({deviceAt(i).key(), index}));
    }
    return state;
}

/// "168", and besides where the tables differ, each with whose it is.
QStringList FieldTableModel::addresses(int row) const
{
    QStringList lines;
    std::set<int> different;
    std::set<const ControlTable *> said;
    for (int device = 0; device < static_cast<int>(m_devices.size()); ++device) {
        const Device &of = deviceAt(device);
        if (m_rows.fieldOf(row, device) < 0 || !said.insert(&of.table()).second)
            continue;
        different.insert(field(row, device).address);
        lines << tr("%1, firmware %2: %3").arg(of.model()).arg(of.firmware()).arg(field(row, device).address);
    }
    return different.size() > 1 ? lines : QStringList();
}

} // namespace dynascope
