// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/library/searchmodel.h"

#include "ui/common/texts.h"
#include "ui/common/theme.h"
#include "ui/library/firmwarechanges.h"
#include "ui/library/librarydelegate.h"
#include "ui/library/librarytexts.h"

#include <QGuiApplication>

#include <array>

namespace dynascope {
namespace {

constexpr quintptr ModelLevel = 0; ///< internal id of registers; that of models is 1 + their register's row

bool holdsNumber(int column)
{
    return column == SearchModel::Address || column == SearchModel::Size;
}

} // namespace

SearchModel::SearchModel(const Catalog &catalog, QObject *parent)
    : QAbstractItemModel(parent), m_catalog(catalog), m_numbers(numberFont(QGuiApplication::font()))
{
}

void SearchModel::setMatches(const std::vector<const RegisterIndex::Entry *> &matches)
{
    beginResetModel();
    m_entries.clear();
    m_entries.reserve(matches.size());
    for (const RegisterIndex::Entry *match : matches)
        m_entries.push_back(*match);
    endResetModel();
}

const RegisterIndex::Entry *SearchModel::entry(const QModelIndex &index) const
{
    if (!index.isValid())
        return nullptr;
    const std::size_t row = index.internalId() == ModelLevel ? static_cast<std::size_t>(index.row())
                                                             : static_cast<std::size_t>(index.internalId()) - 1;
    return &m_entries[row];
}

RegisterIndex::Owner SearchModel::owner(const QModelIndex &index) const
{
    const RegisterIndex::Entry *found = entry(index);
    if (!found)
        return {};
    return found->owners[index.internalId() == ModelLevel ? 0 : static_cast<std::size_t>(index.row())];
}

QModelIndex SearchModel::index(int row, int column, const QModelIndex &parent) const
{
    if (!hasIndex(row, column, parent))
        return {};
    return createIndex(row, column, parent.isValid() ? static_cast<quintptr>(parent.row()) + 1 : ModelLevel);
}

QModelIndex SearchModel::parent(const QModelIndex &child) const
{
    if (!child.isValid() || child.internalId() == ModelLevel)
        return {};
    return createIndex(static_cast<int>(child.internalId() - 1), 0, ModelLevel);
}

int SearchModel::rowCount(const QModelIndex &parent) const
{
    if (!parent.isValid())
        return static_cast<int>(m_entries.size());
    if (parent.internalId() != ModelLevel || parent.column() != 0)
        return 0;
    return static_cast<int>(m_entries[static_cast<std::size_t>(parent.row())].owners.size());
}

int SearchModel::columnCount(const QModelIndex &) const
{
    return ColumnCount;
}

QString SearchModel::nameOf(const RegisterIndex::Owner &owner) const
{
    return modelName(m_catalog, owner.modelNumber);
}

QString SearchModel::seriesText(const RegisterIndex::Entry &entry) const
{
    QStringList series;
    for (const RegisterIndex::Owner &owner : entry.owners) {
        const Catalog::ModelInfo *info = m_catalog.model(int(owner.modelNumber));
        if (info && !series.contains(info->series))
            series << info->series;
    }
    series.sort();
    return series.join(QStringLiteral(", "));
}

QString SearchModel::registerText(const RegisterIndex::Entry &entry, Column column) const
{
    switch (column) {
    case Name: return entry.name;
    case Address: return addressText(entry.address);
    case Size: return QString::number(entry.size);
    case Series: return seriesText(entry);
    case Models:
        return entry.owners.size() == 1 ? nameOf(entry.owners.front()) : tr("%1 models").arg(entry.owners.size());
    case ColumnCount: break;
    }
    return {};
}

QString SearchModel::modelText(const RegisterIndex::Owner &owner, Column column) const
{
    const bool always = owner.firmwareFrom <= 0 && owner.firmwareTo >= 255;
    switch (column) {
    case Name: return nameOf(owner);
    case Series: {
        const Catalog::ModelInfo *info = m_catalog.model(int(owner.modelNumber));
        return info ? info->series : QString();
    }
    case Models: return always ? QString() : firmwareText(owner.firmwareFrom, owner.firmwareTo);
    default: return {};
    }
}

QVariant SearchModel::data(const QModelIndex &index, int role) const
{
    if (!checkIndex(index, CheckIndexOption::IndexIsValid))
        return {};
    const auto column = static_cast<Column>(index.column());
    const QString text =
        index.internalId() == ModelLevel ? registerText(*entry(index), column) : modelText(owner(index), column);
    switch (role) {
    case Qt::DisplayRole: return text;
    case Qt::ToolTipRole: return plainToolTip(text);
    case Qt::TextAlignmentRole:
        return static_cast<int>((holdsNumber(column) ? Qt::AlignRight : Qt::AlignLeft) | Qt::AlignVCenter);
    case Qt::FontRole: return holdsNumber(column) ? QVariant(m_numbers) : QVariant();
    case LibraryDelegate::MarkedRole: return column == Models && index.internalId() != ModelLevel;
    default: return {};
    }
}

QVariant SearchModel::headerData(int section, Qt::Orientation orientation, int role) const
{
    if (orientation != Qt::Horizontal || section < 0 || section >= ColumnCount)
        return {};
    static const std::array<QString, ColumnCount> names{tr("Register"), tr("Address"), tr("Size"), tr("Series"),
                                                        tr("Models")};
    if (role == Qt::DisplayRole)
        return names[static_cast<std::size_t>(section)];
    if (role == Qt::TextAlignmentRole)
        return static_cast<int>((holdsNumber(section) ? Qt::AlignRight : Qt::AlignLeft) | Qt::AlignVCenter);
    return {};
}

} // namespace dynascope
