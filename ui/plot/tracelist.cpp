// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/plot/tracelist.h"

#include "ui/common/icons.h"
#include "ui/common/present.h"
#include "ui/plot/deriveddialog.h"
#include "ui/plot/tracedelegate.h"
#include "ui/plot/tracemodel.h"

#include <QContextMenuEvent>
#include <QKeyEvent>
#include <QMenu>

#include <algorithm>

namespace dynascope {

TraceList::TraceList(TraceModel &model, QWidget *parent) : QListView(parent), m_model(model)
{
    auto *delegate = new TraceDelegate(this);
    setItemDelegate(delegate);
    setModel(&model);
    setSelectionMode(ExtendedSelection);
    setFrameShape(NoFrame);
    setMouseTracking(true);
    viewport()->setAutoFillBackground(false); // one surface with the chart
    setUniformItemSizes(true);
    setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    setVerticalScrollMode(ScrollPerPixel);
    setAccessibleName(tr("Traces"));
    connect(delegate, &TraceDelegate::removeRequested, this,
        [this](const QModelIndex &index) { emit removeRequested({index.row()}); });
}

QSize TraceList::sizeHint() const
{
    const int row = m_model.rowCount() > 0 ? sizeHintForRow(0) : 40;
    return {256, row * std::clamp(m_model.rowCount(), 1, 4)};
}

QList<int> TraceList::selectedRows() const
{
    QList<int> rows;
    for (const QModelIndex &index : selectionModel()->selectedRows())
        rows.append(index.row());
    std::ranges::sort(rows);
    return rows;
}

void TraceList::currentChanged(const QModelIndex &current, const QModelIndex &previous)
{
    QListView::currentChanged(current, previous);
    emit currentRowChanged(current.isValid() ? current.row() : -1);
}

void TraceList::contextMenuEvent(QContextMenuEvent *event)
{
    const bool isByKey = event->reason() == QContextMenuEvent::Keyboard;
    if (isByKey)
        showMenu(viewport()->mapToGlobal(visualRect(currentIndex()).center()));
    else if (indexAt(event->pos()).isValid())
        showMenu(event->globalPos());
}

void TraceList::showMenu(const QPoint &at)
{
    const QList<int> rows = selectedRows();
    if (rows.isEmpty())
        return;
    const bool isAnyVisible = std::ranges::any_of(rows, [this](int row) { return m_model.isVisible(row); });
    auto *menu = new QMenu(this);
    menu->setAttribute(Qt::WA_DeleteOnClose);
    menu->addAction(icon(isAnyVisible ? QStringLiteral("eye-off") : QStringLiteral("eye")),
        isAnyVisible ? tr("&Hide") : tr("&Show"), this, [this, rows, isAnyVisible] { setShown(rows, !isAnyVisible); });
    menu->addAction(tr("Show &only this"), this, [this, rows] { showOnly(rows); });
    QList<int> all;
    for (int row = 0; row < m_model.rowCount(); ++row)
        all.append(row);
    menu->addAction(tr("Show &all"), this, [this, all] { setShown(all, true); });
    menu->addSeparator();
    addDerivedActions(*menu);
    menu->addSeparator();
    menu->addAction(
        icon(QStringLiteral("close")), tr("&Remove from the plot"), this, [this, rows] { emit removeRequested(rows); });
    menu->addAction(tr("Remove all"), this, [this, all] { emit removeRequested(all); });
    menu->popup(at);
}

void TraceList::addDerivedActions(QMenu &menu)
{
    // At once for the selected traces, else for all: once for each pair.
    QList<int> rows = selectedRows();
    for (int row = 0; rows.isEmpty() && row < m_model.rowCount(); ++row)
        rows.append(row);
    std::vector<TraceKey> differences;
    for (const int row : rows) {
        const std::optional<TraceKey> key = row < m_model.rowCount() ? m_model.goalLessPresent(row) : std::nullopt;
        if (key && std::ranges::find(differences, *key) == differences.end())
            differences.push_back(*key);
    }
    QAction *goals = menu.addAction(tr("Add &Goal − Present"));
    goals->setToolTip(tr("How far each joint is from its goal"));
    goals->setEnabled(!differences.empty()); // never gone: what is below it stays where it is
    connect(goals, &QAction::triggered, this, [this, differences] {
        for (const TraceKey &key : differences)
            emit deriveRequested(key);
    });
    QAction *ask = menu.addAction(tr("Add &derived trace…"));
    ask->setEnabled(!m_model.watches().empty());
    connect(ask, &QAction::triggered, this, &TraceList::askForDerived);
}

void TraceList::askForDerived()
{
    const QString name = QStringLiteral("derivedDialog");
    const QString subject = QString::number(quintptr(this), 16);
    if (m_model.watches().empty() || raiseOpen(*window(), name, subject))
        return;
    auto *dialog = new DerivedDialog(m_model, currentIndex().row(), this);
    connect(dialog, &DerivedDialog::chosen, this, &TraceList::deriveRequested);
    present(*dialog, subject);
}

void TraceList::keyPressEvent(QKeyEvent *event)
{
    const QList<int> rows = selectedRows();
    if (event->key() == Qt::Key_Delete && !rows.isEmpty()) {
        emit removeRequested(rows);
    } else if (event->key() == Qt::Key_Space && !rows.isEmpty()) {
        setShown(rows, std::ranges::none_of(rows, [this](int row) { return m_model.isVisible(row); }));
    } else {
        QListView::keyPressEvent(event);
    }
}

void TraceList::setShown(const QList<int> &rows, bool visible)
{
    // By row, not by trace: the menu is modal to the list, nothing else removes meanwhile but a device, which leaves
    // rows.
    for (const int row : rows) {
        if (row < m_model.rowCount())
            m_model.setVisible(row, visible);
    }
}

void TraceList::showOnly(const QList<int> &rows)
{
    for (int row = 0; row < m_model.rowCount(); ++row)
        m_model.setVisible(row, rows.contains(row));
}

} // namespace dynascope
