// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/damage.h"

#include "core/protocol/packet.h"

#include <algorithm>
#include <set>

namespace dynascope::sim {
namespace {

struct Place {
    std::size_t begin = 0, size = 0; ///< bytes
};

Place placeOf(PacketPart part, PacketForm form, std::size_t size)
{
    constexpr std::size_t CrcSize = 2;
    const bool fast = form == PacketForm::FirstFastPiece || form == PacketForm::FastPiece;
    const std::size_t prefix = form == PacketForm::FastPiece ? 0 : HeaderSize + 1; // with the instruction byte
    const std::size_t error = form == PacketForm::Instruction ? 0 : 1;
    const std::size_t dataAt = prefix + error + (fast ? 1 : 0);
    const std::size_t inPrefix = prefix > 0 ? 1 : 0;
    switch (part) {
    case PacketPart::Any: break;
    case PacketPart::Header: return {0, inPrefix * (fast ? 5 : 4)};
    case PacketPart::Id: return {fast ? prefix + error : 4, 1};
    case PacketPart::Length: return {5, inPrefix * 2};
    case PacketPart::Instruction: return {7, inPrefix};
    case PacketPart::Error: return {prefix, error};
    case PacketPart::Data: return {dataAt, size - CrcSize - dataAt};
    case PacketPart::Crc: return {size - CrcSize, CrcSize};
    }
    return {0, size};
}

} // namespace

bool damagePacket(Bytes &packet, PacketForm form, const Damage &damage, Chance &chance)
{
    const Place place = placeOf(damage.part, form, packet.size());
    const std::size_t count = place.size * 8;
    std::set<std::size_t> turned; // bits of the part
    if (count == 0)
        return false;
    if (damage.burst > 0) {
        const std::size_t width = std::min(static_cast<std::size_t>(damage.burst), count);
        const std::size_t last = count - width;
        const std::size_t at =
            damage.firstBit < 0 ? chance.below(last + 1) : std::min(static_cast<std::size_t>(damage.firstBit), last);
        for (std::size_t i = 0; i < width; ++i) {
            if (i == 0 || i == width - 1 || chance.below(2) != 0)
                turned.insert(at + i);
        }
    } else {
        const std::size_t bits = std::min(static_cast<std::size_t>(std::max(damage.bits, 0)), count);
        if (damage.firstBit >= 0 && bits > 0)
            turned.insert(static_cast<std::size_t>(damage.firstBit) % count);
        while (turned.size() < bits)
            turned.insert(chance.below(count));
    }
    for (const std::size_t bit : turned)
        packet[place.begin + bit / 8] ^= static_cast<std::uint8_t>(1U << (bit % 8));
    return !turned.empty();
}

} // namespace dynascope::sim
