// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/mainwindow.h"

namespace dynascope {

MainWindow::MainWindow(const Workbench &, QWidget *parent)
    : QMainWindow(parent)
{
}

MainWindow::~MainWindow() = default;

void MainWindow::connectTo(const QString &, int) {}

} // namespace dynascope
