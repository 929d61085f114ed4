// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/fuzz/dictatedline.h"

#include "tests/support/oracle.h"

using namespace dynascope;
using namespace std::chrono_literals;

namespace fuzz {

namespace {

constexpr std::size_t IdAt = 4;
constexpr std::size_t InstructionAt = 7;
constexpr std::size_t ParametersAt = 8;

enum Piece {
    End,
    Raw,       ///< so many bytes as they are
    Status,    ///< a status of any ID, error and length
    Right,     ///< a status as a Read or Ping asked for it, with any data
    Damaged,   ///< the same with a byte changed
    Cut,       ///< the same, so many bytes of it
    FastReply, ///< blocks as a Fast Sync Read asked for them, with any data
    Pause,     ///< in units of 100 µs
    LongPause, ///< in units of 10 ms
    Lost,      ///< the port is gone
    Kinds,
};

Bytes asAsked(const Bytes &request, Input &input)
{
    const bool isRead = request[InstructionAt] == 0x02 && request.size() >= ParametersAt + 4;
    std::size_t length = isRead ? littleEndian(ByteView(request).subspan(ParametersAt + 2), 2) : 0;
    if (request[InstructionAt] == 0x01)
        length = 3;
    return oracle::status(request[IdAt], 0, input.bytes(std::min<std::size_t>(length, 300)));
}

/// FF FF FD 00 FE LEN 55 | ERR ID data CRC | ..., each CRC over all before it.
Bytes fastReply(const Bytes &request, Input &input)
{
    const ByteView parameters = ByteView(request).subspan(ParametersAt, request.size() - ParametersAt - 2);
    const bool asked = request[InstructionAt] == 0x8A && parameters.size() > 4;
    const std::size_t length = asked ? littleEndian(parameters.subspan(2), 2) % 300 : 4;
    const std::size_t devices = asked ? std::min<std::size_t>(parameters.size() - 4, 8) : 1;
    const std::size_t total = 1 + devices * (length + 4);
    Bytes reply{0xFF, 0xFF, 0xFD, 0x00, 0xFE, std::uint8_t(total), std::uint8_t(total >> 8), 0x55};
    for (std::size_t i = 0; i < devices; ++i) {
        reply.push_back(0);
        reply.push_back(asked ? parameters[4 + i] : input.byte());
        Bytes data = input.bytes(length);
        data.resize(length);
        reply.insert(reply.end(), data.begin(), data.end());
        appendLittleEndian(reply, oracle::crc(reply), 2);
    }
    return reply;
}

} // namespace

DictatedLine::DictatedLine(Input &input) : m_input(input)
{
    const std::uint8_t flags = input.byte();
    m_echo = flags & 1;
    m_allowance = (flags >> 1) * 200us;
}

Result<void> DictatedLine::write(ByteView packet)
{
    if (m_lost)
        return failure(ErrorKind::PortLost, QStringLiteral("gone"));
    const Bytes request(packet.begin(), packet.end());
    m_wireFree = std::max(m_now, m_wireFree);
    if (m_echo)
        send(request);
    else
        m_wireFree += static_cast<LineTime::rep>(request.size()) * byteTime();
    answer(request);
    return {};
}

void DictatedLine::answer(const Bytes &request)
{
    while (const int kind = m_input.byte() % Kinds)
        send(piece(kind, request));
}

Bytes DictatedLine::piece(int kind, const Bytes &request)
{
    switch (kind) {
    case Raw: return m_input.bytes(m_input.byte());
    case Status: {
        const std::uint8_t id = m_input.byte();
        const std::uint8_t error = m_input.byte();
        return oracle::status(id, error, m_input.bytes(m_input.byte()));
    }
    case Right: return asAsked(request, m_input);
    case Damaged: {
        Bytes bytes = asAsked(request, m_input);
        bytes[m_input.byte() % bytes.size()] ^= m_input.byte();
        return bytes;
    }
    case Cut: {
        Bytes bytes = asAsked(request, m_input);
        bytes.resize(m_input.byte() % bytes.size());
        return bytes;
    }
    case FastReply: return fastReply(request, m_input);
    case Pause: m_wireFree += m_input.byte() * 100us; return {};
    case LongPause: m_wireFree += m_input.byte() * 10ms; return {};
    case Lost: m_lost = m_input.byte() == 0x4C; return {}; // rarely: nothing happens afterwards
    default: return {};
    }
}

void DictatedLine::send(const Bytes &bytes)
{
    for (const std::uint8_t byte : bytes) {
        m_wireFree += byteTime();
        m_arrivals.emplace_back(m_wireFree, byte);
    }
}

Result<void> DictatedLine::read(Bytes &buffer, LineTime deadline)
{
    if (m_lost)
        return failure(ErrorKind::PortLost, QStringLiteral("gone"));
    const bool isHere = !m_arrivals.empty() && m_arrivals.front().first <= std::max(m_now, deadline);
    m_now = isHere ? std::max(m_now, m_arrivals.front().first) : std::max(m_now, deadline);
    while (!m_arrivals.empty() && m_arrivals.front().first <= m_now) {
        buffer.push_back(m_arrivals.front().second);
        m_delivered.push_back(m_arrivals.front().second);
        m_arrivals.pop_front();
    }
    return {};
}

void DictatedLine::discardInput()
{
    while (!m_arrivals.empty() && m_arrivals.front().first <= m_now)
        m_arrivals.pop_front();
}

} // namespace fuzz
