// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/library/registermodel.h"

#include "ui/common/fieldtexts.h"
#include "ui/common/icons.h"
#include "ui/common/texts.h"
#include "ui/common/theme.h"
#include "ui/library/firmwarechanges.h"
#include "ui/library/librarydelegate.h"
#include "ui/library/librarytexts.h"
#include "ui/table/tableroles.h"

#include <QGuiApplication>

namespace dynascope {
namespace {

bool isNumber(int column)
{
    return column == RegisterModel::Address || column == RegisterModel::Size || column == RegisterModel::Default;
}

} // namespace

RegisterModel::RegisterModel(QObject *parent)
    : QAbstractTableModel(parent), m_numbers(numberFont(QGuiApplication::font()))
{
}

void RegisterModel::setTable(ControlTablePtr table, std::vector<ControlTablePtr> all)
{
    beginResetModel();
    m_table = std::move(table);
    m_all = std::move(all);
    m_marks.clear();
    if (m_table && hasSeveralFirmware()) {
        for (const Field &field : m_table->fields())
            m_marks << firmwareMark(field, *m_table, m_all);
    }
    endResetModel();
}

int RegisterModel::rowCount(const QModelIndex &parent) const
{
    return parent.isValid() || !m_table ? 0 : static_cast<int>(m_table->fields().size());
}

int RegisterModel::columnCount(const QModelIndex &parent) const
{
    return parent.isValid() ? 0 : ColumnCount;
}

QString RegisterModel::text(const Field &field, Column column, int row) const
{
    switch (column) {
    case Address: return QString::number(field.address);
    case Name: return field.name;
    case Size: return (field.isSigned ? QStringLiteral("±") : QString()) + QString::number(field.size);
    case AreaColumn: return field.area == Area::Unknown ? QStringLiteral("?") : areaText(field.area);
    case AccessColumn:
        return field.mayBeTried()   ? QStringLiteral("?")
               : field.isWritable() ? QStringLiteral("RW")
                                    : QStringLiteral("R");
    case Default: return field.initial ? numberText(*field.initial) : QString();
    case Range: return boundsText(field);
    case UnitColumn: return stepText(field);
    case Firmware: return m_marks.value(row);
    case ColumnCount: break;
    }
    return {};
}

QString RegisterModel::toolTip(const Field &field, Column column, int row) const
{
    switch (column) {
    case Address: return addressText(field.address);
    case Name: return field.doubt.isEmpty() ? field.help : tr("%1\nDoubtful: %2").arg(field.help, field.doubt);
    case Size: return sizeText(field);
    case AccessColumn:
        return field.needsTorqueOff() ? tr("%1, while torque is off").arg(accessText(field)) : accessText(field);
    case Default: return field.initial ? meaning(field, *field.initial) : QString();
    case Firmware: return firmwareChanges(field, *m_table, m_all).join(u'\n');
    default: return text(field, column, row);
    }
}

QVariant RegisterModel::data(const QModelIndex &index, int role) const
{
    if (!checkIndex(index, CheckIndexOption::IndexIsValid))
        return {};
    const Field &field = m_table->fields()[static_cast<std::size_t>(index.row())];
    const auto column = static_cast<Column>(index.column());
    switch (role) {
    case FieldDataRole: return QVariant::fromValue(&field);
    case Qt::DisplayRole: return text(field, column, index.row());
    case Qt::ToolTipRole: return plainToolTip(toolTip(field, column, index.row()));
    case Qt::AccessibleTextRole:
        if (column == Size || column == AccessColumn)
            return toolTip(field, column, index.row());
        if (column == Name && !field.doubt.isEmpty())
            return tr("%1, doubtful").arg(field.name);
        return text(field, column, index.row());
    case Qt::TextAlignmentRole:
        return static_cast<int>((isNumber(column) ? Qt::AlignRight : Qt::AlignLeft) | Qt::AlignVCenter);
    case Qt::FontRole: return isNumber(column) ? QVariant(m_numbers) : QVariant();
    case Qt::DecorationRole:
        if (column == Name && !field.doubt.isEmpty())
            return icon(QStringLiteral("warning"), IconTint::Warning);
        if (column == AccessColumn && field.needsTorqueOff())
            return icon(QStringLiteral("lock"), IconTint::Dimmed);
        return {};
    case LibraryDelegate::MarkedRole: return column == Firmware;
    default: return {};
    }
}

QVariant RegisterModel::headerData(int section, Qt::Orientation orientation, int role) const
{
    if (orientation != Qt::Horizontal || section < 0 || section >= ColumnCount)
        return {};
    static const std::array<QString, ColumnCount> names{tr("Address"), tr("Register"), tr("Size"),
                                                        tr("Area"),    tr("Access"),   tr("Default"),
                                                        tr("Range"),   tr("Unit"),     tr("Firmware")};
    static const std::array<QString, ColumnCount> tips{
        tr("Of the first byte"),
        tr("As the manufacturer calls it"),
        tr("Bytes; ± where it has a sign"),
        tr("EEPROM keeps its values without power; RAM does not; Hybrid is RAM that is stored on request"),
        tr("R: read only, RW: read and write; with the lock only while torque is off"),
        tr("The value from the factory"),
        tr("What may be written, as raw values; a name is the register whose value is the limit"),
        tr("What one raw step is"),
        tr("What other firmware of this model has otherwise")};
    switch (role) {
    case Qt::DisplayRole: return names[static_cast<std::size_t>(section)];
    case Qt::ToolTipRole: return tips[static_cast<std::size_t>(section)];
    case Qt::TextAlignmentRole:
        return static_cast<int>((isNumber(section) ? Qt::AlignRight : Qt::AlignLeft) | Qt::AlignVCenter);
    default: return {};
    }
}

} // namespace dynascope
