// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/spanmeasure.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dynascope {

double Measured::rms(double scale, double offset) const
{
    const double square = scale * scale * meanSquare + 2 * scale * offset * mean + offset * offset;
    return std::sqrt(std::max(square, 0.0));
}

void SpanMeasure::Crossings::take(const History::Sample &before, const History::Sample &now, bool gapBefore)
{
    if (gapBefore) { // nobody knows how many there were in between
        isBelow = false;
        first.reset();
    } else if (before.raw < mean && now.raw >= mean) {
        const double part = (mean - before.raw) / (static_cast<double>(now.raw) - before.raw);
        rose = before.at + LineTime(std::llround(part * static_cast<double>((now.at - before.at).count())));
    }
    if (now.raw < mean - band) {
        isBelow = true;
    } else if (isBelow && now.raw > mean + band) {
        isBelow = false;
        if (first) {
            ++periods;
            seconds += std::chrono::duration<double>(rose - last).count();
        } else {
            first = rose;
        }
        last = rose;
    }
}

std::optional<double> SpanMeasure::Crossings::hertz() const
{
    if (periods == 0 || !(seconds > 0))
        return std::nullopt;
    return static_cast<double>(periods) / seconds;
}

void SpanMeasure::add(const History &history, Position first, Position begin, Position end, int sign)
{
    for (Position i = begin; i < end; ++i) {
        const std::int64_t raw = history.at(static_cast<std::size_t>(i - first)).raw;
        const auto square = static_cast<std::uint64_t>(raw * raw);
        if (sign > 0) {
            m_sum += raw;
            m_squaresHigh += square >> 32U;
            m_squaresLow += square & 0xFFFFFFFFU;
        } else {
            m_sum -= raw;
            m_squaresHigh -= square >> 32U;
            m_squaresLow -= square & 0xFFFFFFFFU;
        }
    }
}

/// Brings the sums closer to `wanted`. True: they are of it now.
bool SpanMeasure::sum(const History &history, Position first, const Stretch &wanted, std::size_t &budget)
{
    const Position overlap = std::min(m_summed.end, wanted.end) - std::min(std::max(m_summed.begin, wanted.begin),
                                                                           std::min(m_summed.end, wanted.end));
    const Position moved = m_summed.size() + wanted.size() - 2 * overlap;
    // Anew where that is less work, or what has to be taken off is no longer there.
    if (overlap == 0 || moved > wanted.size() || (m_summed.begin < first && m_summed.begin < wanted.begin)) {
        m_summed = {wanted.begin, wanted.begin};
        m_sum = 0;
        m_squaresHigh = 0;
        m_squaresLow = 0;
    }
    const auto step = [&](Position from, Position to) {
        const auto count = std::min<Position>(to - from, budget);
        budget -= static_cast<std::size_t>(count);
        return count;
    };
    if (m_summed.end < wanted.end) {
        const Position count = step(m_summed.end, wanted.end);
        add(history, first, m_summed.end, m_summed.end + count, 1);
        m_summed.end += count;
    } else if (m_summed.end > wanted.end) {
        const Position count = step(wanted.end, m_summed.end);
        add(history, first, m_summed.end - count, m_summed.end, -1);
        m_summed.end -= count;
    }
    if (m_summed.begin < wanted.begin) {
        const Position count = step(m_summed.begin, wanted.begin);
        add(history, first, m_summed.begin, m_summed.begin + count, -1);
        m_summed.begin += count;
    } else if (m_summed.begin > wanted.begin) {
        const Position count = step(wanted.begin, m_summed.begin);
        add(history, first, m_summed.begin - count, m_summed.begin, 1);
        m_summed.begin -= count;
    }
    return m_summed == wanted;
}

/// A count once begun is brought to its end, though the stretch may have moved: else it would never end while live.
bool SpanMeasure::count(const History &history, Position first, std::size_t &budget)
{
    Crossings &crossings = m_crossings;
    if (crossings.next < first) { // gone meanwhile
        crossings.next = std::min(first, crossings.of.end);
        crossings.isBelow = false;
        crossings.first.reset();
    }
    const Position end = std::min<Position>(crossings.of.end, crossings.next + budget);
    budget -= static_cast<std::size_t>(end - crossings.next);
    for (; crossings.next < end; ++crossings.next) {
        const auto index = static_cast<std::size_t>(crossings.next - first);
        const bool isFirst = crossings.next == crossings.of.begin || index == 0;
        const History::Sample now = history.at(index);
        crossings.take(isFirst ? now : history.at(index - 1), now, isFirst || history.gapBefore(index));
    }
    return crossings.next == crossings.of.end;
}

void SpanMeasure::advance(const History &history, LineTime from, LineTime to, std::size_t &budget)
{
    if (&history != m_history || !m_mark.stillHolds(history))
        *this = SpanMeasure();
    m_history = &history;
    m_mark = HistoryMark::of(history);
    const Position first = history.appended() - history.size();
    const Position begin = first + history.indexAt(from);
    const Stretch wanted{begin, std::max(begin, first + history.indexAt(to))};
    m_isDone = sum(history, first, wanted, budget);
    if (!m_isDone)
        return;
    History::Column all;
    history.columns(from, to, {&all, 1});
    const auto samples = static_cast<double>(wanted.size());
    const std::optional<double> hertz = wanted.size() < 3 ? std::nullopt : m_result.hertz;
    m_result = {wanted.size(), all.minimum, all.maximum, 0, 0, hertz};
    if (wanted.size() == 0)
        return;
    m_result.mean = static_cast<double>(m_sum) / samples;
    m_result.meanSquare
        = (static_cast<double>(m_squaresHigh) * 4294967296.0 + static_cast<double>(m_squaresLow)) / samples;
    if (!m_isCounting && m_counted != wanted) {
        m_crossings = {};
        m_crossings.of = wanted;
        m_crossings.next = wanted.begin;
        m_crossings.mean = m_result.mean;
        m_crossings.band = (static_cast<double>(all.maximum) - all.minimum) / 8;
        m_isCounting = true;
    }
    if (m_isCounting && count(history, first, budget)) {
        m_isCounting = false;
        m_counted = m_crossings.of;
        m_result.hertz = m_crossings.hertz();
    }
    m_isDone = m_counted == wanted;
}

Measured measure(const History &history, LineTime from, LineTime to)
{
    SpanMeasure measure;
    std::size_t budget = std::numeric_limits<std::size_t>::max() / 4;
    measure.advance(history, from, to, budget);
    return measure.result();
}

} // namespace dynascope
