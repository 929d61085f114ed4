// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/sim/chance.h"
#include "core/sim/linefaults.h"

namespace dynascope::sim {

/// What stands where in a packet. A fast reply is put together of pieces, one by each device.
enum class PacketForm { Instruction, Status, FirstFastPiece, FastPiece };

/// Turns bits of a whole packet or piece, in serial order: the lowest bit of a byte goes first. False where it
/// stays whole.
bool damagePacket(Bytes &packet, PacketForm form, const Damage &damage, Chance &chance);

} // namespace dynascope::sim
