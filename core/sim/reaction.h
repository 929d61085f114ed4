// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/line.h"
#include "core/protocol/requests.h"

namespace dynascope::sim {

/// What a servo wants to say to an instruction packet; when, the bus knows.
struct Reaction {
    enum class Turn {
        Direct, ///< `delay` after the packet
        Slot,   ///< in the order of IDs: broadcast Ping
        Chain,  ///< after the device listed before it: group reads
    };
    Turn turn = Turn::Direct;
    LineTime heardAt{}; ///< the packet's last bit
    LineTime delay{};   ///< processing and Return Delay Time
    int baudRate = 57600;
    StatusPacket status;
    GroupReadCommand group{}; ///< with Chain
    std::size_t index = 0;    ///< with Chain: our place in group.spans
};

} // namespace dynascope::sim
