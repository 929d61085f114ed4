// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/session.h"
#include "ui/common/workbench.h"

#include <QWidget>

class QLabel;
class QPushButton;
class QStackedWidget;
class QTreeView;

namespace dynascope {

class DeviceActions;
class DeviceTreeModel;

/// Line → baud → device, live as a scan finds them, with the devices' actions.
class DevicePanel : public QWidget
{
    Q_OBJECT

public:
    explicit DevicePanel(const Workbench &workbench, QWidget *parent = nullptr);

    std::vector<Device *> selectedDevices() const;
    void selectDevice(Device *device);
    LineSession *selectedLine() const; ///< of whatever row is selected; nullptr without one
    DeviceActions &actions() const { return *m_actions; }

signals:
    void scanRequested(); ///< from the empty view
    void connectRequested();
    void disconnectRequested(dynascope::LineSession *line);
    void selectionChanged();

private:
    QWidget *makeHeader();
    QWidget *makeEmptyView();
    void makeTree();
    void showContextMenu(const QPoint &position);
    void onSelection();
    void onDeviceAdded(Device *device);
    void updateEmptyView();

    Workbench m_workbench;
    DeviceActions *m_actions;
    DeviceTreeModel *m_model;
    QTreeView *m_tree;
    QStackedWidget *m_stack;
    QWidget *m_row;
    QLabel *m_emptyText;
    QPushButton *m_emptyAction;
    QPushButton *m_emptyClose; ///< lets go of a line on which nobody was found
};

} // namespace dynascope
