// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/table/fieldfiltermodel.h"

#include "ui/table/tableroles.h"

#include <algorithm>

namespace dynascope {
namespace {

bool matches(const Field &field, const QString &word)
{
    if (field.name.contains(word, Qt::CaseInsensitive) || field.help.contains(word, Qt::CaseInsensitive))
        return true;
    bool isNumber = false;
    const int address = word.toInt(&isNumber, 0);
    return isNumber && (address == field.address || QString::number(field.address).startsWith(word));
}

} // namespace

FieldFilterModel::FieldFilterModel(QObject *parent)
    : QSortFilterProxyModel(parent)
{
    setRecursiveFilteringEnabled(true);
}

void FieldFilterModel::setSearch(const QString &text)
{
    m_words = text.split(u' ', Qt::SkipEmptyParts);
    invalidateRowsFilter();
}

void FieldFilterModel::setOnlyChanged(bool on)
{
    m_changed = on;
    invalidateRowsFilter();
}

void FieldFilterModel::setOnlyWritable(bool on)
{
    m_writable = on;
    invalidateRowsFilter();
}

void FieldFilterModel::setOnlyWatched(bool on)
{
    m_watched = on;
    invalidateRowsFilter();
}

void FieldFilterModel::setOnlyDifferent(bool on)
{
    m_different = on;
    invalidateRowsFilter();
}

void FieldFilterModel::setOnlySetHere(bool on)
{
    m_setHere = on;
    invalidateRowsFilter();
}

bool FieldFilterModel::isFiltering() const
{
    return !m_words.isEmpty() || m_changed || m_writable || m_watched || m_different || m_setHere;
}

bool FieldFilterModel::filterAcceptsRow(int row, const QModelIndex &parent) const
{
    const QModelIndex index = sourceModel()->index(row, 0, parent);
    const Field *field = fieldAt(index);
    if (!field)
        return false; // a group stands with its registers, or not at all
    return std::ranges::all_of(m_words, [field](const QString &word) { return matches(*field, word); })
        && (!m_writable || field->isWritable())
        && (!m_changed || index.data(ChangedFromDefaultRole).toBool())
        && (!m_watched || index.data(WatchedRole).toInt() != Qt::Unchecked)
        && (!m_setHere || index.data(RamStateRole).toInt() != static_cast<int>(RamState::NotSet))
        && (!m_different || index.data(DiffersRole).toBool());
}

} // namespace dynascope
