// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bytes.h"

namespace dynascope {

/// Appends `body` (instruction, error, parameters) to `to`, one FD inserted behind every FF FF FD of the body as
/// it was before stuffing. Manual: "Byte stuffing".
void appendStuffed(Bytes &to, ByteView body);

/// Does `body` hold a header pattern? Where not, it stands for itself.
bool isStuffed(ByteView body);

struct Unstuffed {
    Bytes body;
    bool forgotten = false; ///< the sender left an FF FF FD bare; its bytes were kept as they came
};

/// The body a stuffed one stands for. Behind FF FF FD exactly one FD is dropped, and nothing from before it is
/// remembered for the next match.
Unstuffed unstuff(ByteView stuffed);

} // namespace dynascope
