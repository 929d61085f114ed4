// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/derived.h"

#include <QListView>

class QMenu;

namespace dynascope {

class TraceModel;

/// The legend of a panel: hide, remove and see the live values.
class TraceList : public QListView
{
    Q_OBJECT

public:
    explicit TraceList(TraceModel &model, QWidget *parent = nullptr);

    QSize sizeHint() const override;
    /// What is offered of derived traces, also by the panel's menu.
    void addDerivedActions(QMenu &menu);
    void askForDerived(); ///< as its menu does

signals:
    void removeRequested(const QList<int> &rows);
    void currentRowChanged(int row); ///< −1: none
    void deriveRequested(const dynascope::TraceKey &key);

protected:
    void contextMenuEvent(QContextMenuEvent *event) override;
    void keyPressEvent(QKeyEvent *event) override;
    void currentChanged(const QModelIndex &current, const QModelIndex &previous) override;

private:
    QList<int> selectedRows() const;
    void showMenu(const QPoint &at);
    void setShown(const QList<int> &rows, bool visible);
    void showOnly(const QList<int> &rows);

    TraceModel &m_model;
};

} // namespace dynascope
