// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/table/controltable.h"

#include <QAbstractTableModel>
#include <QFont>

namespace dynascope {

/// The registers of one control table as rows by address, without any device: FieldDataRole gives the field.
class RegisterModel : public QAbstractTableModel
{
    Q_OBJECT

public:
    enum Column { Address, Name, Size, AreaColumn, AccessColumn, Default, Range, UnitColumn, Firmware, ColumnCount };

    explicit RegisterModel(QObject *parent = nullptr);

    /// `all`: every table of the model, the oldest firmware first; `table` is one of them or null.
    void setTable(ControlTablePtr table, std::vector<ControlTablePtr> all);
    const ControlTablePtr &table() const { return m_table; }
    const std::vector<ControlTablePtr> &allTables() const { return m_all; }
    bool hasSeveralFirmware() const { return m_all.size() > 1; }

    int rowCount(const QModelIndex &parent = {}) const override;
    int columnCount(const QModelIndex &parent = {}) const override;
    QVariant data(const QModelIndex &index, int role) const override;
    QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

private:
    QString text(const Field &field, Column column, int row) const;
    QString toolTip(const Field &field, Column column, int row) const;

    ControlTablePtr m_table;
    std::vector<ControlTablePtr> m_all;
    QStringList m_marks; ///< by row: what other firmware has otherwise; empty where there is one table only
    QFont m_numbers;
};

} // namespace dynascope
