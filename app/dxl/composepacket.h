// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bytes.h"
#include "core/result.h"

#include <QStringList>

/// The language of `dxl packet`. Pure; errors are InvalidArgument and quote what was given.
namespace dynascope::dxl {

/// What the first word may be: ping, read...
QStringList instructionNames();

/// "read 1 132 4", as words: a packet as it goes out.
Result<Bytes> composePacket(const QStringList &words);

/// "FF FF FD 00 01 03 00 01", with or without its CRC. A packet that contradicts itself is refused unless `raw`.
Result<Bytes> packetFromHex(const QString &text, bool raw);

} // namespace dynascope::dxl
