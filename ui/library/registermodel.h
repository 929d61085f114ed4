// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/table/controltable.h"

#include <QAbstractItemModel>
#include <QFont>

namespace dynascope {

/// The registers of one control table as rows by address, without any device: FieldDataRole gives the field. Of long
/// runs of like registers (longRuns()) one row stands for all, with GroupRole instead, and they are below it.
class RegisterModel : public QAbstractItemModel
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

    QModelIndex indexOf(int field, Column column) const; ///< by the register's index in the table

    QModelIndex index(int row, int column, const QModelIndex &parent = {}) const override;
    QModelIndex parent(const QModelIndex &child) const override;
    int rowCount(const QModelIndex &parent = {}) const override;
    int columnCount(const QModelIndex &parent = {}) const override;
    QVariant data(const QModelIndex &index, int role) const override;
    QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

private:
    /// A register, or a run of them.
    struct Row {
        int first = 0, last = 0; ///< indices in the table
        bool isRun() const { return last > first; }
    };

    const Row *runAt(const QModelIndex &index) const; ///< nullptr: it is a register's
    int fieldAt(const QModelIndex &index) const;
    QVariant runData(const Row &run, Column column, int role) const;
    QString text(const Field &field, Column column, int index) const;
    QString toolTip(const Field &field, Column column, int index) const;

    ControlTablePtr m_table;
    std::vector<ControlTablePtr> m_all;
    std::vector<Row> m_rows;
    QStringList m_marks; ///< by register: what other firmware has otherwise; empty where there is one table only
    QFont m_numbers;
};

} // namespace dynascope
