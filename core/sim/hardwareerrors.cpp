// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/hardwareerrors.h"

namespace dynascope::sim {
namespace {

struct ErrorBit {
    const char16_t *part; ///< of the bit's name
    const char16_t *name;
    std::uint8_t bit;     ///< where a table doesn't name its bits: those of the X series
    int code;             ///< Error Code of the Y series
};

// In the order of HardwareFault. Error Code has two numbers for the voltage: too low is the usual one.
constexpr std::array<ErrorBit, HardwareFaultCount> ErrorKinds{{
    {u"voltage", u"Input voltage", 0x01, 2},
    {u"hall", u"Hall sensor", 0x02, 14},
    {u"overheat", u"Overheating", 0x04, 4},
    {u"encoder", u"Motor encoder", 0x08, 13},
    {u"shock", u"Electrical shock", 0x10, 7},
    {u"overload", u"Overload", 0x20, 5},
}};

std::uint8_t bitOf(const Field &status, const ErrorBit &kind)
{
    if (status.bits.empty())
        return kind.bit;
    for (const BitField &bit : status.bits) {
        if (bit.first < 8 && bit.name.contains(QStringView(kind.part), Qt::CaseInsensitive))
            return static_cast<std::uint8_t>(1U << bit.first);
    }
    return 0;
}

} // namespace

HardwareErrors::HardwareErrors(RegisterFile &registers)
    : m_registers(registers)
{
    const Field *status = registers.field(Reg::HardwareErrorStatus);
    for (std::size_t i = 0; status && i < ErrorKinds.size(); ++i)
        m_bits[i] = bitOf(*status, ErrorKinds[i]);
}

bool HardwareErrors::knows(HardwareFault fault) const
{
    return m_bits[static_cast<std::size_t>(fault)] != 0 || m_registers.has(Reg::ErrorCode);
}

bool HardwareErrors::latch(HardwareFault fault)
{
    if (const std::uint8_t bit = m_bits[static_cast<std::size_t>(fault)])
        return latchBits(bit);
    if (!m_registers.has(Reg::ErrorCode))
        return false;
    if (m_registers.get(Reg::ErrorCode) == 0) // the first one stays
        m_registers.set(Reg::ErrorCode, ErrorKinds[static_cast<std::size_t>(fault)].code);
    return true;
}

bool HardwareErrors::latchBits(std::uint8_t bits)
{
    m_registers.set(Reg::HardwareErrorStatus, m_registers.get(Reg::HardwareErrorStatus) | bits);
    return (m_registers.get(Reg::Shutdown) & bits) != 0;
}

bool HardwareErrors::isAlert() const
{
    return m_registers.get(Reg::HardwareErrorStatus) != 0 || m_registers.get(Reg::ErrorCode) != 0;
}

void HardwareErrors::clear()
{
    m_registers.set(Reg::HardwareErrorStatus, 0);
    m_registers.set(Reg::ErrorCode, 0);
}

QStringList HardwareErrors::names() const
{
    QStringList latched;
    const std::int64_t status = m_registers.get(Reg::HardwareErrorStatus);
    for (std::size_t i = 0; i < ErrorKinds.size(); ++i) {
        if (status & m_bits[i])
            latched.append(QString::fromUtf16(ErrorKinds[i].name));
    }
    if (const std::int64_t code = m_registers.get(Reg::ErrorCode))
        latched.append(QStringLiteral("Error Code %1").arg(code));
    return latched;
}

} // namespace dynascope::sim
