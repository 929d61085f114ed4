// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/monitor.h"
#include "ui/common/workbench.h"

#include <QWidget>

namespace dynascope {

/// The control table of the selected devices: search, filters, grid with editors, goal sliders, why a field is locked.
class TablePanel : public QWidget
{
    Q_OBJECT

public:
    explicit TablePanel(const Workbench &workbench, QWidget *parent = nullptr);

    void setDevices(const std::vector<Device *> &devices); ///< of one model; empty shows what belongs here

signals:
    void plotRequested(const dynascope::Watch &watch); ///< ticked, or from the menu
    void unplotRequested(const dynascope::Watch &watch);
    void message(const QString &text); ///< for the message bar
};

} // namespace dynascope
