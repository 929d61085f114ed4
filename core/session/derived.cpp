// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/derived.h"

#include <cmath>
#include <limits>

namespace dynascope {

namespace {

constexpr int Fine = 16;
constexpr std::size_t MostInWindow = 200'000;

} // namespace

int DerivedHistory::resolution() const
{
    const bool isWhole = m_derivation.kind == Derivation::Kind::Difference && m_ratio == 1
        && m_shift == std::round(m_shift);
    return isWhole ? 1 : Fine;
}

void DerivedHistory::setRelation(double ratio, double shift)
{
    if (ratio == m_ratio && shift == m_shift)
        return;
    m_ratio = ratio;
    m_shift = shift;
    restart();
}

void DerivedHistory::restart()
{
    m_history = History();
    m_mark = {};
    m_otherMark = {};
    m_next = 0;
    m_window.clear();
    m_sum = 0;
}

std::optional<LineTime> DerivedHistory::advance(const History *source, const History *other, std::size_t &budget)
{
    if (!source || source->isEmpty()) {
        if (!m_history.isEmpty())
            restart(); // cleared
        return std::nullopt;
    }
    if (m_next > 0 && !m_mark.stillHolds(*source))
        restart();
    if (other && m_otherMark.appended > 0 && !m_otherMark.stillHolds(*other))
        restart();
    m_mark = HistoryMark::of(*source);
    m_otherMark = other ? HistoryMark::of(*other) : HistoryMark{};
    const std::uint64_t first = source->appended() - source->size();
    m_next = std::max(m_next, first);
    std::optional<LineTime> made;
    for (; m_next < source->appended() && budget > 0; ++m_next, --budget) {
        const auto index = static_cast<std::size_t>(m_next - first);
        const History::Sample sample = source->at(index);
        if (source->gapBefore(index)) {
            m_window.clear();
            m_sum = 0;
            m_history.appendGap(sample.at);
        }
        const std::optional<double> value = derive(sample, other);
        const double raw = value.value_or(0) * resolution();
        if (!value || !(std::abs(raw) <= std::numeric_limits<std::int32_t>::max())) {
            m_history.appendGap(sample.at);
            continue;
        }
        m_history.append(sample.at, static_cast<std::int32_t>(std::lround(raw)));
        made = made ? made : sample.at;
    }
    return made;
}

std::optional<double> DerivedHistory::derive(const History::Sample &sample, const History *other)
{
    switch (m_derivation.kind) {
    case Derivation::Kind::Difference: return difference(sample, other);
    case Derivation::Kind::Derivative: return slope(sample);
    case Derivation::Kind::Average: return average(sample);
    case Derivation::Kind::None:
    case Derivation::Kind::Scaled: break;
    }
    return sample.raw;
}

/// The other one's value that held then. Unknown where it had none yet, or was not known up to its next.
std::optional<double> DerivedHistory::difference(const History::Sample &sample, const History *other)
{
    if (!other)
        return std::nullopt;
    const std::size_t after = other->indexAt(sample.at + LineTime(1));
    if (after == 0 || (after < other->size() && other->gapBefore(after)))
        return std::nullopt;
    return sample.raw - (other->at(after - 1).raw * m_ratio + m_shift);
}

/// From the newest sample that is at least `span` old.
std::optional<double> DerivedHistory::slope(const History::Sample &sample)
{
    const LineTime least = std::max(m_derivation.span, LineTime(1));
    while (m_window.size() > 1 && (sample.at - m_window[1].at >= least || m_window.size() >= MostInWindow))
        m_window.pop_front();
    std::optional<double> value;
    if (!m_window.empty() && sample.at - m_window.front().at >= least) {
        const double seconds = std::chrono::duration<double>(sample.at - m_window.front().at).count();
        value = (static_cast<double>(sample.raw) - m_window.front().raw) / seconds;
    }
    m_window.push_back(sample);
    return value;
}

double DerivedHistory::average(const History::Sample &sample)
{
    m_window.push_back(sample);
    m_sum += sample.raw;
    while (m_window.size() > 1
        && (sample.at - m_window.front().at > m_derivation.span || m_window.size() > MostInWindow)) {
        m_sum -= m_window.front().raw;
        m_window.pop_front();
    }
    return static_cast<double>(m_sum) / static_cast<double>(m_window.size());
}

} // namespace dynascope
