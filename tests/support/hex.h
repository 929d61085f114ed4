// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bytes.h"

#include <QString>

/// Bytes as text and back, so that a test's table and its failure read like the wire.
namespace hex {

dynascope::Bytes bytes(const char *text); ///< "FF FF FD 00"; anything between pairs of digits is skipped
QString text(dynascope::ByteView bytes);

} // namespace hex
