// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/sim/simulatedbus.h"

#include <limits>
#include <memory>

namespace dynascope::sim {

struct Chain;

/// Bytes that somebody puts on the wire without a gap.
struct Transmission {
    static constexpr std::size_t NothingLost = std::numeric_limits<std::size_t>::max();

    LineTime begin{};
    int baudRate = 57600;
    const Servo *sender = nullptr; ///< nullptr: the controller
    Bytes bytes;
    bool damaged = false;          ///< somebody else spoke at the same time
    std::shared_ptr<Chain> chain;  ///< of a group read
    std::size_t index = 0;         ///< place in the chain
    Bytes atAdapter;               ///< what the controller hears where that differs; as long as `bytes`
    std::size_t lostFrom = NothingLost; ///< from this byte on the controller hears nothing
    LineTime lateness{};           ///< the adapter hands it on so much later

    LineTime byteTime() const { return LineTime(10'000'000'000LL / baudRate); }
    LineTime end() const { return begin + static_cast<LineTime::rep>(bytes.size()) * byteTime(); }
};

/// A byte at the controller's end of the wire.
struct HeardByte {
    LineTime at{};
    LineTime lateness{};
    std::uint8_t byte = 0;
    bool answer = false; ///< a device's
};

/// The half-duplex wire: who speaks when, what the controller hears. Where two speak at a time the wire is low when either
/// pulls it low, and what a UART makes of that is heard. Part of the bus.
class Wire
{
public:
    void begin(Transmission transmission);

    std::optional<LineTime> nextEnd() const; ///< of a transmission that nobody has taken yet
    Transmission takeEnded();                ///< the one that ends first; for the servos' ears

    /// The controller's end: bytes up to `now`, each once.
    void hear(std::vector<HeardByte> &to, LineTime now, int baudRate);
    void setEcho(bool echo) { m_echo = echo; } ///< the controller hears itself
    std::optional<LineTime> nextByte() const;
    std::optional<LineTime> quiet() const; ///< when the bytes under way will all have come
    std::optional<LineTime> busyUntil(LineTime at) const; ///< nothing where nobody speaks at that moment

private:
    struct OnWire {
        Transmission what;
        std::vector<bool> absorbed; ///< bytes that another one stands in for
        std::size_t delivered = 0;  ///< to the controller
        bool ended = false;         ///< taken
    };
    bool isHeard(const OnWire &one) const { return one.what.sender || m_echo; }
    void collide(OnWire &first, OnWire &second);
    void hearTail(OnWire &one, LineTime from);
    void forgetDone();

    std::vector<OnWire> m_onWire; ///< by begin
    bool m_echo = false;
};

} // namespace dynascope::sim
