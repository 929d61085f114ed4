// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/poll_values.h"

#include <map>
#include <optional>

namespace dynascope {

/// Where a register is, and how its bytes are a number.
struct RegisterPlace {
    std::uint16_t address = 0;
    std::uint8_t size = 1; ///< 1, 2 or 4 bytes
    bool isSigned = false;

    friend bool operator==(const RegisterPlace &, const RegisterPlace &) = default;
};

/// What was read of one device, by address. A value.
class RegisterImage
{
public:
    void take(std::uint16_t address, ByteView data)
    {
        for (const std::uint8_t byte : data)
            m_bytes[address++] = byte;
    }
    void take(std::span<const PollValue> values)
    {
        for (const PollValue &value : values)
            take(value.address, value.data);
    }
    /// Empty where not all of it is known.
    Bytes bytes(std::uint16_t address, std::size_t length) const
    {
        Bytes result;
        for (std::size_t i = 0; i < length; ++i) {
            const auto at = m_bytes.find(static_cast<std::uint16_t>(address + i));
            if (at == m_bytes.end())
                return {};
            result.push_back(at->second);
        }
        return result;
    }
    Bytes bytes(const RegisterPlace &where) const { return bytes(where.address, where.size); }
    std::optional<std::int64_t> number(const RegisterPlace &where) const
    {
        const Bytes known = bytes(where);
        return known.empty() ? std::nullopt : std::optional(numberOf(where, known));
    }
    static std::int64_t numberOf(const RegisterPlace &where, ByteView bytes)
    {
        const std::int64_t raw = littleEndian(bytes, where.size);
        const std::int64_t half = std::int64_t(1) << (8 * where.size - 1);
        return where.isSigned && raw >= half ? raw - 2 * half : raw;
    }

private:
    std::map<std::uint16_t, std::uint8_t> m_bytes;
};

} // namespace dynascope
