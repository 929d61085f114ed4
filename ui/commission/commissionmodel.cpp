// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/commission/commissionmodel.h"

#include "ui/common/icons.h"
#include "ui/common/texts.h"

namespace dynascope {

CommissionModel::CommissionModel(const Commissioning &commissioning, const Catalog &catalog, QObject *parent)
    : QAbstractTableModel(parent)
    , m_commissioning(commissioning)
    , m_catalog(catalog)
{
}

int CommissionModel::rowCount(const QModelIndex &parent) const
{
    return parent.isValid() ? 0 : m_rows;
}

void CommissionModel::refresh()
{
    const int rows = static_cast<int>(m_commissioning.list().size());
    if (rows != m_rows) {
        beginResetModel();
        m_rows = rows;
        endResetModel();
    } else if (rows > 0) {
        emit dataChanged(index(0, 0), index(rows - 1, CommissionColumns - 1));
    }
}

QString CommissionModel::stateText(std::size_t joint) const
{
    const CommissionList &list = m_commissioning.list();
    if (m_commissioning.settingUp() == joint)
        return tr("being set up");
    if (m_commissioning.lit() == joint)
        return tr("done, its LED is lit");
    switch (list.state(joint)) {
    case CommissionState::Skipped: return tr("skipped");
    case CommissionState::Waiting: return list.next() == joint ? tr("to be plugged in now") : tr("waits");
    case CommissionState::Done: break;
    }
    const CommissionFacts &facts = list.facts(joint);
    const QString time = facts.at.toLocalTime().toString(QStringLiteral("HH:mm"));
    return facts.wasSo ? tr("done %1, stood so already").arg(time)
                       : tr("done %1, was ID %2 at %3")
                             .arg(time, QString::number(facts.foundAt.id), baudText(facts.foundAt.baudRate));
}

QVariant CommissionModel::stateIcon(std::size_t joint) const
{
    const CommissionList &list = m_commissioning.list();
    switch (list.state(joint)) {
    case CommissionState::Done: return icon(QStringLiteral("success"), IconTint::Good);
    case CommissionState::Skipped: return icon(QStringLiteral("minus"), IconTint::Dimmed);
    case CommissionState::Waiting: break;
    }
    return list.next() == joint ? icon(QStringLiteral("plug"), IconTint::Accent)
                                : icon(QStringLiteral("servo"), IconTint::Dimmed);
}

QString CommissionModel::text(std::size_t joint, CommissionColumn column) const
{
    const CommissionList &list = m_commissioning.list();
    const CommissionJoint &wanted = list.joint(joint);
    const bool isDone = list.state(joint) == CommissionState::Done;
    switch (column) {
    case CommissionColumn::Joint: return wanted.name.isEmpty() ? jointText(wanted) : wanted.name;
    case CommissionColumn::Id: return QString::number(wanted.place.id);
    case CommissionColumn::BaudRate: return baudText(wanted.place.baudRate);
    case CommissionColumn::Model: return modelName(m_catalog, wanted.modelNumber);
    case CommissionColumn::Firmware:
        return isDone                       ? QString::number(list.facts(joint).firmware)
               : wanted.minimumFirmware > 0 ? tr("%1 or newer").arg(wanted.minimumFirmware)
                                            : QString();
    case CommissionColumn::State: return stateText(joint);
    }
    return {};
}

QVariant CommissionModel::data(const QModelIndex &index, int role) const
{
    if (!index.isValid() || index.row() >= static_cast<int>(m_commissioning.list().size()))
        return {};
    const auto joint = static_cast<std::size_t>(index.row());
    const auto column = static_cast<CommissionColumn>(index.column());
    if (role == Qt::DisplayRole)
        return text(joint, column);
    if (role == Qt::DecorationRole && column == CommissionColumn::Joint)
        return stateIcon(joint);
    if (role == Qt::AccessibleTextRole && column == CommissionColumn::Joint)
        return tr("%1, %2").arg(text(joint, column), stateText(joint));
    if (role == Qt::ToolTipRole) // narrow, it may be cut off
        return plainToolTip(text(joint, column));
    return {};
}

QVariant CommissionModel::headerData(int section, Qt::Orientation orientation, int role) const
{
    if (orientation != Qt::Horizontal)
        return {};
    if (role != Qt::DisplayRole)
        return {};
    switch (static_cast<CommissionColumn>(section)) {
    case CommissionColumn::Joint: return tr("Joint");
    case CommissionColumn::Id: return tr("ID");
    case CommissionColumn::BaudRate: return tr("Baud rate");
    case CommissionColumn::Model: return tr("Model");
    case CommissionColumn::Firmware: return tr("Firmware");
    case CommissionColumn::State: return tr("State");
    }
    return {};
}

} // namespace dynascope
