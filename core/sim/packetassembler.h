// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/line.h"

#include <optional>

namespace dynascope::sim {

/// Puts a client's instruction packets together again: what a program writes at once may come from its terminal in
/// pieces, with gaps that a real port's UART would not make.
class PacketAssembler
{
public:
    void feed(ByteView bytes, LineTime now);

    /// A whole packet; or bytes that can't become one, or did not in time: those too go onto the wire.
    std::optional<Bytes> next(LineTime now);
    /// When next() gives up waiting for the rest.
    std::optional<LineTime> deadline() const;
    void clear() { m_buffer.clear(); }

private:
    Bytes take(std::size_t bytes);

    Bytes m_buffer;
    LineTime m_fed{};
};

} // namespace dynascope::sim
