// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/table/editflow.h"

#include "core/session/linesession.h"
#include "ui/table/bitpopup.h"
#include "ui/table/fieldtablemodel.h"
#include "ui/table/lockbar.h"
#include "ui/table/tableview.h"

#include <algorithm>

namespace dynascope {

EditFlow::EditFlow(FieldTableModel &model, TableView &view, LockBar &bar, TableActions actions, QObject *parent)
    : QObject(parent)
    , m_model(model)
    , m_view(view)
    , m_bar(bar)
    , m_actions(std::move(actions))
{
    connect(&bar, &LockBar::wayChosen, this, &EditFlow::unlock);
    connect(&bar, &LockBar::otherChosen, this, &EditFlow::editSafely);
    connect(&bar, &LockBar::dismissed, this, &EditFlow::forget);
    connect(&model, &FieldTableModel::updated, this, &EditFlow::resume);
    connect(&model, &QAbstractItemModel::modelAboutToBeReset, this, &EditFlow::forget);
    connect(view.selectionModel(), &QItemSelectionModel::currentChanged, this, [this](const QModelIndex &current) {
        m_lifted = QPersistentModelIndex();
        if (m_locked.isValid() && current.siblingAtColumn(0) != m_locked.sibling(m_locked.row(), 0))
            forget();
    });
}

std::vector<Device *> EditFlow::targets(const QModelIndex &cell) const
{
    return m_model.targets(cell.column()); // the proxies leave columns alone
}

bool EditFlow::gate(const QModelIndex &cell)
{
    const Field *field = fieldAt(cell);
    if (!field || !isEditable(*field))
        return false;
    const QString absent = cell.data(AbsentRole).toString();
    const bool ofAll = kindAt(cell) == ColumnKind::All;
    if (!absent.isEmpty() || (ofAll && isProcedureField(*field))) {
        forget();
        const QString one = tr("%1 is changed for one device at a time.").arg(field->name);
        m_bar.showReason(absent.isEmpty() ? one : absent, {});
        return false;
    }
    if (isProcedureField(*field)) {
        Device *device = m_model.devices()[static_cast<std::size_t>(m_model.columnAt(cell.column()).device)];
        if (field->name == u"ID")
            emit changeIdRequested(device);
        else
            emit changeBaudRequested(device);
        return false;
    }
    const QPersistentModelIndex kept = cell;
    if (explainLock(cell, [this, kept] { m_view.startEdit(kept); }))
        return false;
    forget();
    if (field->bits.empty())
        return true;
    openBits(cell);
    return false;
}

void EditFlow::write(const QModelIndex &cell, std::int64_t raw)
{
    const QPersistentModelIndex kept = cell;
    const auto doIt = [this, kept, raw] {
        if (kept.isValid())
            m_view.model()->setData(kept, static_cast<qlonglong>(raw), Qt::EditRole);
    };
    if (!explainLock(cell, doIt))
        doIt();
}

void EditFlow::forget()
{
    m_locked = QPersistentModelIndex();
    m_then = {};
    m_unlocking = false;
    m_bar.hide();
}

bool EditFlow::explainLock(const QModelIndex &cell, std::function<void()> then)
{
    const QString reason = cell.data(LockRole).toString();
    if (reason.isEmpty() || m_lifted == cell)
        return false;
    const Field *field = fieldAt(cell);
    const std::vector<Device *> devices = targets(cell);
    const bool connected = std::ranges::none_of(devices, [](const Device *device) {
        return device->line() && (device->line()->state() != BusThread::State::Open || device->line()->isRecorded());
    });
    const bool byTorque = connected && field->needsTorqueOff() && isOnAll(cell)
        && std::ranges::any_of(devices, [](const Device *device) { return device->isTorqueOn(); });
    m_locked = cell;
    m_then = std::move(then);
    m_unlocking = false;
    m_bar.showReason(reason, byTorque ? tr("Turn torque off and edit") : QString(),
                     byTorque && m_actions.writeSafely ? tr("Edit the safe way") : QString());
    return true;
}

/// What is typed is not written before its consequences have been shown.
void EditFlow::editSafely()
{
    const std::function<void()> then = m_then;
    m_lifted = m_locked;
    forget();
    if (then)
        then();
}

/// Every device that an edit here writes to has such a register.
bool EditFlow::isOnAll(const QModelIndex &cell) const
{
    if (kindAt(cell) != ColumnKind::All)
        return true;
    for (int column = 0; column < m_view.model()->columnCount(); ++column) {
        if (!cell.siblingAtColumn(column).data(AbsentRole).toString().isEmpty())
            return false;
    }
    return true;
}

void EditFlow::unlock()
{
    if (!m_locked.isValid())
        return;
    std::vector<Device *> devices;
    for (Device *device : targets(m_locked)) {
        if (device->isTorqueOn())
            devices.push_back(device);
    }
    m_unlocking = true;
    m_bar.setBusy(true);
    m_actions.torqueOff(devices, [self = QPointer<EditFlow>(this)](const Result<void> &result) {
        if (!self || !self->m_unlocking)
            return;
        if (result)
            return self->resume();
        self->m_unlocking = false;
        self->m_bar.showReason(tr("Torque is still on: %1.").arg(result.error().text), tr("Try again"));
    });
}

void EditFlow::resume()
{
    if (!m_locked.isValid() || !m_locked.data(LockRole).toString().isEmpty())
        return;
    const std::function<void()> then = m_unlocking ? m_then : std::function<void()>();
    forget();
    if (then)
        then();
}

void EditFlow::openBits(const QModelIndex &cell)
{
    const QVariant raw = cell.data(RawRole);
    if (!raw.isValid()) {
        const QString why = cell.data(MixedRole).toBool()
            ? tr("%1 differs: its other bits would be lost. Set it on one device, then that on all.")
            : tr("%1 has not been read yet: its other bits would be lost.");
        m_bar.showReason(why.arg(fieldAt(cell)->name), {});
        return;
    }
    auto *popup = new BitPopup(*fieldAt(cell), raw.toLongLong(), &m_view); // deletes itself when closed
    const QPersistentModelIndex kept = cell;
    connect(popup, &BitPopup::accepted, this, [this, kept](qint64 value) { write(kept, value); });
    const QRect rect = m_view.visualRect(cell);
    popup->open(m_view.viewport()->mapToGlobal(rect.bottomLeft() + QPoint(0, 2)));
}

} // namespace dynascope
