// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/historymark.h"

#include <optional>

namespace dynascope {

/// What a stretch of a history is like, in raw values: the samples count alike, however far apart they are.
struct Measured {
    std::uint64_t samples = 0; ///< 0: nothing else here means anything
    std::int32_t minimum = 0, maximum = 0;
    double mean = 0;
    double meanSquare = 0;
    /// By the rising crossings of the mean, each counted once the signal went an eighth of its peak-to-peak beyond the
    /// mean on both sides: whole periods by the time that they took. None where there isn't one whole period.
    std::optional<double> hertz;

    /// Of scale · raw + offset.
    double rms(double scale, double offset) const;

    friend bool operator==(const Measured &, const Measured &) = default;
};

/// Measures [from, to) of a history with bounded work a call, and goes on from what it has: where an end moves, the
/// samples it passed are added or taken off (exactly: in whole numbers). The frequency needs all of them and comes
/// later; until then the former one stands. Any one thread.
class SpanMeasure
{
public:
    /// Looks at no more than `budget` samples, and takes from it what it used. The history may grow and lose its oldest
    /// in between; another one is begun anew.
    void advance(const History &history, LineTime from, LineTime to, std::size_t &budget);

    /// Of what was asked for last, or, while that isn't done, before it.
    const Measured &result() const { return m_result; }
    bool isDone() const { return m_isDone; }

private:
    using Position = std::uint64_t; ///< counts all samples a history ever had
    struct Stretch {
        Position begin = 0, end = 0;
        Position size() const { return end - begin; }
        friend bool operator==(const Stretch &, const Stretch &) = default;
    };
    /// Counts the periods from sample to sample.
    struct Crossings {
        Stretch of;
        Position next = 0;
        double mean = 0, band = 0;
        bool isBelow = false;   ///< it was below the band since it was above
        LineTime rose{};        ///< where it crossed the mean last
        std::optional<LineTime> first; ///< rising crossing since the last gap
        LineTime last{};
        std::uint64_t periods = 0;
        double seconds = 0;

        void take(const History::Sample &before, const History::Sample &now, bool gapBefore);
        std::optional<double> hertz() const;
    };

    void add(const History &history, Position first, Position begin, Position end, int sign);
    bool sum(const History &history, Position first, const Stretch &wanted, std::size_t &budget);
    bool count(const History &history, Position first, std::size_t &budget);

    const History *m_history = nullptr;
    HistoryMark m_mark; ///< of the last call
    Stretch m_summed;
    std::int64_t m_sum = 0;
    std::uint64_t m_squaresHigh = 0, m_squaresLow = 0; ///< 32 bits of each square, so that neither overflows
    Crossings m_crossings;
    bool m_isCounting = false;
    bool m_isDone = false;
    Measured m_result;
    Stretch m_counted; ///< to which result().hertz belongs
};

/// All at once.
Measured measure(const History &history, LineTime from, LineTime to);

} // namespace dynascope
