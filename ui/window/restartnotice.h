// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/ramguard.h"
#include "ui/common/workbench.h"

#include <QObject>

namespace dynascope {

class MessageBar;

/// Says which devices have restarted and what that took, in one message however many they are, and offers to set it
/// again.
class RestartNotice : public QObject
{
    Q_OBJECT

public:
    using Show = std::function<void(Device &)>; ///< what was set in it

    /// `workbench` has a RamGuard.
    RestartNotice(const Workbench &workbench, MessageBar &messages, Show show);

private:
    std::vector<Restart> present() const; ///< of devices that are there
    QString textOf(const std::vector<Restart> &restarts) const;
    void say();
    void update();
    void setAgain();
    void show();

    Workbench m_workbench;
    MessageBar &m_messages;
    Show m_show;
    QString m_said;
};

} // namespace dynascope
