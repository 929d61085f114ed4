// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/table/tableactions.h"
#include "ui/table/tableroles.h"

#include <QPersistentModelIndex>
#include <QPointer>

namespace dynascope {

class FieldTableModel;
class LockBar;
class TableView;

/// What happens between "I want to change this" and an open editor: procedures for ID and baud rate, the check list for
/// bits, the lock bar where the servo would refuse.
class EditFlow : public QObject
{
    Q_OBJECT

public:
    /// All outlive this. Cells are those of `view`.
    EditFlow(FieldTableModel &model, TableView &view, LockBar &bar, TableActions actions, QObject *parent = nullptr);

    /// May the view open its editor here? Where not, this does what fits.
    bool gate(const QModelIndex &cell);
    void write(const QModelIndex &cell, std::int64_t raw); ///< as an edit would, with the lock bar where it is locked
    void forget();                                         ///< the person has turned to something else

signals:
    void changeIdRequested(dynascope::Device *device);
    void changeBaudRequested(dynascope::Device *device);

private:
    bool explainLock(const QModelIndex &cell, std::function<void()> then);
    void unlock();
    void editSafely();
    void resume();
    bool isOnAll(const QModelIndex &cell) const;
    void openBits(const QModelIndex &cell);
    std::vector<Device *> targets(const QModelIndex &cell) const;

    FieldTableModel &m_model;
    TableView &m_view;
    LockBar &m_bar;
    TableActions m_actions;
    QPersistentModelIndex m_locked;
    std::function<void()> m_then; ///< once m_locked is free
    QPersistentModelIndex m_lifted; ///< may be edited under torque: the safe way is offered then
    bool m_unlocking = false;
};

} // namespace dynascope
