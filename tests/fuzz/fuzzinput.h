// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bytes.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>

namespace fuzz {

using dynascope::Bytes;
using dynascope::ByteView;

/// The fuzzer's bytes, taken from the front; zeros once there are no more, so that every input means something.
class Input
{
public:
    Input(const std::uint8_t *data, std::size_t size) : m_rest(data, size) {}

    bool isEmpty() const { return m_rest.empty(); }
    std::uint8_t byte()
    {
        const Bytes one = bytes(1);
        return one.empty() ? std::uint8_t(0) : one.front();
    }
    /// Low byte first.
    std::uint16_t word()
    {
        const int low = byte();
        return static_cast<std::uint16_t>(low | byte() << 8);
    }
    /// As many as there are.
    Bytes bytes(std::size_t count)
    {
        const ByteView taken = m_rest.first(std::min(count, m_rest.size()));
        m_rest = m_rest.subspan(taken.size());
        return {taken.begin(), taken.end()};
    }
    Bytes rest() { return bytes(m_rest.size()); }

private:
    ByteView m_rest;
};

/// What holds for every input. Ends the program where it doesn't, which the fuzzer takes for a crash.
inline void must(bool holds, const char *what)
{
    if (holds)
        return;
    std::fprintf(stderr, "does not hold: %s\n", what);
    std::abort();
}

} // namespace fuzz
