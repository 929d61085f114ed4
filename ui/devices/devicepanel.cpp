// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/devices/devicepanel.h"

#include "core/session/scanner.h"
#include "ui/common/icons.h"
#include "ui/common/texts.h"
#include "ui/devices/deviceactions.h"
#include "ui/devices/devicetree.h"
#include "ui/devices/devicetreemodel.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QMenu>
#include <QPushButton>
#include <QStackedWidget>
#include <QToolButton>
#include <QTreeView>

#include <algorithm>

namespace dynascope {

namespace {

/// Rows from the root on: compares as what stands above what.
std::vector<int> placeInTree(const QModelIndex &index)
{
    std::vector<int> rows;
    for (QModelIndex at = index; at.isValid(); at = at.parent())
        rows.insert(rows.begin(), at.row());
    return rows;
}

} // namespace

DevicePanel::DevicePanel(const Workbench &workbench, QWidget *parent)
    : QWidget(parent)
    , m_workbench(workbench)
    , m_actions(new DeviceActions(workbench, this))
    , m_model(new DeviceTreeModel(workbench.session, this))
    , m_tree(new QTreeView(this))
    , m_stack(new QStackedWidget(this))
{
    setObjectName(QStringLiteral("devicePanel"));
    makeTree();
    m_stack->addWidget(makeEmptyView());
    m_stack->addWidget(m_tree);
    auto *layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addWidget(makeHeader());
    layout->addWidget(m_stack, 1);

    const auto updateActions = [this] { m_actions->update(); };
    connect(m_model, &QAbstractItemModel::dataChanged, m_actions, updateActions);
    connect(m_model, &QAbstractItemModel::rowsInserted, this, &DevicePanel::updateEmptyView);
    connect(m_model, &QAbstractItemModel::rowsRemoved, this, &DevicePanel::updateEmptyView,
            Qt::QueuedConnection); // once the session has let go of it, too
    connect(m_model, &QAbstractItemModel::dataChanged, this, &DevicePanel::updateEmptyView);
    connect(&workbench.scanner, &Scanner::progressChanged, this, &DevicePanel::updateEmptyView);
    connect(&workbench.scanner, &Scanner::finished, this, &DevicePanel::updateEmptyView);
    // After the model, which was connected first: the row is there.
    connect(&workbench.session, &Session::deviceAdded, this, &DevicePanel::onDeviceAdded);
    updateEmptyView();
    onSelection();
}

void DevicePanel::makeTree()
{
    setUpDeviceTree(*m_tree, *m_model);
    m_tree->setContextMenuPolicy(Qt::CustomContextMenu);
    connect(m_tree->selectionModel(), &QItemSelectionModel::selectionChanged, this, &DevicePanel::onSelection);
    connect(m_tree, &QWidget::customContextMenuRequested, this, &DevicePanel::showContextMenu);
    for (QAction *action : m_actions->menuActions()) {
        if (!action)
            continue;
        // Del and F2 edit text and cells elsewhere: here they belong to the tree alone. The rest works in the whole
        // window.
        const QKeySequence key = action->shortcut();
        const bool own = key == QKeySequence(Qt::Key_Delete) || key == QKeySequence(Qt::Key_F2);
        action->setShortcutContext(own ? Qt::WidgetShortcut : Qt::WindowShortcut);
        m_tree->addAction(action);
    }
}

QWidget *DevicePanel::makeHeader()
{
    auto *header = new QWidget(this);
    auto *layout = new QHBoxLayout(header);
    layout->setContentsMargins(12, 4, 4, 4);
    layout->setSpacing(0);
    auto *title = new QLabel(tr("Devices"), header);
    QFont bold = title->font();
    bold.setWeight(QFont::DemiBold);
    title->setFont(bold);
    layout->addWidget(title, 1);
    m_row = new QWidget(header);
    auto *row = new QHBoxLayout(m_row);
    row->setContentsMargins(0, 0, 0, 0);
    row->setSpacing(0);
    for (QAction *action : m_actions->rowActions()) {
        auto *button = new QToolButton(m_row);
        button->setDefaultAction(action);
        button->setObjectName(action->objectName().chopped(6) + QStringLiteral("Button"));
        button->setAccessibleName(action->text());
        button->setAutoRaise(true);
        button->setIconSize(QSize(18, 18));
        button->setFixedSize(28, 28);
        row->addWidget(button);
    }
    auto *more = new QToolButton(m_row);
    more->setObjectName(QStringLiteral("moreActionsButton"));
    more->setIcon(icon(QStringLiteral("more")));
    more->setIconSize(QSize(18, 18));
    more->setFixedSize(28, 28);
    more->setAutoRaise(true);
    more->setToolTip(tr("More actions for the selected devices"));
    more->setAccessibleName(tr("More actions"));
    connect(more, &QToolButton::clicked, this, [this, more] {
        showContextMenu(m_tree->viewport()->mapFromGlobal(more->mapToGlobal(QPoint(0, more->height()))));
    });
    row->addWidget(more);
    layout->addWidget(m_row);
    header->setFixedHeight(37);
    return header;
}

QWidget *DevicePanel::makeEmptyView()
{
    auto *view = new QWidget(this);
    auto *layout = new QVBoxLayout(view);
    layout->setContentsMargins(24, 24, 24, 24);
    layout->setSpacing(12);
    m_emptyText = new QLabel(view);
    m_emptyText->setWordWrap(true);
    m_emptyText->setAlignment(Qt::AlignCenter);
    m_emptyText->setForegroundRole(QPalette::PlaceholderText);
    m_emptyAction = new QPushButton(view);
    m_emptyAction->setObjectName(QStringLiteral("emptyDevicesButton"));
    connect(m_emptyAction, &QPushButton::clicked, this, [this] {
        if (m_workbench.session.lines().empty())
            emit connectRequested();
        else
            emit scanRequested();
    });
    m_emptyClose = new QPushButton(icon(QStringLiteral("disconnect")), tr("Disconnect"), view);
    m_emptyClose->setObjectName(QStringLiteral("emptyDisconnectButton"));
    connect(m_emptyClose, &QPushButton::clicked, this, [this] {
        if (!m_workbench.session.lines().empty())
            emit disconnectRequested(m_workbench.session.lines().front().get());
    });
    layout->addStretch(1);
    layout->addWidget(m_emptyText);
    layout->addWidget(m_emptyAction, 0, Qt::AlignHCenter);
    layout->addWidget(m_emptyClose, 0, Qt::AlignHCenter);
    layout->addStretch(2);
    return view;
}

void DevicePanel::updateEmptyView()
{
    // Of several lines each can be closed in the tree, though nobody was found on any.
    const bool any = !m_workbench.session.devices().empty() || m_workbench.session.lines().size() > 1;
    m_stack->setCurrentIndex(any ? 1 : 0);
    if (any)
        return;
    const bool connected = !m_workbench.session.lines().empty();
    const bool scanning = m_workbench.scanner.isRunning();
    m_emptyText->setText(scanning ? tr("Looking for devices…")
                             : connected ? tr("No device was found yet.")
                                         : tr("The servos of a bus appear here."));
    m_emptyAction->setText(connected ? tr("Scan") : tr("Connect a port"));
    m_emptyAction->setIcon(icon(connected ? QStringLiteral("scan") : QStringLiteral("connect")));
    m_emptyAction->setVisible(!scanning);
    m_emptyClose->setVisible(connected && !scanning);
}

std::vector<Device *> DevicePanel::selectedDevices() const
{
    std::vector<Device *> devices;
    QModelIndexList rows = m_tree->selectionModel()->selectedRows();
    std::ranges::sort(rows, {}, placeInTree); // they come as they were selected
    for (const QModelIndex &index : std::as_const(rows)) {
        if (Device *device = m_model->device(index))
            devices.push_back(device);
    }
    return devices;
}

LineSession *DevicePanel::selectedLine() const
{
    const QModelIndexList rows = m_tree->selectionModel()->selectedRows();
    return rows.isEmpty() ? nullptr : m_model->line(rows.first());
}

void DevicePanel::selectDevice(Device *device)
{
    const QModelIndex index = m_model->indexOf(device);
    if (index.isValid()) {
        // By the view it would toggle or extend where Ctrl or Shift is held just then.
        m_tree->selectionModel()->setCurrentIndex(index,
                                                  QItemSelectionModel::ClearAndSelect | QItemSelectionModel::Rows);
        m_tree->scrollTo(index);
    }
}

void DevicePanel::onDeviceAdded(Device *device)
{
    // The first one found: the table has something to show at once.
    if (selectedDevices().empty() && device->state() == Device::State::Present)
        selectDevice(device);
}

void DevicePanel::onSelection()
{
    const QModelIndexList rows = m_tree->selectionModel()->selectedRows();
    const QModelIndex current = rows.isEmpty() ? QModelIndex() : rows.first();
    m_actions->setSelection(selectedDevices(), m_model->line(current), m_model->baudRate(current));
    emit selectionChanged();
}

void DevicePanel::showContextMenu(const QPoint &position)
{
    auto *menu = new QMenu(this);
    menu->setObjectName(QStringLiteral("deviceMenu"));
    menu->setAttribute(Qt::WA_DeleteOnClose);
    menu->setToolTipsVisible(true);
    for (QAction *action : m_actions->menuActions()) {
        if (action)
            menu->addAction(action);
        else
            menu->addSeparator();
    }
    if (LineSession *line = selectedLine()) {
        menu->addSeparator();
        QAction *close = menu->addAction(icon(QStringLiteral("disconnect")),
                                         tr("Disconnect %1").arg(plainLabel(portText(line->name()))));
        close->setObjectName(QStringLiteral("disconnectLineAction"));
        close->setToolTip(tr("Close this port. Torque stays as it is."));
        connect(close, &QAction::triggered, this, [this, where = QPointer<LineSession>(line)] {
            if (where)
                emit disconnectRequested(where);
        });
    }
    menu->popup(m_tree->viewport()->mapToGlobal(position));
}

} // namespace dynascope
