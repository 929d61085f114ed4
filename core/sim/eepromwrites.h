// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/line.h"
#include "core/sim/registerfile.h"

namespace dynascope::sim {

/// Writes into the EEPROM that are on their way: a register has its new value at once for those who read, but a loss of
/// power before it is stored leaves the old one. Registers are stored one after the other, each as a whole. A value.
class EepromWrites
{
public:
    /// `fields` as they stand now in `registers`; the last is stored within `duration`.
    void begin(RegisterFile &registers, const std::vector<const Field *> &fields, LineTime from, LineTime duration);
    void cut(RegisterFile &registers, LineTime at); ///< power is gone: what isn't stored by then never is
    bool isBusy(LineTime at) const { return !m_pending.empty() && m_pending.back().at > at; }

private:
    void store(RegisterFile &registers, LineTime until);

    struct Pending {
        LineTime at{};
        const Field *field = nullptr;
        Bytes value;
    };
    std::vector<Pending> m_pending; ///< by time
};

} // namespace dynascope::sim
