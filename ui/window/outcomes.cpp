// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/window/outcomes.h"

#include "core/session/commands.h"
#include "core/session/stopcontrol.h"
#include "ui/common/messagebar.h"
#include "ui/common/texts.h"

namespace dynascope {

namespace {

const QString StopTopic = QStringLiteral("stop");

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
    connect(&workbench.session, &Session::lineAdded, this, &Outcomes::follow);
    connect(&workbench.session, &Session::deviceAboutToBeRemoved, this, [this](Device *device) {
        m_silent.erase(device->key());
        m_messages.retractTopic(topicOf(device));
    });
    for (const auto &line : workbench.session.lines())
        follow(line.get());
    onStop();
}

void Outcomes::follow(LineSession *line)
{
    connect(line, &LineSession::deviceChanged, this, &Outcomes::onDevice);
    connect(line, &LineSession::stateChanged, this, &Outcomes::onStop);
}

void Outcomes::onDevice(Device *device)
{
    if (device->state() == Device::State::Silent)
        m_silent.insert(device->key());
    else if (m_silent.erase(device->key()) > 0)
        m_messages.retractTopic(topicOf(device)); // it answers again
}

/// Model and ID, with rate and port where that could be another one too.
QString Outcomes::nameOf(const Device &device) const
{
    QString name = tr("%1, ID %2").arg(device.displayName() == device.nickname() ? device.nickname() : device.model())
                       .arg(device.id());
    bool otherRate = false;
    bool otherLine = false;
    for (const Device *other : m_workbench.session.devices()) {
        if (other == &device || other->id() != device.id())
            continue;
        (other->line() == device.line() ? otherRate : otherLine) = true;
    }
    if (otherRate)
        name += tr(" at %1").arg(baudText(device.baudRate()));
    if (otherLine && device.line())
        name += tr(" on %1").arg(portText(device.line()->name()));
    return name;
}

void Outcomes::onFailed(Device *device, const Error &error, int field)
{
    const bool standsAtCell = device && field >= 0 && m_isShown(*device);
    if (error.kind == ErrorKind::Cancelled || standsAtCell)
        return;
    if (error.kind == ErrorKind::PortLost)
        return; // the line says so itself, once
    const MessageKind kind = error.kind == ErrorKind::Stopped ? MessageKind::Warning : MessageKind::Error;
    const bool isStopped = error.kind == ErrorKind::Stopped;
    const QString text = device && !isStopped ? QStringLiteral("%1: %2").arg(nameOf(*device), error.text) : error.text;
    m_messages.post({kind, text, {}, {}, isStopped ? StopTopic : topicOf(device)});
}

void Outcomes::onStop()
{
    const StopControl &stop = m_workbench.stop;
    if (!stop.isActive()) {
        m_stopBar.clear();
        m_messages.retractTopic(StopTopic);
        return;
    }
    const QString report = m_workbench.session.lines().empty() ? tr("No line is open") : stop.report();
    const QString text =
        tr("STOP. %1 Until it is released nothing can be moved from here.").arg(asSentence(report));
    if (m_stopBar.text() == text)
        return;
    m_stopBar.post({stop.isConfirmed() ? MessageKind::Warning : MessageKind::Error, text, tr("Release STOP"),
                    [this] { m_workbench.stop.release(); }});
}

} // namespace dynascope
