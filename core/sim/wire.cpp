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

bool overlaps(const Transmission &transmission, std::size_t index, LineTime from, LineTime to)
{
    const LineTime whole = arrival(transmission, index);
    return whole > from && whole - transmission.byteTime() < to;
}

/// What a UART that follows `one` makes of it while `other` pulls the wire low as well.
void merge(Transmission &one, const Transmission &other, LineTime from, LineTime to)
{
    const double bit = static_cast<double>(one.byteTime().count()) / 10;
    const double otherBit = static_cast<double>(other.byteTime().count()) / 10;
    const auto begin = static_cast<double>((one.begin - other.begin).count());
    for (std::size_t i = 0; i < one.bytes.size(); ++i) {
        if (!overlaps(one, i, from, to))
            continue;
        std::uint8_t kept = 0xFF;
        for (unsigned k = 0; k < 8; ++k) {
            const double at = begin + (static_cast<double>(10 * i + 1 + k) + 0.5) * bit;
            if (at >= 0 && !wireLevel(other.bytes, at / otherBit))
                kept &= static_cast<std::uint8_t>(~(1U << k));
        }
        one.damaged = one.damaged || (one.bytes[i] & kept) != one.bytes[i];
        one.bytes[i] &= kept;
        if (!one.atAdapter.empty())
            one.atAdapter[i] &= kept;
    }
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
    const LineTime from = std::max(first.what.begin, second.what.begin);
    const LineTime to = std::min(first.what.end(), second.what.end());
    const Transmission one = first.what, other = second.what; // as they were meant
    merge(first.what, other, from, to);
    merge(second.what, one, from, to);
    if (other.begin - one.begin >= one.byteTime() / 20) // who listens to the first misses the other's first start bit
        second.what.damaged = true;
    // An adapter that hands no echo on doesn't listen while it sends.
    const bool listens = m_echo || (one.sender && other.sender);
    for (std::size_t i = 0; !listens && i < first.absorbed.size(); ++i)
        first.absorbed[i] = first.absorbed[i] || overlaps(one, i, from, to);
    // The controller hears one stream: the earlier one stands for both, and then what is left of the later one.
    for (std::size_t i = 0; i < second.absorbed.size(); ++i) {
        if (arrival(other, i) - other.byteTime() < to)
            second.absorbed[i] = true;
    }
    if (other.end() > one.end())
        hearTail(second, to);
}

/// The listener comes in where another transmission ended, perhaps in the middle of a byte, and takes for a start bit what
/// looks like one.
void Wire::hearTail(OnWire &one, LineTime from)
{
    Transmission &what = one.what;
    if (what.atAdapter.empty())
        what.atAdapter = what.bytes;
    const LineTime since = from - what.begin;
    const double skipped = 10.0 * static_cast<double>(since.count()) / static_cast<double>(what.byteTime().count());
    std::fill(one.absorbed.begin(), one.absorbed.end(), true);
    for (const LateByte &late : heardFromWithin(what.bytes, skipped)) {
        const std::size_t index = std::min(late.endsIn, one.absorbed.size() - 1);
        what.atAdapter[index] = late.byte;
        one.absorbed[index] = false;
    }
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
