// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/learnedtiming.h"

#include <algorithm>

namespace dynascope {

using namespace std::chrono_literals;

namespace {

constexpr int EnoughOfDevice = 8;
constexpr int EnoughOfLine = 32;
/// What the scheduling of a desktop adds now and then, reference "Time". A line without any delay of its own has none.
constexpr LineTime Jitter = 2ms;

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
    ++samples;
}

void LearnedTiming::learn(std::uint8_t id, LineTime lateness)
{
    const LineTime sample = std::clamp(lateness, -Longest, Longest);
    m_line.add(sample);
    m_devices[id].add(sample);
}

LineTime LearnedTiming::allowance(std::uint8_t id, LineTime allowance) const
{
    const Estimate &device = m_devices[id];
    const bool knowsDevice = device.samples >= EnoughOfDevice;
    if (!knowsDevice && m_line.samples < EnoughOfLine)
        return allowance;
    const Estimate &known = knowsDevice ? device : m_line;
    const LineTime margin = std::min(allowance, Jitter);
    return std::clamp(known.mean + 4 * known.deviation + margin, margin, std::max(allowance, Longest));
}

} // namespace dynascope
