// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/commands.h"

namespace dynascope {

/// STOP for all lines: keeps each bus thread's torque-off packets up to date, presses and releases. GUI thread.
class StopControl : public QObject
{
    Q_OBJECT

public:
    StopControl(Session &session, Commands &commands, QObject *parent = nullptr);

    bool isActive() const { return m_active; }
    bool isConfirmed() const; ///< every device was read back as off
    QString report() const { return m_report; } ///< one or two sentences: who is off, who is not confirmed

    void press();
    void release();

signals:
    void changed();

private:
    void prepare(); ///< hands each bus thread its torque-off targets
    void take(const std::vector<StopOutcome> &outcomes);
    void makeReport();

    Session &m_session;
    Commands &m_commands;
    QTimer m_prepareTimer;
    bool m_active = false;
    int m_waiting = 0; ///< lines that have not reported yet
    QString m_report;
    std::vector<StopOutcome> m_outcomes;
};

} // namespace dynascope
