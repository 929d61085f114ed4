// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/line.h"

#include <optional>
#include <vector>

/// What goes wrong on a simulated line; reference "What real buses do to a client". Values only: SimulatedBus carries
/// them out, a control channel or a test makes them. Two devices under one ID are no setting: add both to the bus.
namespace dynascope::sim {

/// Where in a packet damage falls. In a fast reply each device has its own Error, Id, Data and Crc; Header, Length and
/// Instruction stand in the first device's piece alone, its Header with the FE behind it. A part that isn't there can't
/// be damaged.
enum class PacketPart { Any, Header, Id, Length, Instruction, Error, Data, Crc };

struct Damage {
    PacketPart part = PacketPart::Any;
    int bits = 1;      ///< so many different bits are turned
    int burst = 0;     ///< instead: a run of so many bits of which the first and the last are turned for sure
    int firstBit = -1; ///< where: bit of the part, in the order of sending; −1: anywhere

    friend bool operator==(const Damage &, const Damage &) = default;
};

/// What befalls some of the devices' replies. A device's piece of a fast reply is a reply of its own.
struct ReplyFault {
    /// Several may befall one reply, in this order.
    enum class Kind {
        Reboot,      ///< the device reboots instead of answering
        Lost,        ///< nothing of it comes
        WrongId,     ///< it carries the ID `amount`, CRC and all else being right
        WrongLength, ///< it carries `amount` bytes of data more (0) or fewer, CRC and all else being right
        Damaged,     ///< as `damage` says
        Cut,         ///< its first `amount` bytes come; −1: any number of them
        StrayBefore, ///< before it comes a valid one from ID `amount`, equally long, other data
        NoiseBefore, ///< before it comes `noise`, or `amount` bytes of anything
        Late,        ///< the adapter hands it on `time` later; what comes after it stays after it
        Twice,       ///< it comes again, `time` after its end
    };
    Kind kind = Kind::Lost;
    int id = -1;    ///< of this device only; −1: of any
    int skip = 0;   ///< so many of these replies pass first
    int times = 1;  ///< so many of the next may be hit; −1: all
    int amount = 0; ///< see Kind
    LineTime time{};
    double share = 1; ///< chance of those that may be hit
    Damage damage{};
    Bytes noise{};
    /// Lost, Damaged, Cut: the devices hear it whole, the controller's end doesn't. Otherwise it stands so on the wire:
    /// whoever waits in a group read for this reply stays silent.
    bool atAdapter = false;

    friend bool operator==(const ReplyFault &, const ReplyFault &) = default;
};

/// The adapter returns what is sent.
struct EchoFault {
    bool on = false;
    LineTime delay{};               ///< it comes later, and what is answered after it
    std::optional<Damage> damage{}; ///< of each; the devices hear the packet whole

    friend bool operator==(const EchoFault &, const EchoFault &) = default;
};

/// Everything that is wrong with a line at a time. The same seed and the same calls give the same faults.
struct LineFaults {
    std::uint64_t seed = 1;
    EchoFault echo{};
    LineTime latencyTimer{};   ///< the adapter holds what came for so long; 16 ms is usual
    int latencyBuffer = 62;    ///< bytes; handed on at once when so many are there
    double noisePerSecond = 0; ///< stray bytes between the packets, on average; heard by the controller alone
    std::vector<ReplyFault> replies{};
    std::vector<int> silent{};             ///< IDs that hear and obey, but don't answer
    std::vector<int> deaf{};               ///< IDs that do neither; several: a dead segment
    LineTime replyJitter{}; ///< replies begin later by anything up to this, each anew
    /// Inside a request, by a program on a terminal: what its host may be blamed for. The devices drop a packet with a gap
    /// of more than 1.5 ms.
    LineTime bridgedGap = std::chrono::milliseconds(20);
    bool unplugged = false;                ///< the adapter is out of its socket
    std::optional<int> unplugAtSent{};     ///< from this byte of the requests on nothing leaves: it is pulled out then
    std::optional<int> unplugAtAnswered{}; ///< it is pulled out as this byte of the replies would be handed on

    friend bool operator==(const LineFaults &, const LineFaults &) = default;
};

} // namespace dynascope::sim
