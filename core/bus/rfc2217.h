// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bytes.h"

#include <bitset>
#include <optional>

namespace dynascope {

/// The client's side of Telnet with COM-PORT-OPTION (RFC 854, RFC 2217): bytes in, data and answers out. No I/O, no
/// clock. What comes may be anything: nothing kept here grows beyond a few dozen bytes, and what is answered is at most
/// one answer per Telnet option and direction.
class Rfc2217
{
public:
    /// Has the server agreed to control its port for us?
    enum class Agreement { Pending, Agreed, Refused };

    /// What is sent first: an offer of COM-PORT-OPTION and eight-bit data.
    static Bytes greeting();
    /// Once agreed: 8 data bits, no parity, one stop bit, no flow control, no notices about modem lines.
    static Bytes portSettings();
    /// Sets the rate and, after it, forgets what the server's port received before. confirmedRate() then tells what the
    /// server made of it.
    Bytes requestRate(int bitsPerSecond);
    /// Data as it goes on the wire: FF is doubled.
    static Bytes escaped(ByteView data);

    /// Takes what came, in pieces of any size. Appends the port's bytes to `data`, and to `answer` what has to be sent
    /// back now.
    void feed(ByteView received, Bytes &data, Bytes &answer);

    Agreement agreement() const { return m_agreement; }
    /// The rate that answers the last request; empty while there is no answer.
    std::optional<int> confirmedRate() const { return m_confirmed; }

private:
    enum class State { Data, TelnetCommand, Option, Sub, SubCommand };

    void data(std::uint8_t byte, Bytes &data);
    void command(std::uint8_t byte, Bytes &data);
    void option(std::uint8_t option, Bytes &answer);
    void sub(std::uint8_t byte);
    void endOfSub();

    State m_state = State::Data;
    std::uint8_t m_verb = 0;
    Bytes m_sub;
    Agreement m_agreement = Agreement::Pending;
    bool m_asked = false; ///< a rate has been requested and not been confirmed
    std::optional<int> m_confirmed;
    std::bitset<256> m_answeredDo; ///< one answer for each, or two machines could go on for ever
    std::bitset<256> m_answeredWill;
};

} // namespace dynascope
