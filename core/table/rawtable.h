// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/table/controltable.h"

namespace dynascope {

/// How many bytes of an unknown device are offered. Every table known begins within these.
constexpr int RawTableSize = 1024;

/// The table of a model that nobody has described: every byte a field "Byte 0", "Byte 1"... that may be read, and
/// written by a person who means to. Where `lower` and `upper`, tables of models numbered beside it, agree on a register, its
/// first byte says so, as a suggestion. The program itself means no register of it.
ControlTablePtr rawTable(int modelNumber, const QString &name, const ControlTablePtr &lower = nullptr,
                         const ControlTablePtr &upper = nullptr);

} // namespace dynascope
