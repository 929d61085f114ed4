// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/rfc2217.h"

#include <limits>

namespace dynascope {
namespace {

// RFC 854
constexpr std::uint8_t Se = 240;
constexpr std::uint8_t Sb = 250;
constexpr std::uint8_t Will = 251;
constexpr std::uint8_t Wont = 252;
constexpr std::uint8_t Do = 253;
constexpr std::uint8_t Dont = 254;
constexpr std::uint8_t Iac = 255;

// Options: RFC 856, RFC 858, RFC 2217
constexpr std::uint8_t Binary = 0;
constexpr std::uint8_t SuppressGoAhead = 3;
constexpr std::uint8_t ComPort = 44;

// RFC 2217, section 3. The server answers with the same number and 100 more.
constexpr std::uint8_t SetBaudRate = 1;
constexpr std::uint8_t SetDataSize = 2;
constexpr std::uint8_t SetParity = 3;
constexpr std::uint8_t SetStopSize = 4;
constexpr std::uint8_t SetControl = 5;
constexpr std::uint8_t SetLineStateMask = 10;
constexpr std::uint8_t SetModemStateMask = 11;
constexpr std::uint8_t PurgeData = 12;
constexpr std::uint8_t OfServer = 100;

/// The longest one that matters has six bytes; what is longer is a signature, or an attack.
constexpr std::size_t LongestSub = 32;

bool isWanted(std::uint8_t option)
{
    return option == Binary || option == SuppressGoAhead || option == ComPort;
}

void appendSub(Bytes &to, std::uint8_t command, ByteView values)
{
    to.insert(to.end(), {Iac, Sb, ComPort, command});
    const Bytes escaped = Rfc2217::escaped(values);
    to.insert(to.end(), escaped.begin(), escaped.end());
    to.insert(to.end(), {Iac, Se});
}

void appendSub(Bytes &to, std::uint8_t command, std::uint8_t value)
{
    appendSub(to, command, ByteView(&value, 1));
}

} // namespace

Bytes Rfc2217::greeting()
{
    return {Iac, Will, ComPort,         Iac, Will, Binary,         Iac, Do, Binary,
            Iac, Will, SuppressGoAhead, Iac, Do,   SuppressGoAhead};
}

Bytes Rfc2217::portSettings()
{
    constexpr std::uint8_t NoParity = 1;
    constexpr std::uint8_t NoFlowControl = 1;
    constexpr std::uint8_t NoFlowControlInbound = 14;
    Bytes bytes;
    appendSub(bytes, SetDataSize, 8);
    appendSub(bytes, SetParity, NoParity);
    appendSub(bytes, SetStopSize, 1);
    appendSub(bytes, SetControl, NoFlowControl);
    appendSub(bytes, SetControl, NoFlowControlInbound);
    appendSub(bytes, SetLineStateMask, 0);
    appendSub(bytes, SetModemStateMask, 0);
    return bytes;
}

Bytes Rfc2217::requestRate(int bitsPerSecond)
{
    constexpr std::uint8_t ReceiveBuffer = 1;
    m_asked = true;
    m_confirmed.reset();
    Bytes rate;
    for (int shift = 24; shift >= 0; shift -= 8)
        rate.push_back(static_cast<std::uint8_t>(static_cast<std::uint32_t>(bitsPerSecond) >> shift));
    Bytes bytes;
    appendSub(bytes, SetBaudRate, rate);
    appendSub(bytes, PurgeData, ReceiveBuffer);
    return bytes;
}

Bytes Rfc2217::escaped(ByteView data)
{
    Bytes bytes;
    bytes.reserve(data.size() + 8);
    for (const std::uint8_t byte : data) {
        bytes.push_back(byte);
        if (byte == Iac)
            bytes.push_back(Iac);
    }
    return bytes;
}

void Rfc2217::feed(ByteView received, Bytes &data, Bytes &answer)
{
    for (const std::uint8_t byte : received) {
        switch (m_state) {
        case State::Data: this->data(byte, data); break;
        case State::TelnetCommand: command(byte, data); break;
        case State::Option: option(byte, answer); break;
        case State::Sub: sub(byte); break;
        case State::SubCommand:
            if (byte == Iac) { // a doubled FF
                m_state = State::Sub;
                if (m_sub.size() <= LongestSub)
                    m_sub.push_back(byte);
            } else if (byte == Se) {
                endOfSub();
            } else { // it was never ended: RFC 854 knows no such thing, and what follows is a command
                m_state = State::TelnetCommand;
                command(byte, data);
            }
            break;
        }
    }
}

void Rfc2217::data(std::uint8_t byte, Bytes &data)
{
    if (byte == Iac)
        m_state = State::TelnetCommand;
    else
        data.push_back(byte);
}

void Rfc2217::command(std::uint8_t byte, Bytes &data)
{
    m_state = State::Data;
    switch (byte) {
    case Iac: data.push_back(byte); break;
    case Sb:
        m_sub.clear();
        m_state = State::Sub;
        break;
    case Will:
    case Wont:
    case Do:
    case Dont:
        m_verb = byte;
        m_state = State::Option;
        break;
    default: break; // NOP, data mark, go ahead...: nothing follows them
    }
}

/// What we offered and asked for in the greeting needs no second word; of the rest nothing is wanted.
void Rfc2217::option(std::uint8_t option, Bytes &answer)
{
    m_state = State::Data;
    if (option == ComPort) {
        const bool yes = m_verb == Do || m_verb == Will;
        if (yes)
            m_agreement = Agreement::Agreed;
        else if (m_verb == Dont)
            m_agreement = Agreement::Refused;
    }
    const auto once = [&](std::bitset<256> &answered, std::uint8_t word) {
        if (answered[option])
            return;
        answered[option] = true;
        answer.insert(answer.end(), {Iac, word, option});
    };
    if (m_verb == Do && !isWanted(option))
        once(m_answeredDo, Wont);
    else if (m_verb == Will && !isWanted(option))
        once(m_answeredWill, Dont);
    else if (m_verb == Will && option == ComPort) // not asked for in the greeting: the client is who offers it
        once(m_answeredWill, Do);
}

void Rfc2217::sub(std::uint8_t byte)
{
    if (byte == Iac)
        m_state = State::SubCommand;
    else if (m_sub.size() <= LongestSub) // one more than allowed marks it as too long
        m_sub.push_back(byte);
}

void Rfc2217::endOfSub()
{
    m_state = State::Data;
    // Option, command, four bytes of rate, high byte first.
    if (!m_asked || m_sub.size() != 6 || m_sub[0] != ComPort || m_sub[1] != SetBaudRate + OfServer)
        return;
    std::uint32_t rate = 0;
    for (std::size_t i = 2; i < m_sub.size(); ++i)
        rate = rate << 8 | m_sub[i];
    constexpr auto Highest = static_cast<std::uint32_t>(std::numeric_limits<int>::max());
    m_asked = false;
    m_confirmed = rate <= Highest ? static_cast<int>(rate) : 0;
}

} // namespace dynascope
