// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/restartsigns.h"

#include <algorithm>
#include <utility>

namespace dynascope {
namespace {

constexpr std::int64_t Jitter = 100; ///< ms: an answer may have waited for a busy host or adapter
constexpr std::int64_t Drift = 50;   ///< one part in as many: its clock needs no quartz

std::int64_t inPeriod(std::int64_t milliseconds)
{
    const std::int64_t rest = milliseconds % TickSign::Period;
    return rest < 0 ? rest + TickSign::Period : rest;
}

} // namespace

TickSign::Verdict TickSign::take(LineTime at, std::int64_t tick)
{
    if (m_last && at < m_last->at)
        return Verdict::Runs; // older news: it was on its way longer
    const Look now{at, inPeriod(tick)};
    const std::optional<Look> last = std::exchange(m_last, now);
    if (!last)
        return Verdict::Runs;
    const std::int64_t elapsed = std::chrono::duration_cast<std::chrono::milliseconds>(at - last->at).count();
    const std::int64_t tolerance = Jitter + elapsed / Drift;
    if (2 * tolerance >= Period)
        return Verdict::Unclear;
    const std::int64_t ahead = inPeriod(now.tick - last->tick - elapsed);
    const bool fits = std::min(ahead, Period - ahead) <= tolerance;
    // A restart just when it would have begun anew looks the same; after a whole period there was such a moment for sure.
    const bool wentRound = elapsed + tolerance >= Period || now.tick < last->tick;
    if (fits)
        return wentRound && elapsed > 0 ? Verdict::Unclear : Verdict::Runs;
    // Since a restart no more can have passed than since the last look.
    return elapsed + tolerance >= Period || now.tick <= elapsed + tolerance ? Verdict::Restarted : Verdict::Unclear;
}

const Field *tickField(const ControlTable &table)
{
    const Field *tick = table.find(u"Realtime Tick");
    return tick && tick->size == 2 && tick->unit == Unit::Millisecond && tick->scale == 1 ? tick : nullptr;
}

bool looksRestarted(std::optional<bool> torqueOn, std::span<const SetReading> readings)
{
    const auto isKept = [](const SetReading &reading) { return reading.now == reading.set; };
    const auto isInitial = [](const SetReading &reading) { return reading.initial && reading.now == *reading.initial; };
    return !torqueOn.value_or(false) && std::ranges::none_of(readings, isKept)
        && std::ranges::any_of(readings, isInitial);
}

} // namespace dynascope
