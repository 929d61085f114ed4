// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/wire.h"

#include "core/sim/baudmismatch.h"

#include <algorithm>

namespace dynascope::sim {
namespace {

/// When byte `index` has come as a whole.
LineTime arrival(const Transmission &transmission, std::size_t index)
{
    return transmission.begin + static_cast<LineTime::rep>(index + 1) * transmission.byteTime();
}

} // namespace

void Wire::begin(Transmission transmission)
{
    OnWire added{std::move(transmission), {}, 0, false};
    added.absorbed.resize(added.what.bytes.size());
    for (OnWire &other : m_onWire) {
        if (other.what.end() > added.what.begin && other.what.begin < added.what.end())
            collide(other, added);
    }
    const auto after = std::ranges::upper_bound(m_onWire, added.what.begin, {},
                                                [](const OnWire &one) { return one.what.begin; });
    m_onWire.insert(after, std::move(added));
}

void Wire::collide(OnWire &first, OnWire &second)
{
    const LineTime bit = first.what.byteTime() / 10;
    const LineTime apart = std::chrono::abs(first.what.begin - second.what.begin);
    const bool together = first.what.sender && second.what.sender && apart < bit / 2
                          && first.what.baudRate == second.what.baudRate;
    if (!together) {
        const LineTime from = std::max(first.what.begin, second.what.begin);
        const LineTime to = std::min(first.what.end(), second.what.end());
        scramble(first, from, to);
        scramble(second, from, to);
        // The controller hears one stream: the earlier one stands for both.
        for (std::size_t i = 0; isHeard(first) && i < second.absorbed.size(); ++i) {
            if (arrival(second.what, i) <= to + second.what.byteTime() / 2)
                second.absorbed[i] = true;
        }
        return;
    }
    // Bit by bit at the same time: the wire is low where either pulls it low. Equal bytes stay whole.
    const std::size_t common = std::min(first.what.bytes.size(), second.what.bytes.size());
    for (std::size_t i = 0; i < common; ++i) {
        const auto mixed = static_cast<std::uint8_t>(first.what.bytes[i] & second.what.bytes[i]);
        if (first.what.bytes[i] != second.what.bytes[i])
            first.what.damaged = second.what.damaged = true;
        first.what.bytes[i] = second.what.bytes[i] = mixed;
        second.absorbed[i] = true;
    }
}

void Wire::scramble(OnWire &one, LineTime from, LineTime to)
{
    one.what.damaged = true;
    for (std::size_t i = 0; i < one.what.bytes.size(); ++i) {
        const LineTime whole = arrival(one.what, i);
        if (whole <= from || whole - one.what.byteTime() >= to)
            continue;
        const std::uint8_t turned = randomByte();
        one.what.bytes[i] ^= turned;
        if (!one.what.atAdapter.empty())
            one.what.atAdapter[i] ^= turned;
    }
}

std::uint8_t Wire::randomByte()
{
    m_random ^= m_random << 13;
    m_random ^= m_random >> 7;
    m_random ^= m_random << 17;
    return static_cast<std::uint8_t>(m_random >> 32) | 0x01U; // never 0: something changes
}

std::optional<LineTime> Wire::nextEnd() const
{
    std::optional<LineTime> next;
    for (const OnWire &one : m_onWire) {
        if (!one.ended && (!next || one.what.end() < *next))
            next = one.what.end();
    }
    return next;
}

Transmission Wire::takeEnded()
{
    const auto key = [](const OnWire &one) { return std::pair(one.ended, one.what.end()); };
    const auto first = std::ranges::min_element(m_onWire, {}, key);
    first->ended = true;
    Transmission ended = first->what;
    forgetDone();
    return ended;
}

void Wire::hear(std::vector<HeardByte> &to, LineTime now, int baudRate)
{
    for (OnWire &one : m_onWire) {
        if (!isHeard(one))
            continue;
        const Transmission &what = one.what;
        const Bytes &bytes = what.atAdapter.empty() ? what.bytes : what.atAdapter;
        const bool understood = understandEachOther(what.baudRate, baudRate);
        const auto hand = [&](LineTime at, std::uint8_t byte) {
            to.push_back({at, what.lateness, byte, what.sender != nullptr});
        };
        Bytes run;
        LineTime last{};
        for (; one.delivered < bytes.size() && arrival(what, one.delivered) <= now; ++one.delivered) {
            if (one.absorbed[one.delivered] || one.delivered >= what.lostFrom)
                continue;
            last = arrival(what, one.delivered);
            if (understood)
                hand(last, bytes[one.delivered]);
            else
                run.push_back(bytes[one.delivered]);
        }
        if (!run.empty())
            run = heardAtOtherBaud(run, what.baudRate, baudRate);
        for (const std::uint8_t byte : run)
            hand(last, byte);
    }
    forgetDone();
}

std::optional<LineTime> Wire::nextByte() const
{
    std::optional<LineTime> next;
    for (const OnWire &one : m_onWire) {
        if (!isHeard(one) || one.delivered == one.what.bytes.size())
            continue;
        const LineTime at = arrival(one.what, one.delivered);
        next = next ? std::min(*next, at) : at;
    }
    return next;
}

std::optional<LineTime> Wire::quiet() const
{
    std::optional<LineTime> last;
    for (const OnWire &one : m_onWire) {
        if (isHeard(one) && one.delivered < one.what.bytes.size())
            last = last ? std::max(*last, one.what.end()) : one.what.end();
    }
    return last;
}

std::optional<LineTime> Wire::busyUntil(LineTime at) const
{
    std::optional<LineTime> end;
    for (const OnWire &one : m_onWire) {
        if (one.what.begin <= at && at < one.what.end())
            end = end ? std::max(*end, one.what.end()) : one.what.end();
    }
    return end;
}

void Wire::forgetDone()
{
    std::erase_if(m_onWire, [this](const OnWire &one) {
        return one.ended && (!isHeard(one) || one.delivered == one.what.bytes.size());
    });
}

} // namespace dynascope::sim
