// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/modelwalk.h"

#include "core/bus/operations.h"

#include <algorithm>
#include <set>
#include <tuple>

namespace dynascope::test {
namespace {

constexpr int LongestRead = 200; ///< bytes at once

bool isSpecial(const Field &field)
{
    static const std::set<QString> names{QStringLiteral("ID"),
                                         QStringLiteral("Baud Rate"),
                                         QStringLiteral("Protocol Type"),
                                         QStringLiteral("Return Delay Time"),
                                         QStringLiteral("Status Return Level"),
                                         QStringLiteral("Torque Enable"),
                                         QStringLiteral("Operating Mode"),
                                         QStringLiteral("Control Mode"),
                                         QStringLiteral("Bus Watchdog"),
                                         QStringLiteral("Hybrid Save"),
                                         QStringLiteral("Secondary ID"),
                                         QStringLiteral("Startup Configuration")};
    return names.count(field.name) > 0 || field.name.startsWith(u"Indirect ");
}

/// Registers next to each other, as (address, length).
std::vector<std::pair<int, int>> spansOf(const ControlTable &table)
{
    std::vector<std::pair<int, int>> spans;
    for (const Field &field : table.fields()) {
        const bool follows = !spans.empty() && spans.back().first + spans.back().second == field.address;
        if (follows && spans.back().second + field.size <= LongestRead)
            spans.back().second += field.size;
        else
            spans.emplace_back(field.address, field.size);
    }
    return spans;
}

ByteView bytesOf(const Field &field, const Bytes &image)
{
    return ByteView(image).subspan(field.address, field.size);
}

/// Those two are where the test has put the device.
bool isPlace(const Field &field)
{
    return field.name == u"Baud Rate" || field.name == u"ID";
}

tl::unexpected<Error> wrong(const Field &field, std::int64_t is, std::int64_t should)
{
    return failure(ErrorKind::NotConfirmed,
                   QStringLiteral("%1 is %2 instead of %3").arg(field.name).arg(is).arg(should));
}

Result<void> checkFactory(const Field &field, ByteView bytes)
{
    if (field.area != Area::Eeprom || !field.initial || isPlace(field))
        return {};
    const std::int64_t raw = rawFromBytes(field, bytes);
    return raw == *field.initial ? Result<void>() : wrong(field, raw, *field.initial);
}

} // namespace

Result<Bytes> readWhole(Bus &bus, std::uint8_t id, const ControlTable &table)
{
    Bytes image(static_cast<std::size_t>(table.size()));
    for (const auto &span : spansOf(table)) {
        const int address = span.first, length = span.second;
        const auto reply = read(bus, {id, static_cast<std::uint16_t>(address), static_cast<std::uint16_t>(length)});
        if (!reply)
            return tl::unexpected(reply.error());
        if (reply->data.size() != static_cast<std::size_t>(length)) {
            return failure(ErrorKind::NotConfirmed,
                           QStringLiteral("%1 of %2 bytes from %3").arg(reply->data.size()).arg(length).arg(address));
        }
        std::copy(reply->data.begin(), reply->data.end(), image.begin() + address);
    }
    for (const Field &field : table.fields()) {
        if (const auto sound = checkFactory(field, bytesOf(field, image)); !sound)
            return tl::unexpected(sound.error());
    }
    return image;
}

std::vector<const Field *> oneOfEachKind(const ControlTable &table)
{
    std::set<std::tuple<Area, int, bool, bool, bool>> kinds;
    std::vector<const Field *> fields;
    for (const Field &field : table.fields()) {
        const auto kind =
            std::tuple(field.area, int(field.size), field.isSigned, field.values.empty(), field.bits.empty());
        if (field.isWritable() && !isSpecial(field) && kinds.insert(kind).second)
            fields.push_back(&field);
    }
    return fields;
}

Result<void> writeAndReadBack(Bus &bus, std::uint8_t id, const ControlTable &table, const Field &field, Bytes &image)
{
    const EffectiveField now = effective(field, [&](QStringView name) -> std::optional<std::int64_t> {
        const Field *other = table.find(name);
        return other ? std::optional(rawFromBytes(*other, bytesOf(*other, image))) : std::nullopt;
    });
    const std::int64_t before = rawFromBytes(field, bytesOf(field, image));
    const std::int64_t low = now.minimum.value_or(smallestRaw(field)), high = now.maximum.value_or(largestRaw(field));
    std::int64_t wanted = before < high ? before + 1 : before - 1;
    for (const EnumValue &value : field.values) {
        if (value.value != before)
            wanted = value.value;
    }
    wanted = std::clamp(wanted, low, high);
    if (wanted == before) {
        return failure(ErrorKind::NotConfirmed,
                       QStringLiteral("%1 can have no other value than %2").arg(field.name).arg(wanted));
    }
    const auto back = writeVerified(bus, {id, field.address, bytesFromRaw(field, wanted)});
    if (!back)
        return tl::unexpected(back.error());
    std::copy(back->begin(), back->end(), image.begin() + field.address);
    const std::int64_t raw = rawFromBytes(field, *back);
    return raw == wanted ? Result<void>() : wrong(field, raw, wanted);
}

} // namespace dynascope::test
