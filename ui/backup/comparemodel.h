// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/backup/comparebackups.h"

#include <QAbstractTableModel>

namespace dynascope {

enum class CompareColumn { Name, Here, There, Status };
constexpr int CompareColumns = 4;

/// Two backups, a register a row. What differs says so in words and by an icon.
class CompareModel : public QAbstractTableModel
{
    Q_OBJECT

public:
    using QAbstractTableModel::QAbstractTableModel;

    /// What is shown of them; readings are never a difference.
    enum class Show { Differences, All };
    void setRows(std::vector<ComparedRegister> rows);
    void setShow(Show show);
    void setFilter(const QString &text); ///< part of a register's name
    void setTitles(const QString &here, const QString &there);

    const ComparedRegister &at(int row) const { return m_rows[m_shown[static_cast<std::size_t>(row)]]; }
    const std::vector<ComparedRegister> &rows() const { return m_rows; }

    int rowCount(const QModelIndex &parent = {}) const override;
    int columnCount(const QModelIndex &parent = {}) const override;
    QVariant data(const QModelIndex &index, int role) const override;
    QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

private:
    void choose();

    std::vector<ComparedRegister> m_rows;
    std::vector<std::size_t> m_shown;
    Show m_show = Show::Differences;
    QString m_filter, m_here, m_there;
};

} // namespace dynascope
