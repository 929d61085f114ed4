// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/record/recordedvalue.h"

#include "core/table/units.h"

#include <algorithm>
#include <cmath>

namespace dynascope {
namespace {

constexpr int MostDecimals = 12;

bool isBareNumber(const EffectiveField &units)
{
    return units.unit == Unit::None && units.scale == 1.0;
}

std::int64_t smallest(const RecordedField &field)
{
    return field.isSigned ? -(std::int64_t(1) << (8 * field.size - 1)) : 0;
}

std::int64_t largest(const RecordedField &field)
{
    return (std::int64_t(1) << (8 * field.size - (field.isSigned ? 1 : 0))) - 1;
}

} // namespace

RecordedField recordedField(const Field &field, const EffectiveField &effective, int resolution)
{
    RecordedField result;
    result.name = field.name;
    result.address = field.address;
    result.size = field.size;
    result.isSigned = field.isSigned;
    result.directionBit = effective.directionBit;
    if (isBareNumber(effective))
        return result;
    const Physical one = physical(effective, resolution, 1);
    if (!std::isfinite(one.value) || one.value == 0)
        return result;
    result.unit = unitId(effective.unit);
    result.scale = one.value;
    result.decimals = std::clamp(one.decimals, 0, MostDecimals);
    return result;
}

std::optional<std::int64_t> recordedRaw(const RecordedField &field, int address, ByteView registers)
{
    const int offset = field.address - address;
    if (offset < 0 || offset + field.size > static_cast<int>(registers.size()))
        return std::nullopt;
    const std::uint32_t bits = littleEndian(registers.subspan(static_cast<std::size_t>(offset)), field.size);
    const std::int64_t top = std::int64_t(1) << (8 * field.size - 1);
    return field.isSigned && (bits & top) != 0 ? std::int64_t(bits) - 2 * top : std::int64_t(bits);
}

void putRaw(const RecordedField &field, int address, std::int64_t raw, std::span<std::uint8_t> registers)
{
    const int offset = field.address - address;
    if (offset < 0 || offset + field.size > static_cast<int>(registers.size()))
        return;
    const auto first = static_cast<std::size_t>(offset);
    for (std::size_t i = 0; i < static_cast<std::size_t>(field.size); ++i)
        registers[first + i] = static_cast<std::uint8_t>(raw >> (8 * i));
}

double physicalValue(const RecordedField &field, std::int64_t raw)
{
    if (field.directionBit < 0)
        return static_cast<double>(raw) * field.scale;
    const std::int64_t mask = std::int64_t(1) << field.directionBit;
    const double magnitude = static_cast<double>(raw & ~mask) * field.scale;
    return (raw & mask) != 0 ? -magnitude : magnitude;
}

std::int64_t rawValue(const RecordedField &field, double physical)
{
    if (!std::isfinite(physical))
        return 0;
    constexpr double Beyond = 1e10; // more than any register, and still an integer
    const auto counted = static_cast<std::int64_t>(std::llround(std::clamp(physical / field.scale, -Beyond, Beyond)));
    if (field.directionBit < 0)
        return std::clamp(counted, smallest(field), largest(field));
    // The bits above the direction's stand beside the number: physicalValue() leaves them in it.
    const std::int64_t mask = std::int64_t(1) << field.directionBit;
    const bool negative = std::signbit(physical / field.scale);
    const std::int64_t magnitude = std::min(std::abs(counted), largest(field)) & ~mask;
    return negative ? magnitude | mask : magnitude;
}

QByteArray physicalText(const RecordedField &field, std::int64_t raw)
{
    return QByteArray::number(physicalValue(field, raw), 'f', field.decimals);
}

QString columnTitle(const RecordedDevice &device, const RecordedField &field)
{
    const QString title = device.label + u'/' + field.name;
    return field.unit.isEmpty() ? title : title + QStringLiteral(" [%1]").arg(field.unit);
}

QString toLine(const RecordedField &field)
{
    QString name = field.name;
    name.replace(u'\t', u' ').replace(u'\n', u' ');
    return QStringList{name,
                       QString::number(field.address),
                       QString::number(field.size),
                       QString::number(int(field.isSigned)),
                       QString::number(field.directionBit),
                       field.unit,
                       QString::number(field.scale, 'g', 17),
                       QString::number(field.decimals)}
        .join(u'\t');
}

std::optional<RecordedField> fieldFromLine(QStringView line)
{
    const auto parts = line.split(u'\t');
    if (parts.size() != 8)
        return std::nullopt;
    bool ok = true;
    const auto number = [&](qsizetype part, int from, int to) {
        bool isNumber = false;
        const int value = parts[part].toInt(&isNumber);
        ok = ok && isNumber && value >= from && value <= to;
        return value;
    };
    RecordedField field;
    field.name = parts[0].toString();
    field.address = static_cast<std::uint16_t>(number(1, 0, 0xFFFF));
    field.size = static_cast<std::uint8_t>(number(2, 1, 4));
    field.isSigned = number(3, 0, 1) == 1;
    field.directionBit = number(4, -1, 31);
    field.unit = parts[5].toString();
    bool isNumber = false;
    field.scale = parts[6].toDouble(&isNumber);
    field.decimals = number(7, 0, MostDecimals);
    const bool isScale = isNumber && std::isfinite(field.scale) && std::abs(field.scale) >= 1e-12
        && std::abs(field.scale) <= 1e12;
    const bool isUsable = ok && isScale && field.size != 3 && field.directionBit < 8 * field.size
        && field.end() <= 0x10000;
    return isUsable ? std::optional(field) : std::nullopt;
}

} // namespace dynascope
