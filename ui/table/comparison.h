// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/result.h"
#include "core/table/controltable.h"

namespace dynascope {

/// What a register of one device holds, and what its numbers mean there now.
struct ComparedCell {
    const Field *field = nullptr;
    EffectiveField effective;
    int resolution = 4096; ///< pulses per revolution
    std::optional<std::int64_t> raw;
};

/// A setting that servos with the same task share: not what is measured, where a motor shall go, who it is, or what is
/// adjusted for each unit (Homing Offset).
bool isSharedSetting(const Field &field);

/// Do numbers in these two registers mean the same?
bool meanTheSame(const ComparedCell &one, const ComparedCell &other);

/// Both are known and differ, as numbers or in what these mean.
bool holdDifferent(const ComparedCell &one, const ComparedCell &other);

/// The raw value that means in `to` what `raw` means in `from`, allowed there: by its name or, with another scale, the
/// nearest. Refused where nothing in `to` means that.
Result<std::int64_t> carriedOver(const ComparedCell &from, std::int64_t raw, const ComparedCell &to);

} // namespace dynascope
