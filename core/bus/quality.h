// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/quality_values.h"

#include <memory>

namespace dynascope {

/// Counts; bus thread. Allocates once for each device.
class QualityLog
{
public:
    /// `asking`: nothing received is no fault of the line, and counts nowhere.
    void count(const Request &request, const ExchangeResult &result, LineTime origin, bool asking);
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
