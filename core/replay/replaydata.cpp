// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/replay/replaydata.h"

#include <algorithm>
#include <future>
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
            m_devices.emplace(device.recorded, Kept{&device, std::vector<History *>(device.fields.size())});
    }

    void take(const Recording::Part &part)
    {
        for (const RecordedBatch &batch : part.batches) {
            for (const RecordedReply &reply : batch.replies)
                take(reply);
        }
        for (const RecordedEvent &event : part.events)
            take(event);
        m_data.histories->bound();
    }
    void countDamaged() { ++m_data.damagedParts; }
    ReplayData finish()
    {
        std::ranges::stable_sort(m_data.missed, {}, &MissedReply::at);
        std::ranges::stable_sort(m_data.events, {}, &LoggedEvent::at);
        return std::move(m_data);
    }

private:
    /// A device with the history of each of its fields, from its first sample on.
    struct Kept {
        const ReplayDevice *device = nullptr;
        std::vector<History *> histories;
    };

    void take(const RecordedReply &reply)
    {
        const auto kept = m_devices.find(reply.device);
        if (kept == m_devices.end())
            return;
        const ReplayDevice &device = *kept->second.device;
        m_data.last = std::max(m_data.last, reply.at);
        if (reply.data.empty() && m_data.missed.size() < MostMissed)
            m_data.missed.push_back({reply.at, device.key, reply.address, reply.length});
        for (std::size_t i = 0; i < device.fields.size(); ++i) {
            const RecordedField &field = device.fields[i].recorded;
            if (field.address < reply.address || field.end() > reply.address + reply.length)
                continue;
            History *&history = kept->second.histories[i];
            if (reply.data.empty()) {
                if (history)
                    history->appendGap(reply.at);
            } else if (const auto raw = countedRaw(field, reply.address, reply.data)) {
                if (!history)
                    history = &m_data.histories->open({device.key, device.fields[i].field}, reply.at);
                history->append(reply.at, *raw);
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
    std::unordered_map<quint32, Kept> m_devices;
    ReplayData m_data;
};

} // namespace

Result<ReplayData> loadReplay(Recording &recording, const ReplayDevices &devices,
                              const std::map<DeviceKey, QString> &names, std::size_t budget, ReplayProgress &progress)
{
    Loader loader(devices, names, budget);
    // The next part is unpacked while this one is taken: of about as much work each.
    const auto reading = [&recording](std::size_t part) {
        return std::async(std::launch::async, [&recording, part] { return recording.read(part); });
    };
    std::future<Result<Recording::Part>> next;
    if (recording.parts() > 0)
        next = reading(0);
    for (std::size_t part = 0; part < recording.parts(); ++part) {
        const Result<Recording::Part> content = next.get();
        if (progress.isCancelled)
            return failure(ErrorKind::Cancelled, QStringLiteral("The recording was closed before all of it was read"));
        if (part + 1 < recording.parts())
            next = reading(part + 1);
        if (content)
            loader.take(*content);
        else
            loader.countDamaged();
        progress.percent = static_cast<int>((part + 1) * 100 / recording.parts());
    }
    return loader.finish();
}

} // namespace dynascope
