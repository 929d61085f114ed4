// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/line.h"
#include "core/bus/traits.h"
#include "core/protocol/requests.h"

/// How long to wait for what. Pure functions of the request, the devices' traits and the line.
namespace dynascope::timing {

constexpr LineTime SlotOfBroadcastPing = std::chrono::milliseconds(3); ///< of an absent lower ID
constexpr LineTime Slice = std::chrono::milliseconds(1);               ///< longest wait without a look at the stop flag

constexpr LineTime times(std::size_t count, LineTime each)
{
    return static_cast<LineTime::rep>(count) * each;
}

/// From the end of a request to the begin of its reply, return delay not counted. EEPROM writes take tens of
/// milliseconds, Clear and Backup up to seconds.
LineTime processing(Instruction instruction);

/// A packet that began and is silent for longer than this is cut off: max(1.5 ms, 10 byte times). What the host adds
/// comes on top.
LineTime silence(const Line &line);

/// Bytes of a status packet with that many parameters, stuffing at its worst.
std::size_t largestStatus(std::size_t parameters);

/// The longest packet that may come while waiting for `request`'s answers, a reply of another length than asked and the
/// request's own echo included. What announces more is not a header.
std::size_t largestPacket(const Request &request, std::size_t sentBytes);

} // namespace dynascope::timing
