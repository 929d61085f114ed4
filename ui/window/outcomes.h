// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/session.h"
#include "ui/common/workbench.h"

#include <QObject>

#include <functional>
#include <set>

namespace dynascope {

class MessageBar;

/// Says how commands ended, each once: a failed write stands at its cell where the table shows it, all else comes here.
/// And what STOP has achieved, in a bar of its own for as long as it holds.
class Outcomes : public QObject
{
    Q_OBJECT

public:
    using IsShown = std::function<bool(const Device &)>; ///< does the table show this device?

    Outcomes(const Workbench &workbench, MessageBar &messages, MessageBar &stopBar, IsShown isShown);

private:
    void onFailed(Device *device, const Error &error, int field);
    void onStop();
    void follow(LineSession *line);
    void onDevice(Device *device);
    QString nameOf(const Device &device) const;

    Workbench m_workbench;
    MessageBar &m_messages;
    MessageBar &m_stopBar;
    IsShown m_isShown;
    std::set<DeviceKey> m_silent; ///< don't answer now
};

} // namespace dynascope
