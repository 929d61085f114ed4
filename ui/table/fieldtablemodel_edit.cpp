// SPDX-License-Identifier: GPL-3.0-or-later
// Edits: of one device, or of all if all can be written.
#include "ui/table/consequencesdialog.h"
#include "ui/table/fieldtablemodel.h"

#include <map>
#include <tuple>

namespace dynascope {
namespace {

constexpr qsizetype MostReasons = 3; ///< of devices that refuse; more would only push the message out of the window

} // namespace

bool FieldTableModel::setData(const QModelIndex &index, const QVariant &value, int role)
{
    const int row = rowOf(index);
    if (row < 0)
        return false;
    const Column column = columnAt(index.column());
    if (role == Qt::CheckStateRole && column.kind == ColumnKind::Plot)
        return setPlotted(row, value.toInt() == Qt::Checked);
    if (role != Qt::EditRole || !flags(index).testFlag(Qt::ItemIsEditable))
        return false;
    const std::int64_t raw = value.toLongLong();
    if (column.kind == ColumnKind::All)
        return writeAll(row, raw);
    const bool isLocked = !valueData(row, column.device, LockRole).toString().isEmpty();
    return (!isLocked || isToBeAsked(row, column.device, raw)) && write(row, {{column.device, raw}});
}

bool FieldTableModel::setPlotted(int row, bool on)
{
    for (const Watch &watch : watches({indexOf(row, 0)})) {
        if (on)
            emit plotRequested(watch);
        else
            emit unplotRequested(watch);
    }
    return true;
}

/// `wanted`: devices with their raw values, all checked.
bool FieldTableModel::write(int row, const std::vector<std::pair<int, std::int64_t>> &wanted)
{
    bool written = false;
    std::vector<Device *> unknown;
    std::map<std::tuple<const ControlTable *, int, std::int64_t>, std::vector<Device *>> asked; // a question for each model
    for (const auto &[device, raw] : wanted) {
        const FieldValue &now = value(row, device);
        if (now.raw == raw && !now.pending && now.state != FieldState::Failed)
            continue;
        if (isToBeAsked(row, device, raw))
            asked[{&deviceAt(device).table(), m_rows.fieldOf(row, device), raw}].push_back(&deviceAt(device));
        else if (field(row, device).mayBeTried())
            unknown.push_back(&deviceAt(device));
        else
            m_actions.write(deviceAt(device), m_rows.fieldOf(row, device), raw);
        written = true;
    }
    if (!unknown.empty())
        emit confirmationWanted(unknown, m_rows.fieldOf(row, wanted.front().first), wanted.front().second);
    for (const auto &[what, devices] : asked)
        emit consequencesWanted(devices, std::get<1>(what), std::get<2>(what));
    return written;
}

bool FieldTableModel::isToBeAsked(int row, int device, std::int64_t raw) const
{
    const int index = m_rows.fieldOf(row, device);
    if (!m_actions.writeSafely || index < 0 || field(row, device).mayBeTried())
        return false;
    const Device &of = deviceAt(device);
    const bool isLocked = !of.lockReason(index, true).isEmpty();
    return isLocked ? isLockedByTorqueAlone(of, index) : areSerious(consequencesOf(of, index, raw));
}

bool FieldTableModel::writeAll(int row, std::int64_t raw)
{
    if (const QString reason = lockOfAll(row); !reason.isEmpty()) {
        emit refused(tr("Nothing was written. %1").arg(reason));
        return false;
    }
    const ComparedCell reference = compared(row, m_rows.deviceWith(row));
    std::vector<std::pair<int, std::int64_t>> wanted;
    QStringList reasons;
    for (int device = 0; device < static_cast<int>(m_devices.size()); ++device) {
        const Result<std::int64_t> own = carriedOver(reference, raw, compared(row, device));
        if (own)
            wanted.emplace_back(device, *own);
        else if (reasons.size() < MostReasons)
            reasons << tr("%1: %2").arg(deviceAt(device).displayName(), own.error().text);
    }
    if (reasons.isEmpty())
        return write(row, wanted);
    emit refused(tr("Nothing was written to any of the %1 devices. %2.")
                     .arg(m_devices.size())
                     .arg(reasons.join(QStringLiteral("; "))));
    return false;
}

std::optional<std::int64_t> FieldTableModel::forAll(const QModelIndex &cell) const
{
    const int row = rowOf(cell);
    const int device = columnAt(cell.column()).device;
    if (row < 0 || !value(row, device).raw)
        return std::nullopt;
    const ComparedCell own = compared(row, device);
    const Result<std::int64_t> there = carriedOver(own, *own.raw, compared(row, m_rows.deviceWith(row)));
    return there ? std::optional(*there) : std::nullopt;
}

/// Why not all devices can be written; the first few that stand in the way.
QString FieldTableModel::lockOfAll(int row) const
{
    QStringList reasons;
    const ControlTable &first = deviceAt(m_rows.deviceWith(row)).table();
    for (int device = 0; device < static_cast<int>(m_devices.size()) && reasons.size() < MostReasons; ++device) {
        const Device &of = deviceAt(device);
        const QString reason = valueData(row, device, LockRole).toString();
        if (!reason.isEmpty())
            reasons << (reason.contains(of.displayName()) ? reason : tr("%1: %2").arg(of.displayName(), reason));
        else if (field(row, device).mayBeTried() && &of.table() != &first)
            reasons << tr("%1: nobody knows whether %2 may be written. Edit one device at a time.")
                           .arg(of.displayName(), field(row, device).name);
    }
    return reasons.join(u' ');
}

} // namespace dynascope
