// SPDX-License-Identifier: GPL-3.0-or-later
// What is opened from the window, or dropped on it.
#include "ui/mainwindow.h"

#include "core/session/monitor.h"
#include "core/session/procedures/movefile.h"
#include "ui/commission/commissiondialog.h"
#include "ui/common/messagebar.h"
#include "ui/common/present.h"
#include "ui/dashboard/dashboarddialog.h"
#include "ui/devices/devicepanel.h"
#include "ui/library/librarydialog.h"
#include "ui/profile/profileview.h"
#include "ui/replay/openrecording.h"
#include "ui/window/menus.h"
#include "ui/window/torqueguard.h"
#include "ui/window/unitmenu.h"

#include <QDropEvent>

namespace dynascope {

/// At the selected device's model, where there is one.
void MainWindow::openLibrary()
{
    const QString name = QStringLiteral("libraryDialog");
    if (raiseOpen(*this, name))
        return;
    auto *dialog = new LibraryDialog(m_workbench.session.catalog(), m_refused, this);
    dialog->setUnits(savedUnits());
    connect(m_menus, &Menus::unitsChosen, dialog, &LibraryDialog::setUnits);
    if (const std::vector<Device *> devices = m_devices->selectedDevices(); !devices.empty())
        dialog->showModel(devices.front()->modelNumber(), devices.front()->firmware());
    present(*dialog);
}

void MainWindow::openDashboard()
{
    if (raiseOpen(*this, QStringLiteral("dashboardDialog")))
        return;
    auto *dashboard = new DashboardDialog(m_workbench.session, m_workbench.monitor, *m_alarms, this);
    dashboard->setUnits(savedUnits());
    connect(m_menus, &Menus::unitsChosen, dashboard, &DashboardDialog::setUnits);
    connect(dashboard, &DashboardDialog::deviceChosen, m_devices, &DevicePanel::selectDevice);
    present(*dashboard);
}

void MainWindow::openProfile()
{
    if (raiseOpen(*this, QStringLiteral("profileView")))
        return;
    auto *view = new ProfileView(m_workbench, shownLine(), this);
    view->setUnits(savedUnits());
    connect(m_menus, &Menus::unitsChosen, view, &ProfileView::setUnits);
    connect(view, &ProfileView::torqueTurnedOn, m_guard, [this](DeviceKey key) { m_guard->noteEnabled({key}); });
    present(*view);
}

/// On the line that is shown; one of each.
void MainWindow::openCommission()
{
    LineSession *line = shownLine();
    const QString name = QStringLiteral("commissionDialog");
    if (!line || raiseOpen(*this, name, line->name()))
        return;
    auto *dialog = new CommissionDialog(m_workbench.commands, *line, MoveFile::usualFolder(), this);
    connect(dialog, &CommissionDialog::posted, m_messages,
            [this](MessageKind kind, const QString &text) { m_messages->post(kind, text); });
    present(*dialog, line->name());
}

void MainWindow::askForRecording()
{
    dynascope::askForRecording(this, [this](const QString &path) { emit recordingRequested(path); });
}

void MainWindow::dragEnterEvent(QDragEnterEvent *event)
{
    if (!recordingsOf(*event->mimeData()).isEmpty())
        event->acceptProposedAction();
}

void MainWindow::dropEvent(QDropEvent *event)
{
    for (const QString &path : recordingsOf(*event->mimeData()))
        emit recordingRequested(path);
}

} // namespace dynascope
