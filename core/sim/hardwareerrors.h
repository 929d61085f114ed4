// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/sim/registerfile.h"

#include <QStringList>

namespace dynascope::sim {

/// What can go wrong inside a servo. Manual: "Hardware Error Status", "Shutdown"; Y series: "Error Code".
enum class HardwareFault { InputVoltage, HallSensor, Overheating, Encoder, ElectricalShock, Overload };
constexpr int HardwareFaultCount = 6;

/// A servo's latched hardware errors, as its table has them: bits with names, or the number of the Y series. A model
/// without a bit for a fault doesn't know that fault. Owned by the servo, whose registers it works on.
class HardwareErrors
{
public:
    explicit HardwareErrors(RegisterFile &registers);

    bool knows(HardwareFault fault) const;
    bool latch(HardwareFault fault);    ///< true where it turns torque off
    bool latchBits(std::uint8_t bits);  ///< of Hardware Error Status, as they are
    bool isAlert() const;               ///< something is latched
    void clear();
    QStringList names() const; ///< of what is latched: "Overload", or "Error Code 5"

private:
    RegisterFile &m_registers;
    std::array<std::uint8_t, HardwareFaultCount> m_bits{}; ///< 0 where the model doesn't know it
};

} // namespace dynascope::sim
