// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/line.h"

#include <algorithm>
#include <array>

namespace dynascope {

/// What the answers so far teach about when the next one will come: how much later than the device's registers say its
/// first byte comes, on account of adapter, host and device. Estimated as round trips of TCP are (RFC 6298): mean and
/// mean deviation. The latest of the last hundreds counts, too: hosts stall now and then. Bounded: what is learned can't make a wait endless, nor shorter than the wire's own time.
class LearnedTiming
{
public:
    /// Later than this nothing is waited for, whatever was seen.
    static constexpr LineTime Longest = std::chrono::milliseconds(100);

    /// An answer of `id` began `lateness` after it could have at the earliest by its Return Delay Time. An outlier counts
    /// as a step only: the next one alike another.
    void learn(std::uint8_t id, LineTime lateness);
    /// No answer of `id` came. Missed often in a row, a device gets the line's own time again: perhaps the adapter has
    /// become slow. But not where others have answered since: then the adapter is as it was, and the device is missing.
    void missed(std::uint8_t id)
    {
        if (m_misses[id]++ == 0)
            m_answersBefore[id] = m_answers;
    }

    /// How much later than its registers say an answer of `id` is to be waited for. `allowance` is what the line itself
    /// asks for, and what holds until enough has been seen.
    LineTime allowance(std::uint8_t id, LineTime allowance) const;

private:
    struct Estimate {
        LineTime mean{}, deviation{};
        int samples = 0;
        LineTime peak{}; ///< the latest of the last hundreds; fades
        LineTime longest() const { return std::max(mean + 4 * deviation, peak); }
        void add(LineTime sample);
    };
    static constexpr std::size_t Ids = 256;

    Estimate m_line;
    std::array<Estimate, Ids> m_devices{};
    std::array<int, Ids> m_misses{}; ///< in a row
    quint64 m_answers = 0;           ///< of anybody
    std::array<quint64, Ids> m_answersBefore{}; ///< when the first of the misses came
};

} // namespace dynascope
