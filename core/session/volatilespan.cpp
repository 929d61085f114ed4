// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/volatilespan.h"

#include <algorithm>
#include <array>

namespace dynascope {
namespace {

constexpr int Longest = 64; ///< bytes; a scan should not take longer for it

// Beyond what any servo does.
constexpr double TurnsPerSecond = 20;
constexpr double DegreesPerSecond = 10, DegreesOfNoise = 3;

/// The most telling first: what doesn't fit beside it is left out.
constexpr std::array<const char16_t *, 6> Telling{u"Realtime Tick",    u"Present Position",      u"Present Temperature",
                                                  u"Present Velocity", u"Present Input Voltage", u"Present Current"};

} // namespace

std::optional<VolatileSpan> volatileSpanOf(const ControlTable &table)
{
    int begin = 0, end = 0;
    for (const char16_t *name : Telling) {
        const Field *field = table.find(QStringView(name));
        if (!field)
            continue;
        const int from = end > 0 ? std::min<int>(begin, field->address) : field->address;
        const int to = std::max(end, field->end());
        if (to - from > Longest)
            continue;
        begin = from;
        end = to;
    }
    if (end == 0)
        return std::nullopt;
    const auto inside = [&](QStringView name) {
        const Field *field = table.find(name);
        return field && field->address >= begin && field->end() <= end ? field : nullptr;
    };
    VolatileSpan span;
    span.address = static_cast<std::uint16_t>(begin);
    span.length = static_cast<std::uint16_t>(end - begin);
    if (const Field *tick = inside(u"Realtime Tick"); tick && tick->size == 2)
        span.tickAt = tick->address - begin;
    if (const Field *position = inside(u"Present Position"); position && position->size == 4) {
        const double turn = table.resolution();
        span.steady.push_back({position->address - begin, position->size, turn / 8, turn * TurnsPerSecond});
    }
    if (const Field *temperature = inside(u"Present Temperature"))
        span.steady.push_back({temperature->address - begin, temperature->size, DegreesOfNoise, DegreesPerSecond});
    return span;
}

} // namespace dynascope
