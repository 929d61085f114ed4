// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/bus_values.h"

#include <array>
#include <memory>

namespace dynascope {

/// How long things took, as counts in steps of a quarter octave from 8 µs on: percentiles are right to a fifth.
class DurationCounts
{
public:
    void add(LineTime duration);
    quint64 count() const { return m_count; }
    /// `part` 0..1: so much of all took no longer. 0 where nothing was counted.
    LineTime percentile(double part) const;

    friend bool operator==(const DurationCounts &, const DurationCounts &) = default;

private:
    static constexpr std::size_t Steps = 84; ///< to 16 s
    std::array<quint32, Steps> m_counts{};
    quint64 m_count = 0;
};

/// What one device's answers were like since the line was opened.
struct DeviceQuality {
    std::uint8_t id = 0;
    quint64 good = 0; ///< refusals included: the wire did its part
    quint64 refused = 0;
    quint64 timeouts = 0; ///< nothing received, no header, cut off, only others answered
    quint64 cutOff = 0;   ///< of these: began and fell silent
    quint64 crcErrors = 0;
    quint64 lengthErrors = 0;
    quint64 lateAnswers = 0;
    quint64 retries = 0; ///< asked again
    quint64 bytes = 0;   ///< of good answers
    /// From the moment its answer could begin (end of the request or of the answer before it) to its end.
    DurationCounts responses;

    quint64 asked() const { return good + bad(); }
    quint64 bad() const { return timeouts + crcErrors + lengthErrors + lateAnswers; }
    friend bool operator==(const DeviceQuality &, const DeviceQuality &) = default;
};

/// What a line was like since it was opened.
struct LineQuality {
    BusStatistics totals;
    DurationCounts roundTrips;          ///< write to last reply, of exchanges in which nothing was missing
    std::vector<DeviceQuality> devices; ///< those that were asked, by ID
};

/// Counts; bus thread. Allocates once for each device.
class QualityLog
{
public:
    void count(const Request &request, const ExchangeResult &result, LineTime origin);
    void countRetry(const Request &request);
    BusStatistics &totals() { return m_totals; }
    const BusStatistics &totals() const { return m_totals; }
    LineQuality snapshot() const;

private:
    DeviceQuality &device(std::uint8_t id);

    BusStatistics m_totals;
    DurationCounts m_roundTrips;
    std::array<std::unique_ptr<DeviceQuality>, 256> m_devices;
};

} // namespace dynascope
