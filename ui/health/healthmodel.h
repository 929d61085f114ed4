// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/linesession.h"
#include "ui/health/healthtexts.h"

#include <QAbstractTableModel>
#include <QPointer>

namespace dynascope {

/// How well the devices of one line answer: a row each, the worst first, and the line as the last row. Holds copies, so
/// nothing here outlives a device.
class HealthModel : public QAbstractTableModel
{
    Q_OBJECT

public:
    enum Role {
        VerdictRole = Qt::UserRole, ///< int of Verdict
        ShareRole,                  ///< 0..1
        LineRole,                   ///< is this the line's row?
    };

    using QAbstractTableModel::QAbstractTableModel;

    void setLine(LineSession *line); ///< nullptr: none
    LineSession *line() const { return m_line; }
    const HealthRow *row(int row) const; ///< nullptr: there is none
    QString toText() const;              ///< tab-separated, with headings

    int rowCount(const QModelIndex &parent = {}) const override;
    int columnCount(const QModelIndex &parent = {}) const override;
    QVariant data(const QModelIndex &index, int role) const override;
    QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

signals:
    void refreshed(); ///< figures, rows or their order

private:
    void refresh(const Device *leaving = nullptr);
    std::vector<HealthRow> makeRows(const Device *leaving) const;
    void removeOthers(const std::vector<HealthRow> &wanted);
    void insertMissing(const std::vector<HealthRow> &wanted);
    void order(const std::vector<HealthRow> &wanted);

    QPointer<LineSession> m_line;
    std::vector<HealthRow> m_rows;
};

} // namespace dynascope
