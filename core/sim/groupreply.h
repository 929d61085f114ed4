// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/sim/servo.h"

namespace dynascope::sim {

/// A group read being answered: each device speaks after it has heard the one listed before it; a missing one silences
/// all that follow. In a fast read the devices build one packet together, each CRC covering all before it.
struct Chain {
    struct Member {
        Servo *servo = nullptr;
        std::size_t index = 0; ///< place in `spans`
        LineTime delay{};      ///< after the predecessor's last bit
        int baudRate = 57600;
        StatusPacket status;
    };
    LineTime heardAt{};
    GroupReadCommand group{};
    std::vector<Member> waiting;
    std::vector<StatusPacket> blocks; ///< of a fast read: all listed, blank until their turn
};

/// The bytes that the device at `index` adds: a status packet, or its part of the fast packet. Data of another length
/// than was asked for stands as it is: what was to follow can't.
Bytes chainBytes(Chain &chain, std::size_t index, const StatusPacket &status);

/// When each of the devices that heard a broadcast Ping speaks: in the order of IDs, an empty slot for every absent
/// lower ID. `pings` by ID. Times are of the first bit.
struct PingSlot {
    std::uint8_t id = 0;
    LineTime delay{};    ///< its own, after its predecessor
    LineTime duration{}; ///< of its reply
};
std::vector<LineTime> pingTimes(LineTime heardAt, std::span<const PingSlot> pings);

} // namespace dynascope::sim
