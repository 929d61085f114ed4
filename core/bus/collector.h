// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/lateanswers.h"
#include "core/protocol/parser.h"

#include <array>
#include <bitset>
#include <functional>
#include <optional>

namespace dynascope {

/// What one exchange has brought so far: takes the bytes that come apart and lays the packets to the replies a request
/// expects. No I/O, no clock: times are handed in. Used for one exchange after the other; from the second alike one on
/// it allocates nothing.
class Collector
{
public:
    /// Every packet that came, for the traffic view.
    using Heard = std::function<void(LineTime, ByteView)>;
    /// With ReplyShape::Anyone: each answer as it comes.
    using Found = std::function<void(const Reply &)>;

    /// `late` outlives the collector: what may still come of earlier requests; emptied by an answer that proves it away.
    explicit Collector(LateAnswers &late) : m_late(late) { }

    void setHeard(Heard heard) { m_heard = std::move(heard); }

    /// Begins the next exchange. `request` and `sent`, its packet as bytes that an echo is compared with, outlive it.
    void begin(const Request &request, ByteView sent, Found found = {});
    void expectEcho() { m_echoExpected = true; } ///< with ReplyShape::None: complete only with it

    void feed(ByteView bytes, LineTime at);

    bool isMidPacket() const { return !m_parser.buffered().empty(); }
    /// What began has fallen silent: remembers it as cut off and goes on behind its first byte. `at` is when the last
    /// byte had come.
    void giveUp(LineTime at);

    bool isComplete() const;
    /// Index of the reply that is to come next; the last one where all have been passed.
    std::size_t position() const;
    /// When the last packet of an expected device had ended, damaged ones included; nothing before the first.
    std::optional<LineTime> lastPacketAt() const { return m_lastPacketAt; }
    /// When the last packet had ended behind which another device's turn began; nothing before the first.
    std::optional<LineTime> turnAt() const { return m_turnAt; }
    /// An answer to an earlier request that came now, and how long after it could have been awaited.
    struct Belated {
        std::uint8_t id = 0;
        LineTime by{};
    };
    const std::vector<Belated> &belated() const { return m_belated; }
    std::size_t answers() const { return m_answers; }
    int lastId() const; ///< with ReplyShape::Anyone: the highest that has answered; −1: none yet

    /// Hands over what came: one entry per expected reply. `waited` is how long was waited for a reply that did not
    /// come.
    void finish(ExchangeResult &result, LineTime waited);
    const Observations &seen() const { return m_seen; }

private:
    struct Slot {
        enum class State { Open, Answered, Damaged, WrongLength, Doubtful };
        ExpectedReply expected;
        State state = State::Open;
        Reply reply;
        std::size_t length = 0; ///< of an answer of the wrong length
        bool passed() const { return state != State::Open && state != State::Doubtful; }
        bool answered() const { return state == State::Answered; }
    };

    void drain(LineTime at);
    void take(const Parser::Packet &packet, LineTime at);
    void takeForeign(const Parser::Packet &packet, LineTime at);
    void takeStatus(const Parser::Packet &status, LineTime at);
    void takeAnyone(const Parser::Packet &status, LineTime at);
    void takeFast(const Parser::Packet &packet, LineTime at);
    void takeDamaged(ByteView raw, LineTime at);
    void salvageBlocks(ByteView raw, LineTime at);
    void pass(Slot &slot, Slot::State state, LineTime at);
    void doubtLaterOnes(const Slot &slot);
    bool isDoubtful(Slot &slot, const Parser::Packet &status, LineTime at);
    void accept(Slot &slot, std::uint8_t errorField, ByteView data, LineTime at, std::size_t bytes);
    void stray(const Parser::Packet &packet, LineTime at);
    int brokenAt() const;
    Slot *slotOf(std::uint8_t id);
    Error missing(const Slot &slot, bool blamed, LineTime waited) const;

    LateAnswers &m_late;
    Heard m_heard;
    Found m_found;
    const Request *m_request = nullptr;
    ByteView m_sent;
    Parser m_parser;
    std::vector<Slot> m_slots;
    std::size_t m_slotCount = 0; ///< of m_slots, whose memory is kept, so many count
    Observations m_seen;
    std::optional<Parser::Pending> m_cutOff;
    std::optional<LineTime> m_lastPacketAt, m_turnAt;
    std::vector<Belated> m_belated;
    std::array<Bytes, 4> m_earlier; ///< what was sent last, this one included
    std::size_t m_turn = 0;
    std::bitset<256> m_foreign; ///< devices that another controller has asked meanwhile
    std::size_t m_answers = 0;
    bool m_echoExpected = false;
};

} // namespace dynascope
