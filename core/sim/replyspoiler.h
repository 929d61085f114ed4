// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/protocol/packet.h"
#include "core/sim/chance.h"
#include "core/sim/linefaults.h"
#include "core/sim/wire.h"

namespace dynascope::sim {

/// Carries out what befalls single replies.
class ReplySpoiler
{
public:
    /// Counts from here.
    void setFaults(const LineFaults &faults);

    struct Spoiled {
        std::vector<Transmission> sent; ///< what goes onto the wire in its place, in this order; perhaps nothing
        bool reboots = false;           ///< its device
    };
    /// `reply` is about to begin; `status` is what it says.
    Spoiled spoil(Transmission reply, const StatusPacket &status);

private:
    struct Counted {
        ReplyFault fault;
        int seen = 0;
    };
    struct Spoiling;
    bool befalls(Counted &counted, int id);
    void apply(const ReplyFault &fault, Spoiling &reply);

    std::vector<Counted> m_faults; ///< by kind
    Chance m_chance{1};
};

} // namespace dynascope::sim
