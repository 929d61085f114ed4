// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/table/comparison.h"

#include "core/session/journal/journalwrites.h"
#include "core/table/indirect.h"
#include "core/table/units.h"

#include <QCoreApplication>

#include <algorithm>

namespace dynascope {
namespace {

struct ComparisonText {
    Q_DECLARE_TR_FUNCTIONS(Comparison)
};

bool sameNames(const std::vector<EnumValue> &one, const std::vector<EnumValue> &other)
{
    return std::ranges::equal(
        one, other, [](const EnumValue &a, const EnumValue &b) { return a.value == b.value && a.text == b.text; });
}

bool sameBits(const std::vector<BitField> &one, const std::vector<BitField> &other)
{
    return std::ranges::equal(one, other, [](const BitField &a, const BitField &b) {
        return a.first == b.first && a.count == b.count && a.name == b.name && sameNames(a.values, b.values);
    });
}

bool sameUnit(const EffectiveField &one, const EffectiveField &other)
{
    return one.unit == other.unit && one.scale == other.scale && one.directionBit == other.directionBit
           && one.turns == other.turns;
}

bool isAngle(const EffectiveField &effective)
{
    return effective.unit == Unit::Pulse || effective.unit == Unit::PulsePerSec || effective.unit == Unit::PulsePerMs;
}

Error elsewhere(const Field &field)
{
    return {ErrorKind::NotSupported, ComparisonText::tr("%1 means something else there").arg(field.name)};
}

} // namespace

bool isSharedSetting(const Field &field)
{
    return field.isWritable() && !isGoal(field) && indirectDataNumber(field) == 0 && field.name != u"ID"
           && field.name != u"Homing Offset" && field.name != u"Torque Enable" && field.name != u"LED";
}

bool meanTheSame(const ComparedCell &one, const ComparedCell &other)
{
    if (one.field == other.field && one.effective == other.effective)
        return true;
    return sameNames(one.field->values, other.field->values) && sameBits(one.field->bits, other.field->bits)
           && sameUnit(one.effective, other.effective)
           && (!isAngle(one.effective) || one.resolution == other.resolution);
}

bool holdDifferent(const ComparedCell &one, const ComparedCell &other)
{
    return one.raw && other.raw && (*one.raw != *other.raw || !meanTheSame(one, other));
}

Result<std::int64_t> carriedOver(const ComparedCell &from, std::int64_t raw, const ComparedCell &to)
{
    std::int64_t there = raw;
    if (!meanTheSame(from, to)) {
        const QString name = from.field->values.empty() ? QString() : meaning(*from.field, raw);
        const auto named = std::ranges::find(to.field->values, name, &EnumValue::text);
        if (!name.isEmpty() && named != to.field->values.end())
            there = named->value;
        else if (!from.field->values.empty() || !to.field->values.empty() || !sameBits(from.field->bits, to.field->bits)
                 || from.effective.unit != to.effective.unit)
            return tl::unexpected(elsewhere(*to.field));
        else
            there = rawFromPhysical(to.effective, to.resolution, physical(from.effective, from.resolution, raw).value);
    }
    const Result<void> allowed = checkRange(*to.field, to.effective, there, to.resolution);
    return allowed ? Result<std::int64_t>(there) : tl::unexpected(allowed.error());
}

} // namespace dynascope
