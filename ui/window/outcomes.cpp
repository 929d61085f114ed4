// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/window/outcomes.h"

#include "core/session/commands.h"
#include "core/session/stopcontrol.h"
#include "ui/common/messagebar.h"
#include "ui/common/texts.h"

namespace dynascope {

namespace {

/// A later success of the same device outdates what went wrong before it.
QString topicOf(const Device *device)
{
    return device ? QStringLiteral("device %1").arg(device->key()) : QString();
}

} // namespace

Outcomes::Outcomes(const Workbench &workbench, MessageBar &messages, MessageBar &stopBar, IsShown isShown)
    : QObject(&messages)
    , m_workbench(workbench)
    , m_messages(messages)
    , m_stopBar(stopBar)
    , m_isShown(std::move(isShown))
{
    connect(&workbench.commands, &Commands::failed, this, &Outcomes::onFailed);
    connect(&workbench.commands, &Commands::succeeded, this,
            [this](Device *device, const QString &what) {
                m_messages.post({MessageKind::Success, what, {}, {}, topicOf(device)});
            });
    connect(&workbench.stop, &StopControl::changed, this, &Outcomes::onStop);
    onStop();
}

void Outcomes::onFailed(Device *device, const Error &error, int field)
{
    const bool standsAtCell = device && field >= 0 && m_isShown(*device);
    if (error.kind == ErrorKind::Cancelled || standsAtCell)
        return;
    if (error.kind == ErrorKind::PortLost)
        return; // the line says so itself, once
    const MessageKind kind = error.kind == ErrorKind::Stopped ? MessageKind::Warning : MessageKind::Error;
    m_messages.post({kind, error.text, {}, {}, topicOf(device)});
}

void Outcomes::onStop()
{
    const StopControl &stop = m_workbench.stop;
    if (!stop.isActive()) {
        m_stopBar.clear();
        return;
    }
    const QString text =
        tr("STOP. %1 Until it is released nothing can be moved from here.").arg(asSentence(stop.report()));
    if (m_stopBar.text() == text)
        return;
    m_stopBar.post({stop.isConfirmed() ? MessageKind::Warning : MessageKind::Error, text, tr("Release STOP"),
                    [this] { m_workbench.stop.release(); }});
}

} // namespace dynascope
