// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/table/catalog.h"
#include "core/table/registerindex.h"

#include <QAbstractItemModel>
#include <QFont>

namespace dynascope {

/// What a search over all models found: a row for each register at one address, below it the models that have it.
class SearchModel : public QAbstractItemModel
{
    Q_OBJECT

public:
    enum Column { Name, Address, Size, Series, Models, ColumnCount };

    explicit SearchModel(const Catalog &catalog, QObject *parent = nullptr);

    void setMatches(const std::vector<const RegisterIndex::Entry *> &matches); ///< copies what it needs
    const RegisterIndex::Entry *entry(const QModelIndex &index) const;         ///< of the row, or of what it is below
    /// The model of the row; of a register's own row the first that has it.
    RegisterIndex::Owner owner(const QModelIndex &index) const;

    QModelIndex index(int row, int column, const QModelIndex &parent = {}) const override;
    QModelIndex parent(const QModelIndex &child) const override;
    int rowCount(const QModelIndex &parent = {}) const override;
    int columnCount(const QModelIndex &parent = {}) const override;
    QVariant data(const QModelIndex &index, int role) const override;
    QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

private:
    QString registerText(const RegisterIndex::Entry &entry, Column column) const;
    QString modelText(const RegisterIndex::Owner &owner, Column column) const;
    QString seriesText(const RegisterIndex::Entry &entry) const;
    QString nameOf(const RegisterIndex::Owner &owner) const;

    const Catalog &m_catalog;
    std::vector<RegisterIndex::Entry> m_entries;
    QFont m_numbers;
};

} // namespace dynascope
