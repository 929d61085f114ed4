// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/replay/replaydata.h"

#include <algorithm>
#include <unordered_map>

namespace dynascope {
namespace {

constexpr std::size_t MostMissed = 4'000'000; ///< of a recording of nobody
constexpr std::size_t MostEvents = 100'000;

LoggedEvent::Kind kindOf(const RecordedEvent &event)
{
    if (event.kind == u"reboot")
        return LoggedEvent::Kind::Restart;
    if (event.kind == u"alert")
        return LoggedEvent::Kind::Alert;
    if (event.kind == u"torque")
        return event.text.endsWith(u"off") ? LoggedEvent::Kind::TorqueOff : LoggedEvent::Kind::TorqueOn;
    return LoggedEvent::Kind::Write;
}

class Loader
{
public:
    Loader(const ReplayDevices &devices, const std::map<DeviceKey, QString> &names, std::size_t budget)
        : m_names(names)
    {
        m_data.histories = std::make_unique<Histories>(budget);
        for (const ReplayDevice &device : devices.devices)
            m_devices.emplace(device.recorded, &device);
    }

    void take(const Recording::Part &part)
    {
        for (const RecordedBatch &batch : part.batches) {
            for (const RecordedReply &reply : batch.replies)
                take(reply);
        }
        for (const RecordedEvent &event : part.events)
            take(event);
    }
    void countDamaged() { ++m_data.damagedParts; }
    ReplayData finish()
    {
        std::ranges::stable_sort(m_data.missed, {}, &MissedReply::at);
        std::ranges::stable_sort(m_data.events, {}, &LoggedEvent::at);
        return std::move(m_data);
    }

private:
    void take(const RecordedReply &reply)
    {
        const auto device = m_devices.find(reply.device);
        if (device == m_devices.end())
            return;
        const DeviceKey key = device->second->key;
        m_data.last = std::max(m_data.last, reply.at);
        if (reply.data.empty() && m_data.missed.size() < MostMissed)
            m_data.missed.push_back({reply.at, key, reply.address, reply.length});
        for (const ReplayField &field : device->second->fields) {
            if (field.recorded.address < reply.address || field.recorded.end() > reply.address + reply.length)
                continue;
            const Watch watch{key, field.field};
            if (reply.data.empty()) {
                m_data.histories->appendGap(watch, reply.at);
            } else if (const auto raw = countedRaw(field.recorded, reply.address, reply.data)) {
                m_data.histories->append(watch, reply.at, *raw);
                ++m_data.samples;
            }
        }
    }

    void take(const RecordedEvent &event)
    {
        if (m_data.events.size() >= MostEvents)
            return;
        LoggedEvent logged{event.at, kindOf(event), 0, {}, event.text};
        for (const auto &[key, name] : m_names) {
            if (event.text.size() > name.size() && event.text[name.size()] == u':' && event.text.startsWith(name)) {
                logged.device = key;
                logged.name = name;
                logged.text = event.text.mid(name.size() + 1).trimmed();
            }
        }
        m_data.events.push_back(std::move(logged));
    }

    const std::map<DeviceKey, QString> &m_names;
    std::unordered_map<quint32, const ReplayDevice *> m_devices;
    ReplayData m_data;
};

} // namespace

Result<ReplayData> loadReplay(Recording &recording, const ReplayDevices &devices,
                              const std::map<DeviceKey, QString> &names, std::size_t budget, ReplayProgress &progress)
{
    Loader loader(devices, names, budget);
    for (std::size_t part = 0; part < recording.parts(); ++part) {
        if (progress.isCancelled)
            return failure(ErrorKind::Cancelled, QStringLiteral("The recording was closed before all of it was read"));
        if (const auto content = recording.read(part))
            loader.take(*content);
        else
            loader.countDamaged();
        progress.percent = static_cast<int>((part + 1) * 100 / recording.parts());
    }
    return loader.finish();
}

} // namespace dynascope
