// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bytes.h"
#include "core/table/field.h"

#include <functional>

namespace dynascope {

/// Reads another register's present value; nothing where it isn't known.
using RegisterLookup = std::function<std::optional<std::int64_t>(QStringView name)>;

/// What a field means right now: its range with registers resolved, its unit with alternates applied.
struct EffectiveField {
    std::optional<std::int64_t> minimum, maximum; ///< nothing: unlimited but for the size, or not read yet
    QString minimumFrom, maximumFrom; ///< the registers that these follow; empty where they are fixed
    Unit unit = Unit::None;
    double scale = 1.0;
    int directionBit = -1;     ///< Field::directionBit
    double turns = 1.0;        ///< resolution × this is a turn: the gear ratio's denominator / numerator
    double torqueConstant = 0; ///< Field::torqueConstant

    friend bool operator==(const EffectiveField &, const EffectiveField &) = default;
};
EffectiveField effective(const Field &field, const RegisterLookup &lookup);

/// What fits the register's size and sign at all.
std::int64_t smallestRaw(const Field &field);
std::int64_t largestRaw(const Field &field);

std::int64_t rawFromBytes(const Field &field, ByteView bytes);
Bytes bytesFromRaw(const Field &field, std::int64_t raw);

} // namespace dynascope
