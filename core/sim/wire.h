// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/sim/simulatedbus.h"

#include <memory>

namespace dynascope::sim {

struct Chain;

/// Bytes that somebody puts on the wire without a gap.
struct Transmission {
    LineTime begin{};
    int baudRate = 57600;
    const Servo *sender = nullptr; ///< nullptr: the controller
    Bytes bytes;
    bool damaged = false;          ///< somebody else spoke at the same time
    std::shared_ptr<Chain> chain;  ///< of a group read
    std::size_t index = 0;         ///< place in the chain

    LineTime byteTime() const { return LineTime(10'000'000'000LL / baudRate); }
    LineTime end() const { return begin + static_cast<LineTime::rep>(bytes.size()) * byteTime(); }
};

/// The half-duplex wire: who speaks when, what happens when two do, what the controller hears. Part of the bus.
class Wire
{
public:
    explicit Wire(std::uint64_t seed) : m_random(seed * 2 + 1) {}

    void begin(Transmission transmission);

    std::optional<LineTime> nextEnd() const; ///< of a transmission that nobody has taken yet
    Transmission takeEnded();                ///< the one that ends first; for the servos' ears

    /// The controller's ear: bytes up to `now`, each once.
    void hear(Bytes &to, LineTime now, int baudRate);
    void discard(LineTime now);
    std::optional<LineTime> nextByte() const;
    std::optional<LineTime> quiet() const; ///< when the bytes under way will all have come

private:
    struct OnWire {
        Transmission what;
        std::vector<bool> absorbed; ///< bytes that another one stands in for
        std::size_t delivered = 0;  ///< to the controller
        bool ended = false;         ///< taken
    };
    void collide(OnWire &first, OnWire &second);
    void scramble(OnWire &one, LineTime from, LineTime to);
    void forgetDone();
    std::uint8_t randomByte();

    std::vector<OnWire> m_onWire; ///< by begin
    std::uint64_t m_random;
};

} // namespace dynascope::sim
