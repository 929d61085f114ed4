// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/volatilespan.h"

#include <algorithm>
#include <array>

namespace dynascope {
namespace {

constexpr int Longest = 64; ///< bytes; a scan should not take longer for it

/// Position in turns, temperature in degrees Celsius.
struct Steadiness {
    double turns, turnsPerSecond, degrees, degreesPerSecond;
};
constexpr Steadiness AnyServo{1 / 8.0, 20, 3, 10}; ///< beyond what any does
/// Torque off: a hand may turn it, and the supply falls when others are plugged in.
constexpr Steadiness Resting{1 / 64.0, 1, 2, 2};
constexpr double RestingVolts = 1, RestingVoltsPerSecond = 20; ///< mere calibration makes two differ by less

/// The most telling first: what doesn't fit beside it is left out.
constexpr std::array<const char16_t *, 6> Telling{u"Realtime Tick",    u"Present Position",      u"Present Temperature",
                                                  u"Present Velocity", u"Present Input Voltage", u"Present Current"};

/// Of which registers a VolatileSpan is made, and where it begins.
struct Stretch {
    const ControlTable &table;
    int begin = 0, end = 0;

    const Field *find(QStringView name) const
    {
        const Field *field = table.find(name);
        return field && field->address >= begin && field->end() <= end ? field : nullptr;
    }
    VolatileSpan::Steady steady(const Field &field, double slack, double perSecond) const
    {
        return {field.address - begin, field.size, slack, perSecond};
    }
    VolatileSpan span(const Steadiness &within) const
    {
        VolatileSpan span;
        span.address = static_cast<std::uint16_t>(begin);
        span.length = static_cast<std::uint16_t>(end - begin);
        if (const Field *tick = find(u"Realtime Tick"); tick && tick->size == 2)
            span.tickAt = tick->address - begin;
        if (const Field *position = find(u"Present Position"); position && position->size == 4) {
            const double turn = table.resolution();
            span.steady.push_back(steady(*position, turn * within.turns, turn * within.turnsPerSecond));
        }
        if (const Field *temperature = find(u"Present Temperature"))
            span.steady.push_back(steady(*temperature, within.degrees, within.degreesPerSecond));
        return span;
    }
};

std::optional<Stretch> stretchOf(const ControlTable &table)
{
    Stretch stretch{table};
    for (const char16_t *name : Telling) {
        const Field *field = table.find(QStringView(name));
        if (!field)
            continue;
        const int from = stretch.end > 0 ? std::min<int>(stretch.begin, field->address) : field->address;
        const int to = std::max(stretch.end, field->end());
        if (to - from > Longest)
            continue;
        stretch.begin = from;
        stretch.end = to;
    }
    return stretch.end > 0 ? std::optional<Stretch>(stretch) : std::nullopt;
}

} // namespace

std::optional<VolatileSpan> volatileSpanOf(const ControlTable &table)
{
    const auto stretch = stretchOf(table);
    return stretch ? std::optional(stretch->span(AnyServo)) : std::nullopt;
}

std::optional<VolatileSpan> restingSpanOf(const ControlTable &table)
{
    const auto stretch = stretchOf(table);
    if (!stretch)
        return std::nullopt;
    VolatileSpan span = stretch->span(Resting);
    if (const Field *voltage = stretch->find(u"Present Input Voltage"); voltage && voltage->scale > 0) {
        const double volt = 1 / voltage->scale;
        span.steady.push_back(stretch->steady(*voltage, RestingVolts * volt, RestingVoltsPerSecond * volt));
    }
    return span;
}

} // namespace dynascope
