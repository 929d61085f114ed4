// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/table/effectivefield.h"

#include <algorithm>

namespace dynascope {

namespace {

std::optional<std::int64_t> resolved(const Bound &bound, const RegisterLookup &lookup)
{
    if (bound.number)
        return bound.number;
    if (bound.reg.isEmpty() || !lookup)
        return std::nullopt;
    const std::optional<std::int64_t> value = lookup(bound.reg);
    if (!value)
        return std::nullopt;
    return bound.negated ? -*value : *value;
}

bool holds(const Alternate &alternate, const RegisterLookup &lookup)
{
    if (!lookup)
        return false;
    const std::optional<std::int64_t> value = lookup(alternate.reg);
    if (!value)
        return false;
    const std::int64_t masked = *value & static_cast<std::int64_t>(alternate.mask);
    return std::find(alternate.values.begin(), alternate.values.end(), masked) != alternate.values.end();
}

/// Denominator / numerator; the factory's where they aren't known or make no sense.
double turnsOf(const GearRatio &ratio, const RegisterLookup &lookup)
{
    if (!ratio.isSet() || !lookup)
        return ratio.initialTurns;
    const std::optional<std::int64_t> numerator = lookup(ratio.numerator);
    const std::optional<std::int64_t> denominator = lookup(ratio.denominator);
    if (!numerator || !denominator || *numerator <= 0 || *denominator <= 0)
        return ratio.initialTurns;
    return static_cast<double>(*denominator) / static_cast<double>(*numerator);
}

} // namespace

EffectiveField effective(const Field &field, const RegisterLookup &lookup)
{
    const Bound *minimum = &field.minimum;
    const Bound *maximum = &field.maximum;
    EffectiveField result;
    result.unit = field.unit;
    result.scale = field.scale;
    result.directionBit = field.directionBit;
    result.torqueConstant = field.torqueConstant;
    result.turns = turnsOf(field.gearRatio, lookup);
    for (const Alternate &alternate : field.alternates) {
        if (!holds(alternate, lookup))
            continue;
        if (alternate.minimum.isSet())
            minimum = &alternate.minimum;
        if (alternate.maximum.isSet())
            maximum = &alternate.maximum;
        result.unit = alternate.unit;
        result.scale = alternate.scale;
        result.directionBit = alternate.directionBit;
        break;
    }
    result.minimumFrom = minimum->reg;
    result.maximumFrom = maximum->reg;
    result.minimum = resolved(*minimum, lookup);
    result.maximum = resolved(*maximum, lookup);
    return result;
}

std::int64_t smallestRaw(const Field &field)
{
    return field.isSigned ? -(std::int64_t(1) << (8 * field.size - 1)) : 0;
}

std::int64_t largestRaw(const Field &field)
{
    return (std::int64_t(1) << (8 * field.size - (field.isSigned ? 1 : 0))) - 1;
}

std::int64_t rawFromBytes(const Field &field, ByteView bytes)
{
    const int size = std::min(static_cast<int>(field.size), static_cast<int>(bytes.size()));
    const std::int64_t value = littleEndian(bytes, size);
    return field.isSigned && value > largestRaw(field) ? value + 2 * smallestRaw(field) : value;
}

Bytes bytesFromRaw(const Field &field, std::int64_t raw)
{
    Bytes bytes;
    appendLittleEndian(bytes, static_cast<std::uint32_t>(raw), field.size);
    return bytes;
}

} // namespace dynascope
