// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/library/registermodel.h"

#include "core/table/indirect.h"
#include "ui/common/fieldtexts.h"
#include "ui/common/icons.h"
#include "ui/common/texts.h"
#include "ui/common/theme.h"
#include "ui/library/firmwarechanges.h"
#include "ui/library/librarydelegate.h"
#include "ui/library/librarytexts.h"
#include "ui/table/tableroles.h"

#include <QGuiApplication>

#include <algorithm>

namespace dynascope {
namespace {

constexpr quintptr TopLevel = 0; ///< internal id of what isn't below a run; else it is the run's row + 1

bool isNumber(int column)
{
    return column == RegisterModel::Address || column == RegisterModel::Size || column == RegisterModel::Default;
}

} // namespace

RegisterModel::RegisterModel(QObject *parent)
    : QAbstractItemModel(parent), m_numbers(numberFont(QGuiApplication::font()))
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
    m_rows.clear();
    const std::vector<FieldRun> runs = m_table ? longRuns(*m_table) : std::vector<FieldRun>();
    auto run = runs.begin();
    const int count = m_table ? static_cast<int>(m_table->fields().size()) : 0;
    for (int field = 0; field < count; field = m_rows.back().last + 1) {
        const bool isRun = run != runs.end() && run->first == field;
        m_rows.push_back({field, isRun ? run->last : field});
        run += isRun ? 1 : 0;
    }
    endResetModel();
}

QModelIndex RegisterModel::index(int row, int column, const QModelIndex &parent) const
{
    if (!hasIndex(row, column, parent))
        return {};
    return createIndex(row, column, parent.isValid() ? static_cast<quintptr>(parent.row()) + 1 : TopLevel);
}

QModelIndex RegisterModel::parent(const QModelIndex &child) const
{
    if (!child.isValid() || child.internalId() == TopLevel)
        return {};
    return createIndex(static_cast<int>(child.internalId() - 1), 0, TopLevel);
}

QModelIndex RegisterModel::indexOf(int field, Column column) const
{
    const auto at = std::ranges::find_if(m_rows, [field](const Row &row) {
        return row.first <= field && field <= row.last;
    });
    if (at == m_rows.end())
        return {};
    const auto row = static_cast<int>(at - m_rows.begin());
    return at->isRun() ? createIndex(field - at->first, column, static_cast<quintptr>(row) + 1)
                       : createIndex(row, column, TopLevel);
}

const RegisterModel::Row *RegisterModel::runAt(const QModelIndex &index) const
{
    if (!index.isValid() || index.internalId() != TopLevel)
        return nullptr;
    const Row &row = m_rows[static_cast<std::size_t>(index.row())];
    return row.isRun() ? &row : nullptr;
}

int RegisterModel::fieldAt(const QModelIndex &index) const
{
    if (index.internalId() == TopLevel)
        return m_rows[static_cast<std::size_t>(index.row())].first;
    return m_rows[static_cast<std::size_t>(index.internalId()) - 1].first + index.row();
}

int RegisterModel::rowCount(const QModelIndex &parent) const
{
    if (!parent.isValid())
        return static_cast<int>(m_rows.size());
    const Row *run = parent.column() == 0 ? runAt(parent) : nullptr;
    return run ? run->last - run->first + 1 : 0;
}

int RegisterModel::columnCount(const QModelIndex & /*parent*/) const
{
    return ColumnCount;
}

QString RegisterModel::text(const Field &field, Column column, int index) const
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
    case Firmware: return m_marks.value(index);
    case ColumnCount: break;
    }
    return {};
}

QString RegisterModel::toolTip(const Field &field, Column column, int index) const
{
    switch (column) {
    case Address: return addressText(field.address);
    case Name: return field.doubt.isEmpty() ? field.help : tr("%1\nDoubtful: %2").arg(field.help, field.doubt);
    case Size: return sizeText(field);
    case AccessColumn:
        return field.needsTorqueOff() ? tr("%1, while torque is off").arg(accessText(field)) : accessText(field);
    case Default: return field.initial ? withBaudTexts(meaning(field, *field.initial)) : QString();
    case Firmware: return firmwareChanges(field, *m_table, m_all).join(u'\n');
    default: return text(field, column, index);
    }
}

/// A run says what its first register says, and how many there are.
QVariant RegisterModel::runData(const Row &run, Column column, int role) const
{
    const Field &first = m_table->fields()[static_cast<std::size_t>(run.first)];
    const Field &last = m_table->fields()[static_cast<std::size_t>(run.last)];
    const QString name = tr("%1 – %2").arg(first.name, last.name.section(u' ', -1));
    switch (role) {
    case GroupRole: return name;
    case Qt::DisplayRole:
    case Qt::AccessibleTextRole:
        if (column == Name)
            return name;
        return column == Address || column == AreaColumn || column == AccessColumn ? text(first, column, run.first)
                                                                                   : QString();
    case Qt::ToolTipRole:
        if (column != Name)
            return {};
        return tr("%1 registers: unfold them with the arrow").arg(run.last - run.first + 1);
    default: return {};
    }
}

QVariant RegisterModel::data(const QModelIndex &index, int role) const
{
    if (!checkIndex(index, CheckIndexOption::IndexIsValid))
        return {};
    const auto column = static_cast<Column>(index.column());
    if (role == Qt::TextAlignmentRole)
        return static_cast<int>((isNumber(column) ? Qt::AlignRight : Qt::AlignLeft) | Qt::AlignVCenter);
    if (role == Qt::FontRole)
        return isNumber(column) ? QVariant(m_numbers) : QVariant();
    if (const Row *run = runAt(index))
        return runData(*run, column, role);
    const int at = fieldAt(index);
    const Field &field = m_table->fields()[static_cast<std::size_t>(at)];
    switch (role) {
    case FieldDataRole: return QVariant::fromValue(&field);
    case Qt::DisplayRole: return text(field, column, at);
    case Qt::ToolTipRole: return plainToolTip(toolTip(field, column, at));
    case Qt::AccessibleTextRole:
        if (column == Size || column == AccessColumn)
            return toolTip(field, column, at);
        if (column == Name && !field.doubt.isEmpty())
            return tr("%1, doubtful").arg(field.name);
        return text(field, column, at);
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
