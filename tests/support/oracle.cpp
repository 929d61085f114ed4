// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/oracle.h"

namespace oracle {

std::uint16_t crc(const Bytes &bytes)
{
    // Long division of the message by x^16 + x^15 + x^2 + 1, one bit at a time.
    std::uint32_t remainder = 0;
    for (const std::uint8_t byte : bytes) {
        for (int bit = 7; bit >= 0; --bit) {
            const bool top = (remainder & 0x8000U) != 0;
            remainder = (remainder << 1) & 0xFFFFU;
            if (top != (((byte >> bit) & 1U) != 0))
                remainder ^= 0x8005U;
        }
    }
    return static_cast<std::uint16_t>(remainder);
}

Bytes stuff(const Bytes &body)
{
    // Look back in the body as it was given: an FD with FF FF right before it is doubled.
    Bytes out;
    for (std::size_t i = 0; i < body.size(); ++i) {
        out.push_back(body[i]);
        if (i >= 2 && body[i] == 0xFD && body[i - 1] == 0xFF && body[i - 2] == 0xFF)
            out.push_back(0xFD);
    }
    return out;
}

namespace {

bool search(const Bytes &stuffed, std::size_t at, Bytes &body)
{
    if (at == stuffed.size())
        return stuff(body) == stuffed;
    body.push_back(stuffed[at]);
    if (search(stuffed, at + 1, body))
        return true;
    if (at + 1 < stuffed.size() && stuffed[at + 1] == 0xFD && search(stuffed, at + 2, body))
        return true;
    body.pop_back();
    return false;
}

Bytes packet(std::uint8_t id, const Bytes &body)
{
    const Bytes stuffed = stuff(body);
    const std::size_t length = stuffed.size() + 2;
    Bytes out{0xFF, 0xFF, 0xFD, 0x00, id, static_cast<std::uint8_t>(length % 256),
              static_cast<std::uint8_t>(length / 256)};
    out.insert(out.end(), stuffed.begin(), stuffed.end());
    const std::uint16_t sum = crc(out);
    out.push_back(static_cast<std::uint8_t>(sum % 256));
    out.push_back(static_cast<std::uint8_t>(sum / 256));
    return out;
}

} // namespace

Bytes unstuff(const Bytes &stuffed, bool *found)
{
    Bytes body;
    *found = search(stuffed, 0, body);
    return *found ? body : Bytes();
}

Bytes instruction(std::uint8_t id, std::uint8_t code, const Bytes &parameters)
{
    Bytes body{code};
    body.insert(body.end(), parameters.begin(), parameters.end());
    return packet(id, body);
}

Bytes status(std::uint8_t id, std::uint8_t error, const Bytes &parameters)
{
    Bytes body{0x55, error};
    body.insert(body.end(), parameters.begin(), parameters.end());
    return packet(id, body);
}

} // namespace oracle
