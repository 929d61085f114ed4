// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/line.h"
#include "core/table/controltable.h"

#include <optional>
#include <span>

/// What tells that a servo has lost its power, or was rebooted, between two looks at it. Pure.
namespace dynascope {

/// Realtime Tick of one device, look after look. It counts milliseconds from the device's start and begins anew at 0
/// after 32 767 (manual, "Realtime Tick"); where a table doesn't say where it ends, 65 536 is a multiple of that, too.
class TickSign
{
public:
    static constexpr std::int64_t Period = 32'768; ///< ms

    enum class Verdict {
        Runs,      ///< it is where it should be, or this was the first look
        Restarted, ///< it is elsewhere, and began anew since the last look
        Unclear,   ///< it can't tell: too long ago, it went round just then, or it is where no restart would have it
    };
    /// `at`: when the answer had come, by the line's clock.
    Verdict take(LineTime at, std::int64_t tick);
    bool isKnown() const { return m_last.has_value(); } ///< there is a look to compare the next one with
    void forget() { m_last.reset(); } ///< the next look is the first

private:
    struct Look {
        LineTime at{};
        std::int64_t tick = 0;
    };
    std::optional<Look> m_last;
};

/// The register, where this table has one that counts milliseconds; nullptr elsewhere (XL-320, PRO).
const Field *tickField(const ControlTable &table);

/// A register that was set in this session, as it is now.
struct SetReading {
    std::int64_t now = 0;
    std::int64_t set = 0;
    std::optional<std::int64_t> initial; ///< what it holds after a start; not known of every one
};
/// Without a tick: torque is off, nothing holds any more what was set, and something is at its initial value. Torque
/// off alone is none: somebody turned it off, or an error did. `torqueOn`: missing where the device has none.
bool looksRestarted(std::optional<bool> torqueOn, std::span<const SetReading> readings);

} // namespace dynascope
