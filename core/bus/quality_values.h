// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/bus_values.h"
#include "core/bus/readcost.h"

#include <array>

namespace dynascope {

/// How long things took, as counts in steps of an eighth of their size: percentiles are right to about a twentieth.
class DurationCounts
{
public:
    void add(LineTime duration);
    quint64 count() const { return m_count; }
    /// `part` 0..1: so much of all took no longer. 0 where nothing was counted.
    LineTime percentile(double part) const;
    /// What came since these were so; `before` is an earlier state of the same counts.
    DurationCounts since(const DurationCounts &before) const;

    friend bool operator==(const DurationCounts &, const DurationCounts &) = default;

private:
    static constexpr std::size_t Steps = 176; ///< to 17 s
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
    /// From the end of the request to the end of its answer; the answers before it in a group read included, since
    /// adapters hand several over at once.
    DurationCounts responses;

    quint64 asked() const { return good + bad(); }
    quint64 bad() const { return timeouts + crcErrors + lengthErrors + lateAnswers; }
    double badShare() const; ///< 0..1; 0 where nothing was asked

    DeviceQuality since(const DeviceQuality &before) const;
    DeviceQuality &operator+=(const DeviceQuality &other); ///< counts; responses are left alone
    friend bool operator==(const DeviceQuality &, const DeviceQuality &) = default;
};

/// How polling went.
struct PollReport {
    struct Taken {
        std::chrono::milliseconds interval{0};
        quint64 answers = 0; ///< to spans of that interval, since the plan came

        friend bool operator==(const Taken &, const Taken &) = default;
    };
    LineDelays delays;
    std::vector<Taken> taken; ///< by interval

    friend bool operator==(const PollReport &, const PollReport &) = default;
};

/// What a line was like since it was opened.
struct LineQuality {
    BusStatistics totals;
    DurationCounts roundTrips;          ///< write to last reply, of exchanges in which nothing was missing
    std::vector<DeviceQuality> devices; ///< those that were asked, by ID
    LineTime at{};                      ///< when it was so, where somebody noted that
    PollReport polled = {};             ///< likewise

    const DeviceQuality *device(std::uint8_t id) const; ///< nullptr: not asked
    DeviceQuality sum() const;                          ///< of all devices
    LineQuality since(const LineQuality &before) const; ///< what came since it was so
};

} // namespace dynascope
