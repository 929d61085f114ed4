// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/commands.h"

#include <set>

namespace dynascope {

/// STOP for all lines: keeps each bus thread's torque-off packets up to date, presses and releases. While it is held, a
/// line that opens and a device that turns up are told as well. GUI thread.
class StopControl : public QObject
{
    Q_OBJECT

public:
    StopControl(Session &session, Commands &commands, QObject *parent = nullptr);

    bool isActive() const { return m_active; }
    /// Every known device was read back as off. Never where a line is lost or a device has no known Torque Enable.
    bool isConfirmed() const;
    bool isVerifying() const { return !m_waiting.empty(); } ///< some line has not reported yet
    QString report() const { return m_report; } ///< one to three sentences: who is off, who is not confirmed

    void press();
    void release();

signals:
    void changed();

private:
    void follow(LineSession *line);
    void adopt(LineSession &line); ///< its bus thread may be another one since reopen()
    void stop(LineSession &line);
    void prepare(); ///< hands each bus thread its torque-off targets
    void turnOff(Device &device);
    void take(LineSession *line, const std::vector<StopOutcome> &outcomes);
    void note(const StopOutcome &outcome);
    QStringList uncovered() const; ///< devices of unknown models: nobody knows their Torque Enable
    void update();
    void noteAll(); ///< in the journal: who may be under torque

    Session &m_session;
    Commands &m_commands;
    QTimer m_prepareTimer;
    bool m_active = false;
    std::map<LineSession *, int> m_generations; ///< of the bus threads whose outcomes are listened to
    std::set<LineSession *> m_waiting;          ///< have not reported yet
    std::map<DeviceKey, StopOutcome> m_outcomes;
    std::map<DeviceKey, JournalNote> m_notes; ///< of those that have not reported yet
    QString m_report;
};

} // namespace dynascope
