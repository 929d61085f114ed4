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
    LineTime fedAt() const { return m_fed; } ///< the latest bytes
    /// When next() gives up waiting for the rest.
    std::optional<LineTime> deadline() const;
    void clear() { m_buffer.clear(); }
    void setPatience(LineTime gap) { m_patience = gap; } ///< for the rest of a packet

private:
    Bytes take(std::size_t bytes);

    Bytes m_buffer;
    LineTime m_fed{};
    LineTime m_patience = std::chrono::milliseconds(20); ///< a busy host's, not the wire's 1.5 ms
};

} // namespace dynascope::sim
