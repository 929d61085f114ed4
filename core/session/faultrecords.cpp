// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/faultrecords.h"

#include <algorithm>

namespace dynascope {
namespace {

/// As histories keep it: a number that counts, also where a bit is the direction.
std::int64_t counted(const Device &device, int field, std::int64_t raw)
{
    return signedFromRaw(device.effective(field), raw);
}

FaultTrace traceOf(const Device &device, int field)
{
    EffectiveField effective = device.effective(field);
    effective.directionBit = -1; // samples are signed
    const int resolution = device.table().resolution();
    const Physical zero = physical(effective, resolution, 0);
    FaultTrace trace;
    trace.field = field;
    trace.name = device.table().fields()[static_cast<std::size_t>(field)].name;
    trace.unit = zero.unit;
    trace.offset = zero.value;
    trace.scale = physical(effective, resolution, 1).value - zero.value;
    trace.decimals = zero.decimals;
    return trace;
}

/// The newest that is known of the device, by the clock of its line.
LineTime newest(const Device &device, const std::vector<VitalField> &fields)
{
    LineTime at{};
    for (const VitalField &each : fields)
        at = std::max(at, device.value(each.field).at);
    return at;
}

} // namespace

std::size_t FaultRecord::samples() const
{
    std::size_t sum = 0;
    for (const FaultTrace &trace : traces)
        sum += trace.samples.size();
    return sum;
}

void FaultRecords::note(const Device &device, const std::vector<VitalField> &fields)
{
    for (const VitalField &each : fields) {
        const FieldValue &value = device.value(each.field);
        if (!value.raw || value.state == FieldState::Stale)
            continue;
        std::deque<History::Sample> &recent = m_recent[{device.key(), each.field}];
        if (!recent.empty() && recent.back().at == value.at)
            continue;
        if (!recent.empty() && recent.back().at > value.at)
            recent.clear(); // another clock
        recent.push_back({value.at, static_cast<std::int32_t>(counted(device, each.field, *value.raw))});
        while (recent.front().at + Before < value.at)
            recent.pop_front();
    }
}

void FaultRecords::begin(const Alarm &alarm, const Device &device, const std::vector<VitalField> &fields, LineTime now)
{
    FaultRecord record;
    record.alarm = alarm.number;
    record.device = device.key();
    record.name = alarm.name;
    record.cause = alarm.cause;
    record.wall = alarm.raised;
    record.at = newest(device, fields);
    for (const Watch &watch : m_monitor.watches()) {
        const History *history = watch.device == device.key() ? m_monitor.history(watch) : nullptr;
        if (const auto last = history ? m_monitor.newest(*history) : std::nullopt)
            record.at = std::max(record.at, last->at);
    }
    for (const VitalField &each : fields)
        add(record, device, each.field);
    for (const Watch &watch : m_monitor.watches()) {
        const auto isIt = [&watch](const FaultTrace &trace) { return trace.field == watch.field; };
        if (watch.device == device.key() && std::ranges::none_of(record.traces, isIt))
            add(record, device, watch.field);
    }
    m_open[alarm.number] = now + After;
    m_records.push_back(std::move(record));
    bound();
}

void FaultRecords::add(FaultRecord &record, const Device &device, int field) const
{
    FaultTrace trace = traceOf(device, field);
    const Watch watch{device.key(), field};
    trace.wasWatched = m_monitor.isWatched(watch) && m_monitor.history(watch);
    take(record, trace);
    record.traces.push_back(std::move(trace));
}

/// What is there of the record's time behind what the trace has.
void FaultRecords::take(FaultRecord &record, FaultTrace &trace) const
{
    const Watch watch{record.device, trace.field};
    const LineTime from = trace.samples.empty() ? record.at - Before : trace.samples.back().at + LineTime(1);
    const LineTime to = record.at + After;
    const bool isFirst = trace.samples.empty();
    if (const History *history = trace.wasWatched ? m_monitor.history(watch) : nullptr) {
        std::size_t index = history->indexAt(from);
        const std::size_t end = history->indexAt(to);
        if (isFirst && end > index + MostOfTrace / 2)
            index = end - MostOfTrace / 2; // the nearest to the fault
        for (; index < end && trace.samples.size() < MostOfTrace; ++index)
            trace.samples.push_back(history->at(index));
    } else if (const auto recent = m_recent.find(watch); !trace.wasWatched && recent != m_recent.end()) {
        for (const History::Sample &sample : recent->second) {
            if (sample.at >= from && sample.at < to)
                trace.samples.push_back(sample);
        }
    }
}

void FaultRecords::follow(const Device &device, LineTime now)
{
    for (FaultRecord &record : m_records) {
        const auto open = record.device == device.key() ? m_open.find(record.alarm) : m_open.end();
        if (open == m_open.end())
            continue;
        for (FaultTrace &trace : record.traces)
            take(record, trace);
        if (now < open->second)
            continue;
        record.isWhole = true;
        m_open.erase(open);
    }
    bound();
}

void FaultRecords::remove(DeviceKey device)
{
    for (FaultRecord &record : m_records) {
        if (record.device != device)
            continue;
        record.isWhole = true;
        m_open.erase(record.alarm);
    }
    std::erase_if(m_recent, [device](const auto &entry) { return entry.first.device == device; });
}

void FaultRecords::clear()
{
    m_recent.clear();
    m_records.clear();
    m_open.clear();
}

/// The last record stays whatever it holds: its traces are bounded themselves.
void FaultRecords::bound()
{
    std::size_t samples = 0;
    for (const FaultRecord &record : m_records)
        samples += record.samples();
    while (m_records.size() > Most || (samples > MostSamples && m_records.size() > 1)) {
        samples -= m_records.front().samples();
        m_open.erase(m_records.front().alarm);
        m_records.pop_front();
    }
}

const FaultRecord *FaultRecords::find(quint64 alarm) const
{
    const auto at = std::ranges::find(m_records, alarm, &FaultRecord::alarm);
    return at == m_records.end() ? nullptr : &*at;
}

} // namespace dynascope
