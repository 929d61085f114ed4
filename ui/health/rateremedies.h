// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/ratelimit_values.h"
#include "core/session/session.h"
#include "ui/common/messagebar.h"
#include "ui/common/workbench.h"

namespace dynascope {

/// What makes polling faster, once a person asks for it. Lives with its window.
class RateRemedies : public QObject
{
    Q_OBJECT

public:
    RateRemedies(const Workbench &workbench, QWidget *window);

    void show(LineSession *line, QWidget *over); ///< what is read how often, and what can be done about it
    void apply(LineSession &line, const RateLimit &limit);

signals:
    void posted(dynascope::MessageKind kind, const QString &text);

private:
    struct Delays; ///< devices whose Return Delay Time is being set, and how that went
    void askForReturnDelay(LineSession &line, const std::vector<std::uint8_t> &ids);
    void setReturnDelay(const std::vector<DeviceKey> &devices, bool mayTurnTorqueOff);
    void finish(const Delays &delays);
    void lowerLatency(LineSession &line);

    Workbench m_workbench;
    QWidget *m_window;
};

} // namespace dynascope
