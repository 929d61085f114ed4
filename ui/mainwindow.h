// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/common/theme.h"
#include "ui/common/workbench.h"

#include <QMainWindow>

namespace dynascope {

/// The window: devices left, control table centre, plots right or below; connection bar, STOP, message bar, status bar.
class MainWindow : public QMainWindow
{
    Q_OBJECT

public:
    explicit MainWindow(const Workbench &workbench, QWidget *parent = nullptr);
    ~MainWindow() override;

    /// Opens a line and scans it: the port of the command line, or the one from last time.
    void connectTo(const QString &port, int baudRate);

signals:
    void schemeRequested(dynascope::ColorScheme scheme);
    void resumeDemoRequested();
};

} // namespace dynascope
