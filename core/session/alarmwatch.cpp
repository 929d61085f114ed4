// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/alarmwatch.h"

#include <chrono>

namespace dynascope {
namespace {

constexpr std::chrono::milliseconds WatchInterval{100};

} // namespace

AlarmWatch::AlarmWatch(Session &session, Monitor &monitor, QObject *parent)
    : QObject(parent), m_session(session), m_records(monitor)
{
    m_timer.setInterval(WatchInterval);
    connect(&m_timer, &QTimer::timeout, this, &AlarmWatch::look);
    connect(&session, &Session::deviceAdded, this, &AlarmWatch::add);
    connect(&session, &Session::deviceAboutToBeRemoved, this, &AlarmWatch::remove);
    for (Device *device : session.devices())
        add(device);
}

void AlarmWatch::add(Device *device)
{
    Watched &watched = m_devices[device->key()];
    watched.fields = vitalFields(device->table());
    watched.vitals = vitalsOf(*device, watched.fields);
    m_timer.start();
    emit looked();
}

void AlarmWatch::remove(Device *device)
{
    m_devices.erase(device->key());
    m_records.remove(device->key());
    if (m_devices.empty())
        m_timer.stop();
    if (m_alarms.remove(device->key(), m_session.wallNow()))
        emit alarmsChanged();
    emit looked();
}

const Vitals *AlarmWatch::vitals(DeviceKey device) const
{
    const auto at = m_devices.find(device);
    return at == m_devices.end() ? nullptr : &at->second.vitals;
}

void AlarmWatch::startAnew()
{
    m_alarms = {};
    m_records.clear();
    m_kept.clear();
    emit alarmsChanged();
    look();
}

void AlarmWatch::clearEnded()
{
    m_alarms.clearEnded();
    emit alarmsChanged();
}

void AlarmWatch::look()
{
    const Alarms::Now now{m_session.now(), m_session.wallNow()};
    bool changed = false;
    for (auto &[key, watched] : m_devices) {
        const Device *device = m_session.device(key);
        if (!device)
            continue;
        watched.vitals = vitalsOf(*device, watched.fields);
        m_records.note(*device, watched.fields);
        if (m_alarms.take({key, device->displayName()}, watched.vitals, now)) {
            changed = true;
            keepFaults(*device, watched, now.at);
        }
        m_records.follow(*device, now.at);
    }
    if (changed) {
        std::erase_if(m_kept, [this](quint64 number) {
            const Alarm *alarm = m_alarms.find(number);
            return !alarm || !alarm->isActive();
        });
        emit alarmsChanged();
    }
    emit looked();
}

/// What is only near its limit is no fault yet.
void AlarmWatch::keepFaults(const Device &device, const Watched &watched, LineTime now)
{
    for (const Alarm &alarm : m_alarms.list()) {
        if (alarm.device == device.key() && alarm.isActive() && alarm.level == AlarmLevel::Over
            && m_kept.insert(alarm.number).second)
            m_records.begin(alarm, device, watched.fields, now);
    }
}

} // namespace dynascope
