// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/table/fieldchanges.h"

#include <algorithm>

namespace dynascope {
namespace {

bool same(const std::vector<EnumValue> &one, const std::vector<EnumValue> &other)
{
    return std::equal(one.begin(), one.end(), other.begin(), other.end(),
                      [](const EnumValue &a, const EnumValue &b) { return a.value == b.value && a.text == b.text; });
}

bool same(const std::vector<BitField> &one, const std::vector<BitField> &other)
{
    return std::equal(one.begin(), one.end(), other.begin(), other.end(), [](const BitField &a, const BitField &b) {
        return a.first == b.first && a.count == b.count && a.name == b.name && same(a.values, b.values);
    });
}

bool same(const std::vector<Alternate> &one, const std::vector<Alternate> &other)
{
    return std::equal(one.begin(), one.end(), other.begin(), other.end(), [](const Alternate &a, const Alternate &b) {
        return a.reg == b.reg && a.mask == b.mask && a.values == b.values && a.minimum == b.minimum
               && a.maximum == b.maximum && a.unit == b.unit && a.scale == b.scale && a.directionBit == b.directionBit;
    });
}

bool sameUnit(const Field &one, const Field &other)
{
    return one.unit == other.unit && one.scale == other.scale && one.directionBit == other.directionBit
           && one.torqueConstant == other.torqueConstant && one.gearRatio.numerator == other.gearRatio.numerator
           && one.gearRatio.denominator == other.gearRatio.denominator
           && one.gearRatio.initialTurns == other.gearRatio.initialTurns;
}

} // namespace

std::vector<FieldAspect> changedAspects(const Field &one, const Field &other)
{
    std::vector<FieldAspect> changed;
    const auto note = [&changed](FieldAspect aspect, bool isSame) {
        if (!isSame)
            changed.push_back(aspect);
    };
    note(FieldAspect::Address, one.address == other.address);
    note(FieldAspect::Size, one.size == other.size && one.isSigned == other.isSigned);
    note(FieldAspect::Area, one.area == other.area);
    note(FieldAspect::Access, one.access == other.access);
    note(FieldAspect::Initial, one.initial == other.initial);
    note(FieldAspect::Range, one.minimum == other.minimum && one.maximum == other.maximum);
    note(FieldAspect::Unit, sameUnit(one, other));
    note(FieldAspect::Values, same(one.values, other.values) && same(one.special, other.special));
    note(FieldAspect::Bits, same(one.bits, other.bits));
    note(FieldAspect::Alternates, same(one.alternates, other.alternates));
    note(FieldAspect::Resets, one.resets == other.resets);
    return changed;
}

} // namespace dynascope
