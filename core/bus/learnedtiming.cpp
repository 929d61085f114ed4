// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/learnedtiming.h"

#include <algorithm>

namespace dynascope {

using namespace std::chrono_literals;

namespace {

constexpr int EnoughOfDevice = 8;
constexpr int EnoughOfLine = 16;
constexpr quint64 EnoughOfOthers = 8;
constexpr int OftenMissed = 3;
constexpr int Fading = 256;
constexpr LineTime Step = 10ms; ///< by which one answer can be later than all before it
/// What the scheduling of a desktop adds now and then, reference "Time": 2 ms, and more where the line itself asks for
/// much. A line without any delay of its own has none.
LineTime jitter(LineTime allowance)
{
    return std::min(allowance, std::max<LineTime>(2ms, allowance / 8));
}

} // namespace

void LearnedTiming::Estimate::add(LineTime sample)
{
    if (samples == 0) {
        mean = sample;
        deviation = std::chrono::abs(sample) / 2;
    } else {
        deviation += (std::chrono::abs(sample - mean) - deviation) / 4;
        mean += (sample - mean) / 8;
    }
    peak = std::max(sample, peak - peak / Fading);
    ++samples;
}

void LearnedTiming::learn(std::uint8_t id, LineTime lateness)
{
    m_misses[id] = 0;
    ++m_answers;
    const auto within = [lateness](const Estimate &estimate) {
        const LineTime longest = estimate.samples > 0 ? std::min(estimate.longest() + Step, Longest) : Longest;
        return std::clamp(lateness, -Longest, longest);
    };
    m_line.add(within(m_line));
    m_devices[id].add(within(m_devices[id]));
}

LineTime LearnedTiming::allowance(std::uint8_t id, LineTime allowance) const
{
    const Estimate &device = m_devices[id];
    const bool knowsDevice = device.samples >= EnoughOfDevice;
    const bool isMissed = m_misses[id] >= OftenMissed;
    const bool othersAnswer = isMissed && m_answers - m_answersBefore[id] >= EnoughOfOthers;
    if (!knowsDevice && !othersAnswer && m_line.samples < EnoughOfLine)
        return allowance;
    LineTime longest = knowsDevice ? device.longest() : m_line.longest();
    if (othersAnswer) // as slow as the adapter may have become meanwhile
        longest = std::max(longest, m_line.longest());
    const LineTime margin = jitter(allowance);
    const LineTime learned = std::clamp(longest + margin, margin, std::max(allowance, Longest));
    return isMissed && !othersAnswer ? std::max(learned, allowance) : learned;
}

} // namespace dynascope
