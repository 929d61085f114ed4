// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/table/field.h"

namespace dynascope {

/// What a register of one name may have otherwise in another table.
enum class FieldAspect { Address, Size, Area, Access, Initial, Range, Unit, Values, Bits, Alternates, Resets };

/// In what they differ, in the order above; sentences (help, doubt) count for nothing.
std::vector<FieldAspect> changedAspects(const Field &one, const Field &other);

} // namespace dynascope
