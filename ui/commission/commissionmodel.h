// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/commissioning/commissioning.h"

#include <QAbstractTableModel>

namespace dynascope {

enum class CommissionColumn { Joint, Id, BaudRate, Model, Firmware, State };
constexpr int CommissionColumns = static_cast<int>(CommissionColumn::State) + 1;

/// The joints of a list with what has become of each. GUI thread; `commissioning` outlives it.
class CommissionModel : public QAbstractTableModel
{
    Q_OBJECT

public:
    CommissionModel(const Commissioning &commissioning, const Catalog &catalog, QObject *parent);

    int rowCount(const QModelIndex &parent = {}) const override;
    int columnCount(const QModelIndex &parent = {}) const override { return parent.isValid() ? 0 : CommissionColumns; }
    QVariant data(const QModelIndex &index, int role) const override;
    QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

    void refresh();

private:
    QString text(std::size_t joint, CommissionColumn column) const;
    QString stateText(std::size_t joint) const;
    QVariant stateIcon(std::size_t joint) const;

    const Commissioning &m_commissioning;
    const Catalog &m_catalog;
    int m_rows = 0;
};

} // namespace dynascope
