// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/alarms.h"
#include "core/session/monitor.h"

namespace dynascope {

/// One register around a fault: copies, so that it outlives device and history.
struct FaultTrace {
    int field = -1; ///< of the device's table
    QString name;
    QString unit;
    double scale = 1; ///< physical = raw × scale + offset
    double offset = 0;
    int decimals = 0;
    bool wasWatched = false;              ///< its whole history; else what was polled anyway, some readings a second
    std::vector<History::Sample> samples; ///< by time
};

/// What was known of a device from ten seconds before a fault until some seconds after it.
struct FaultRecord {
    quint64 alarm = 0; ///< Alarm::number
    DeviceKey device = 0;
    QString name;
    QString cause;
    QDateTime wall;
    LineTime at{};        ///< the fault, by the clock of the line
    bool isWhole = false; ///< nothing more will come
    std::vector<FaultTrace> traces;

    std::size_t samples() const;
};

/// Keeps what was before faults. Bounded: the newest records, and of them so many samples. GUI thread.
class FaultRecords
{
public:
    static constexpr LineTime Before = std::chrono::seconds(10);
    static constexpr LineTime After = std::chrono::seconds(5);
    static constexpr std::size_t Most = 64;               ///< records
    static constexpr std::size_t MostSamples = 1'000'000; ///< of all records, at 16 bytes
    static constexpr std::size_t MostOfTrace = 40'000;    ///< the newest before, the first after

    /// The monitor outlives this.
    explicit FaultRecords(const Monitor &monitor) : m_monitor(monitor) { }

    /// What the device's vital registers are now, for the time before a fault; call it as often as they come.
    void note(const Device &device, const std::vector<VitalField> &fields);
    void begin(const Alarm &alarm, const Device &device, const std::vector<VitalField> &fields, LineTime now);
    void follow(const Device &device, LineTime now); ///< what came since, for the time after it
    void remove(DeviceKey device);                   ///< it goes; its records stay
    void clear();

    const FaultRecord *find(quint64 alarm) const; ///< nullptr: none was kept
    std::size_t size() const { return m_records.size(); }

private:
    void add(FaultRecord &record, const Device &device, int field) const;
    void take(FaultRecord &record, FaultTrace &trace) const;
    void bound();

    const Monitor &m_monitor;
    std::map<Watch, std::deque<History::Sample>> m_recent; ///< of the last seconds
    std::deque<FaultRecord> m_records;                     ///< the oldest first
    std::map<quint64, LineTime> m_open;                    ///< by alarm: until when more is taken
};

} // namespace dynascope
