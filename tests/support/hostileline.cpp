// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/hostileline.h"

#include "tests/support/oracle.h"

#include <algorithm>
#include <array>

using namespace dynascope;
using namespace std::chrono_literals;

namespace {

constexpr LineTime ReturnDelay = 200us;
constexpr std::size_t IdAt = 4, CodeAt = 7, ParametersAt = 8;

/// Ticks of a register's clock: so long that its bytes don't wrap within any exchange.
LineTime unitOf(int length)
{
    switch (length) {
    case 1: return 4ms;
    case 2: return 100us;
    default: return 1us;
    }
}

/// Every register has a clock of its own.
quint64 offsetOf(int id, int address, int length)
{
    quint64 mixed = static_cast<quint64>(id * 1'000'003 + address * 7919 + length) * 0x9E3779B97F4A7C15ULL;
    return mixed >> 24;
}

int word(const Bytes &bytes, std::size_t at)
{
    return bytes[at] + 256 * bytes[at + 1];
}

} // namespace

HostileLine::HostileLine(quint64 seed, int baudRate, LineTime allowance, bool echo)
    : m_random(seed), m_baudRate(baudRate), m_allowance(allowance), m_echo(echo)
{
}

Bytes HostileLine::valueAt(LineTime time, int id, int address, int length)
{
    const quint64 tick = static_cast<quint64>(time / unitOf(length)) + offsetOf(id, address, length);
    Bytes value;
    for (int i = 0; i < length; ++i) // beyond eight bytes again from the first
        value.push_back(static_cast<std::uint8_t>(tick >> (8 * (i % 8))));
    return value;
}

bool HostileLine::held(const Bytes &value, LineTime from, LineTime to, int id, int address)
{
    const int length = static_cast<int>(value.size());
    const LineTime unit = unitOf(length);
    quint64 shown = 0;
    for (int i = 0; i < std::min(length, 8); ++i)
        shown |= static_cast<quint64>(value[static_cast<std::size_t>(i)]) << (8 * i);
    const quint64 mask = length >= 8 ? ~quint64(0) : (quint64(1) << (8 * length)) - 1;
    const auto first = static_cast<quint64>(from / unit);
    const auto last = static_cast<quint64>(to / unit);
    const quint64 since = (shown - offsetOf(id, address, length) - first) & mask;
    return since <= last - first
        && valueAt(static_cast<LineTime::rep>(first + since) * unit, id, address, length) == value;
}

bool HostileLine::wasWritten(int id, int address) const
{
    return std::ranges::find(m_writes, std::pair(id, address)) != m_writes.end();
}

Result<void> HostileLine::write(ByteView packet)
{
    const LineTime begin = std::max(m_now, m_sentBy);
    m_sentBy = begin + static_cast<LineTime::rep>(packet.size()) * byteTime();
    m_wireFree = m_sentBy;
    const Bytes request(packet.begin(), packet.end());
    if (m_echo)
        deliver(request, begin);
    answer(request);
    return {};
}

void HostileLine::answer(const Bytes &request)
{
    const int id = request[IdAt];
    const int code = request[CodeAt];
    bool found = false;
    const Bytes body = oracle::unstuff({request.begin() + CodeAt, request.end() - 2}, &found);
    const Bytes parameters(body.begin() + 1, body.end());
    const auto is = [id](int each) { return id == each || id == 254; };
    std::vector<std::array<int, 3>> wanted; // ID, address, length
    if (code == 0x82 || code == 0x8A) {
        for (std::size_t i = 4; i < parameters.size(); ++i)
            wanted.push_back({parameters[i], word(parameters, 0), word(parameters, 2)});
    } else if (code == 0x92 || code == 0x9A) {
        for (std::size_t i = 0; i + 4 < parameters.size(); i += 5)
            wanted.push_back({parameters[i], word(parameters, i + 1), word(parameters, i + 3)});
    }
    if (!wanted.empty()) {
        answerGroup(wanted, code == 0x8A || code == 0x9A);
        return;
    }
    for (int each = 1; each <= Servos; ++each) {
        if (!is(each) || chance(m_manners.silence / 2)) // half of the silence: not even heard
            continue;
        const LineTime begin = code == 1 && id == 254 ? m_sentBy + 3ms * each : m_wireFree + ReturnDelay;
        Bytes data;
        if (code == 1)
            data = {6, 4, static_cast<std::uint8_t>(each)};
        else if (code == 2)
            data = valueAt(begin, each, word(parameters, 0), word(parameters, 2));
        else if (code == 3 || code == 4)
            m_writes.emplace_back(each, word(parameters, 0));
        else if (code == 5)
            m_writes.emplace_back(each, ActionMark);
        if (each == m_mute && code > 2)
            continue;
        reply(oracle::status(static_cast<std::uint8_t>(each), 0, data), begin);
    }
}

/// Each waits for the one before it; the adapter's faults come behind the wire and break no chain.
void HostileLine::answerGroup(const std::vector<std::array<int, 3>> &wanted, bool fast)
{
    Bytes joined{0xFF, 0xFF, 0xFD, 0, 0xFE, 0, 0, 0x55};
    std::size_t length = 1;
    for (const auto &[id, address, size] : wanted)
        length += static_cast<std::size_t>(size) + 4;
    joined[5] = static_cast<std::uint8_t>(length);
    joined[6] = static_cast<std::uint8_t>(length >> 8);
    for (const auto &[id, address, size] : wanted) {
        if (id > Servos || chance(m_manners.silence / 2))
            break;
        const LineTime begin = m_wireFree + ReturnDelay;
        const Bytes data = valueAt(begin, id, address, size);
        if (!fast) {
            reply(oracle::status(static_cast<std::uint8_t>(id), 0, data), begin);
            continue;
        }
        joined.push_back(0);
        joined.push_back(static_cast<std::uint8_t>(id));
        joined.insert(joined.end(), data.begin(), data.end());
        const std::uint16_t crc = oracle::crc(joined);
        joined.push_back(static_cast<std::uint8_t>(crc));
        joined.push_back(static_cast<std::uint8_t>(crc >> 8));
    }
    if (fast && joined.size() > ParametersAt)
        reply(joined, m_wireFree + ReturnDelay);
}

/// `packet` stands on the wire from `begin` on; what the host gets of it is another matter.
void HostileLine::reply(Bytes packet, LineTime begin)
{
    m_wireFree = std::max(m_wireFree, begin) + static_cast<LineTime::rep>(packet.size()) * byteTime();
    if (chance(m_manners.silence / 2))
        return;
    if (chance(m_manners.damage))
        damage(packet);
    if (chance(m_manners.cut)) {
        const std::size_t size = upTo(packet.size() + 1);
        if (chance(0.8))
            packet.resize(size);
        else
            packet.erase(packet.begin(), packet.begin() + static_cast<std::ptrdiff_t>(size));
    }
    if (chance(m_manners.delay)) {
        const LineTime longest = chance(0.5) ? m_manners.longestDelay / 50 : m_manners.longestDelay;
        m_adapterFree = std::max(m_adapterFree, begin + longest * static_cast<LineTime::rep>(upTo(1000)) / 1000);
    }
    Bytes noise;
    static constexpr std::array<std::uint8_t, 8> Likely{0xFF, 0xFF, 0xFD, 0, 1, 7, 0, 0x55};
    for (std::size_t i = chance(m_manners.noise) ? 1 + upTo(12) : 0; i > 0; --i)
        noise.push_back(chance(0.6) ? Likely[upTo(Likely.size())] : static_cast<std::uint8_t>(m_random()));
    const bool before = chance(0.5);
    if (before)
        packet.insert(packet.begin(), noise.begin(), noise.end());
    else
        packet.insert(packet.end(), noise.begin(), noise.end());
    deliver(packet, begin);
}

void HostileLine::damage(Bytes &packet)
{
    // Bits in the CRC's order, highest first: a burst is one by that order.
    const auto flip = [&](std::size_t bit) { packet[bit / 8] ^= static_cast<std::uint8_t>(0x80U >> (bit % 8)); };
    const std::size_t bits = 8 * packet.size();
    if (m_manners.kind == Damage::Seen) {
        // The CRC's low byte goes first: a burst across its begin is none in its own order, and may go unseen. A fast
        // answer has such places all over.
        constexpr std::size_t Burst = 16, Crc = 16;
        if (packet[IdAt] == 0xFE || chance(0.5)) {
            for (std::size_t i = 1 + upTo(3); i > 0; --i)
                flip(upTo(bits));
        } else {
            const std::size_t begin = upTo(bits - Crc - Burst + 1);
            for (std::size_t i = 0; i < Burst; ++i) {
                if (chance(0.5))
                    flip(begin + i);
            }
        }
        return;
    }
    for (std::size_t i = 1 + upTo(4); i > 0 && !packet.empty(); --i) {
        const auto at = packet.begin() + static_cast<std::ptrdiff_t>(upTo(packet.size()));
        switch (upTo(4)) {
        case 0: *at = static_cast<std::uint8_t>(m_random()); break;
        case 1: packet.erase(at); break;
        case 2: packet.insert(at, static_cast<std::uint8_t>(m_random())); break;
        default:
            for (std::size_t flips = 4 + upTo(12); flips > 0; --flips)
                flip(upTo(8 * packet.size()));
        }
    }
}

void HostileLine::deliver(const Bytes &bytes, LineTime begin)
{
    LineTime at = std::max(begin, m_adapterFree);
    for (const std::uint8_t byte : bytes) {
        at += byteTime();
        m_arrivals.push_back({at, byte});
    }
    m_adapterFree = at;
}

Result<void> HostileLine::read(Bytes &buffer, LineTime deadline)
{
    if (take(buffer) || deadline <= m_now)
        return {};
    if (m_arrivals.empty() || m_arrivals.front().at > deadline) {
        m_now = deadline;
        return {};
    }
    // Pieces of any size, as drivers hand them over.
    const std::size_t piece = chance(0.5) ? m_arrivals.size() : 1 + upTo(m_arrivals.size());
    m_now = m_arrivals.front().at;
    for (std::size_t i = 0; i < piece && m_arrivals[i].at <= deadline; ++i)
        m_now = m_arrivals[i].at;
    take(buffer);
    return {};
}

bool HostileLine::take(Bytes &buffer)
{
    bool any = false;
    for (; !m_arrivals.empty() && m_arrivals.front().at <= m_now; m_arrivals.pop_front()) {
        buffer.push_back(m_arrivals.front().byte);
        m_delivered.push_back(m_arrivals.front().byte);
        any = true;
    }
    return any;
}

void HostileLine::discardInput()
{
    Bytes ignored;
    take(ignored);
}

void HostileLine::calm()
{
    m_now = std::max({m_now, m_adapterFree, m_wireFree});
}
