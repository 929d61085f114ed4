// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/line.h"
#include "core/protocol/requests.h"

namespace dynascope {

/// One device's answer.
struct Reply {
    std::uint8_t id = 0;
    DeviceError error = DeviceError::None;
    bool alert = false; ///< Hardware Error Status is latched; never itself a failure
    Bytes data;
    LineTime at{};         ///< when its last byte had come
    std::size_t bytes = 0; ///< on the wire; 0 where nothing was to come by its Status Return Level
};

/// Did no answer come? A refusal is one.
inline bool isMissing(const Result<Reply> &reply)
{
    return !reply && reply.error().kind != ErrorKind::Refused;
}

/// What the line did during one exchange, for messages and statistics.
struct Observations {
    std::size_t bytesReceived = 0;
    std::size_t noiseBytes = 0;
    int damagedPackets = 0;
    std::vector<std::uint8_t> damagedIds; ///< as they stood in those packets; may be damaged themselves
    int strayPackets = 0;                 ///< valid, but not asked for
    std::vector<std::uint8_t> strayIds;
    int lateAnswers = 0; ///< that belong, or may belong, to an earlier request
    bool echo = false; ///< the request itself came back first
    int retries = 0;
    LineTime roundTrip{}; ///< write to last reply

    void reset(); ///< to nothing seen; keeps its memory
};

/// Everything a request brought. One entry per expected reply, in the order of the request; with a broadcast Ping one
/// per device that answered.
struct ExchangeResult {
    std::vector<Result<Reply>> replies; ///< errors name the device and what was seen
    int brokenAt = -1;                  ///< index of the reply at which a chain of replies broke; -1: it didn't
    Observations seen;

    /// Not heard on account of the one that broke the chain before it: says nothing of this device.
    bool isHidden(std::size_t index) const { return brokenAt >= 0 && static_cast<int>(index) > brokenAt; }
};

/// Counts since the line was opened.
struct BusStatistics {
    quint64 exchanges = 0;
    quint64 replies = 0;
    quint64 timeouts = 0; ///< nothing received, no header, cut off
    quint64 crcErrors = 0;
    quint64 lengthErrors = 0;
    quint64 strays = 0;
    quint64 lateAnswers = 0; ///< came behind their deadline, or could not be told from one that did
    quint64 retries = 0;
    quint64 bytesSent = 0;
    quint64 bytesReceived = 0;
    LineTime busy{}; ///< so long the wire carried bytes, in either direction

    friend bool operator==(const BusStatistics &, const BusStatistics &) = default;
};

inline void Observations::reset()
{
    Observations fresh;
    fresh.damagedIds.swap(damagedIds);
    fresh.strayIds.swap(strayIds);
    fresh.damagedIds.clear();
    fresh.strayIds.clear();
    *this = std::move(fresh);
}

} // namespace dynascope
