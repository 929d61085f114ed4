// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/bus_values.h"
#include "core/protocol/parser.h"

#include <functional>
#include <optional>

namespace dynascope {

/// What one exchange has brought so far: takes the bytes that come apart and lays the packets to the replies a request
/// expects. No I/O, no clock: times are handed in.
class Collector
{
public:
    /// Every packet or piece of noise that came, for the traffic view.
    using Heard = std::function<void(LineTime, ByteView)>;
    /// With ReplyShape::Anyone: each answer as it comes.
    using Found = std::function<void(const Reply &)>;

    /// `request` outlives the collector; `sent` is its packet as bytes: what an echo is compared with.
    Collector(const Request &request, Bytes sent, Heard heard = {}, Found found = {});

    void expectEcho() { m_echoExpected = true; } ///< with ReplyShape::None: complete only with it

    void feed(ByteView bytes, LineTime at);

    bool isMidPacket() const { return !m_parser.buffered().empty(); }
    /// What began has fallen silent: remembers it as cut off and goes on behind its first byte.
    void giveUp(LineTime at);

    bool isComplete() const;
    /// Index of the reply that is to come next; the last one where all have been passed.
    std::size_t position() const;
    /// When the last packet of an expected device had ended, damaged ones included; nothing before the first.
    std::optional<LineTime> lastPacketAt() const { return m_lastPacketAt; }
    std::size_t answers() const { return m_answers; }

    /// One entry per expected reply. `waited` is how long was waited for a reply that did not come.
    std::vector<Result<Reply>> replies(LineTime waited) const;
    /// Index of the reply at which a chain of replies broke: those behind it may be there and well. -1: none.
    int brokenAt() const;
    const Observations &seen() const { return m_seen; }

private:
    struct Slot {
        ExpectedReply expected;
        std::optional<Reply> reply;
        bool damaged = false;
        std::optional<std::size_t> wrongLength;
        bool passed() const { return reply || damaged || wrongLength; }
    };

    void drain(LineTime at);
    void take(const Parser::Packet &packet, LineTime at);
    void takeStatus(const StatusPacket &status, LineTime at);
    void takeAnyone(const StatusPacket &status, LineTime at);
    void takeDamaged(const Parser::Damaged &damaged, LineTime at);
    void salvageBlocks(ByteView raw, LineTime at);
    void stray(std::uint8_t id);
    Slot *slotOf(std::uint8_t id);
    Error missing(const Slot &slot, bool blamed, LineTime waited) const;

    const Request &m_request;
    Bytes m_sent;
    Heard m_heard;
    Found m_found;
    Parser m_parser;
    std::vector<Slot> m_slots;
    Observations m_seen;
    std::optional<Parser::Pending> m_cutOff;
    std::optional<LineTime> m_lastPacketAt;
    std::size_t m_answers = 0;
    bool m_echoExpected = false;
};

} // namespace dynascope
