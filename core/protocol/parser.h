// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/protocol/packet.h"

#include <optional>
#include <variant>

namespace dynascope {

/// Takes a stream of bytes apart into packets, whatever stands between them and however it was cut into pieces.
///
/// Used by both sides of the wire. Once a header with a plausible length is found the packet is taken by its length,
/// since header-like bytes may legally occur inside; after a damaged packet the search goes on at the byte behind its
/// first, since a good packet may lie inside. No I/O, no clock: who knows that no more will come calls giveUp().
class Parser
{
public:
    // What an event shows of the stream is valid until the parser's next call: a cycle of polls allocates nothing.

    /// A whole packet with a good CRC.
    struct Packet {
        std::uint8_t id = 0;
        Instruction instruction = Instruction::Ping;
        ByteView parameters; ///< un-stuffed; of a status packet without the error field. Of a fast reply (id FE): all
                             ///< bytes behind the instruction byte up to and including the last CRC, never stuffed
        std::uint8_t errorField = 0; ///< of an ordinary status packet
        bool forgotStuffing = false; ///< the sender left a header pattern unstuffed
        ByteView raw;                ///< as it stood on the wire

        bool isStatus() const { return instruction == Instruction::Status; }
        /// Of an ordinary status packet: an error number stands in it; Alert is none.
        bool isError() const { return (errorField & ~AlertBit) != 0; }
        bool isFastStatus() const { return isStatus() && id == BroadcastId; }
        StatusPacket status() const;
        InstructionPacket request() const { return {id, instruction, Bytes(parameters.begin(), parameters.end())}; }
    };
    /// A whole packet by its length, but its CRC is wrong. The search goes on inside it.
    struct Damaged {
        ByteView raw;
    };
    /// Bytes that belong to no packet, damaged ones included.
    struct Noise {
        std::size_t bytes = 0;
    };
    using Event = std::variant<Packet, Damaged, Noise>;

    /// A packet that has begun.
    struct Pending {
        std::size_t have = 0; ///< bytes so far, 0 where no header has begun
        std::size_t want = 0; ///< bytes in all, 0 while the length isn't known
    };

    /// `maximumSize`: a header that announces more bytes in all than this is not taken for one.
    explicit Parser(std::size_t maximumSize = MaximumPacketSize) : m_maximumSize(maximumSize) { }

    void setMaximumSize(std::size_t bytes) { m_maximumSize = bytes; }
    void feed(ByteView bytes);

    /// The next event, or nothing until more is fed. Noise is reported before what follows it, in one piece.
    std::optional<Event> next();

    /// All bytes so far that belonged to no packet, also those not reported yet.
    std::size_t noiseBytes() const { return m_allNoise; }

    Pending pending() const;
    ByteView buffered() const { return ByteView(m_buffer).subspan(m_begin); }

    /// The packet that has begun will not be finished: the search goes on behind its first byte.
    void giveUp();
    void reset();

private:
    std::optional<std::size_t> announcedSize() const;
    bool seekHeader();
    void skip(std::size_t bytes);
    Event takePacket(std::size_t size);

    Bytes m_buffer;
    Bytes m_unstuffed; ///< of the packet told last, where it was stuffed
    std::size_t m_begin = 0; ///< what stands before has been dealt with
    std::size_t m_noise = 0; ///< skipped and not yet reported
    std::size_t m_allNoise = 0;
    std::size_t m_damaged = 0; ///< bytes from m_begin on that were reported within a damaged packet
    std::size_t m_maximumSize;
};

} // namespace dynascope
