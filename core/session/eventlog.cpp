// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/eventlog.h"

#include "core/session/journal/journal.h"
#include "core/session/ramguard.h"

#include <algorithm>

namespace dynascope {

EventLog::EventLog(Session &session, const Journal *journal, const RamGuard *guard, QObject *parent)
    : QObject(parent)
    , m_session(session)
    , m_journal(journal)
{
    connect(&session, &Session::deviceAdded, this, &EventLog::follow);
    connect(&session, &Session::deviceAboutToBeRemoved, this, [this](Device *device) { m_seen.erase(device->key()); });
    for (Device *device : session.devices())
        follow(device);
    if (journal)
        connect(journal, &Journal::ended, this, &EventLog::onWritten);
    if (guard) {
        connect(guard, &RamGuard::restarted, this, [this](DeviceKey key) {
            if (const Device *device = m_session.device(key))
                add(*device, m_session.now(), LoggedEvent::Kind::Restart, tr("Has restarted: settings in RAM are lost"));
        });
    }
}

void EventLog::follow(Device *device)
{
    m_seen[device->key()] = {false, false, device->alert(), device->state()};
    connect(device, &Device::fieldsChanged, this, [this, device](int first, int last) {
        const int torque = device->table().indexOf(Known::TorqueEnable);
        if (torque >= first && torque <= last)
            lookAtTorque(*device);
    });
    connect(device, &Device::attributesChanged, this, [this, device] { lookAtState(*device); });
}

void EventLog::lookAtTorque(const Device &device)
{
    const std::optional<std::int64_t> raw = device.raw(Known::TorqueEnable);
    if (!raw)
        return;
    Seen &seen = m_seen[device.key()];
    const bool isOn = *raw != 0;
    const bool isNews = seen.isKnown && isOn != seen.torque; // the first one only says how it is
    seen.isKnown = true;
    seen.torque = isOn;
    if (isNews) {
        add(device, device.value(device.table().indexOf(Known::TorqueEnable)).at,
            isOn ? LoggedEvent::Kind::TorqueOn : LoggedEvent::Kind::TorqueOff, isOn ? tr("Torque on") : tr("Torque off"));
    }
}

void EventLog::lookAtState(const Device &device)
{
    Seen &seen = m_seen[device.key()];
    if (device.alert() && !seen.alert)
        add(device, device.lastHeard(), LoggedEvent::Kind::Alert, tr("Alert: hardware error"));
    if (device.state() == Device::State::Rebooting && seen.state != Device::State::Rebooting)
        add(device, m_session.now(), LoggedEvent::Kind::Restart, tr("Reboot"));
    seen.alert = device.alert();
    seen.state = device.state();
}

void EventLog::onWritten(qint64 number)
{
    const JournalEntry *entry = m_journal->entry(number);
    if (!entry || entry->kind != JournalKind::Write || entry->state == JournalState::Failed || entry->changes.empty())
        return;
    const LineTime ago = std::chrono::milliseconds(std::max<qint64>(0, entry->at.msecsTo(QDateTime::currentDateTimeUtc())));
    for (const Device *device : m_session.devices()) {
        if (!device->line() || device->line()->name() != entry->device.line || device->id() != entry->device.id
            || device->modelNumber() != entry->device.modelNumber || device->baudRate() != entry->device.baudRate)
            continue;
        const RegisterChange &change = entry->changes.front();
        add(*device, m_session.now() - ago, LoggedEvent::Kind::Write,
            tr("%1: %2 → %3")
                .arg(registerText(change), bytesText(change.before, change.isSigned),
                    bytesText(change.after, change.isSigned)));
        return;
    }
}

std::size_t EventLog::indexAt(LineTime at) const
{
    const auto found = std::ranges::lower_bound(m_events, at, {}, &LoggedEvent::at);
    return static_cast<std::size_t>(found - m_events.begin());
}

void EventLog::clear()
{
    m_events.clear();
}

void EventLog::showRecorded(std::deque<LoggedEvent> events)
{
    m_isRecorded = true;
    m_events = std::move(events);
}

void EventLog::add(const Device &device, LineTime at, LoggedEvent::Kind kind, const QString &text)
{
    if (m_isRecorded)
        return;
    const LoggedEvent event{at, kind, device.key(), device.displayName(), text};
    m_events.insert(std::ranges::upper_bound(m_events, at, {}, &LoggedEvent::at), event);
    if (m_events.size() > Most)
        m_events.pop_front();
    emit added(event);
}

} // namespace dynascope
