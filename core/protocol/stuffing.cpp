// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/protocol/stuffing.h"

namespace dynascope {
namespace {

/// Follows a run of bytes and says when FF FF FD has just passed.
class PatternMatch
{
public:
    bool step(std::uint8_t byte)
    {
        if (byte == 0xFD && m_ones >= 2) {
            m_ones = 0;
            return true;
        }
        m_ones = byte == 0xFF ? m_ones + 1 : 0;
        return false;
    }
    void forget() { m_ones = 0; }

private:
    int m_ones = 0; ///< FF bytes directly before the present one
};

} // namespace

void appendStuffed(Bytes &to, ByteView body)
{
    PatternMatch match;
    for (const std::uint8_t byte : body) {
        to.push_back(byte);
        if (match.step(byte))
            to.push_back(0xFD);
    }
}

bool isStuffed(ByteView body)
{
    PatternMatch match;
    for (const std::uint8_t byte : body) {
        if (match.step(byte))
            return true;
    }
    return false;
}

Unstuffed unstuff(ByteView stuffed)
{
    Unstuffed result;
    result.body.reserve(stuffed.size());
    PatternMatch match;
    for (std::size_t i = 0; i < stuffed.size(); ++i) {
        result.body.push_back(stuffed[i]);
        if (!match.step(stuffed[i]))
            continue;
        if (i + 1 < stuffed.size() && stuffed[i + 1] == 0xFD) {
            ++i;
            match.forget();
        } else {
            result.forgotten = true;
        }
    }
    return result;
}

} // namespace dynascope
