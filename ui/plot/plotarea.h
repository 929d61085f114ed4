// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/monitor.h"
#include "ui/common/workbench.h"

#include <QWidget>

namespace dynascope {

/// One or more plot panels under a common tool bar. Watches what it shows and stops watching what it no longer shows.
class PlotArea : public QWidget
{
    Q_OBJECT

public:
    explicit PlotArea(const Workbench &workbench, QWidget *parent = nullptr);

    void addTrace(const Watch &watch); ///< to the present panel; nothing if it is shown already
    void removeTrace(const Watch &watch);
    bool shows(const Watch &watch) const;
    std::vector<Watch> traces() const;

    QByteArray saveState() const;
    void restoreState(const QByteArray &state);

signals:
    void tracesChanged();
    void message(const QString &text);
};

} // namespace dynascope
