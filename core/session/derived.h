// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/historymark.h"
#include "core/session/watch.h"

#include <QString>

#include <deque>

namespace dynascope {

/// How a trace is made from samples of others.
struct Derivation {
    enum class Kind {
        None,       ///< as it is
        Difference, ///< less the last value of `other`
        Derivative, ///< per second, over `span` up to the sample; 0: from the sample before
        Average,    ///< mean of the samples in `span` up to the sample, it included
        Scaled,     ///< × factor + offset: needs no samples of its own
    };
    Kind kind = Kind::None;
    Watch other{};
    LineTime span{};
    double factor = 1; ///< of raw values, as `offset`
    double offset = 0;
    QString unit; ///< Scaled: the result's, which then follows no choice of units; empty: that of the source

    static constexpr LineTime LongestSpan = std::chrono::seconds(60);
    friend bool operator==(const Derivation &, const Derivation &) = default;
};

/// Which trace: a field, or what is derived from it.
struct TraceKey {
    Watch watch{};
    Derivation derivation{};

    TraceKey() = default;
    TraceKey(const Watch &of, Derivation how = {}) : watch(of), derivation(std::move(how)) { } // NOLINT: a field is one
    TraceKey(quint32 device, int field) : watch{device, field} { }
    bool isDerived() const { return derivation.kind != Derivation::Kind::None; }
    friend bool operator==(const TraceKey &, const TraceKey &) = default;
};

/// The samples of a derived trace, made as those of its sources come, a bounded number at a time. Their times are those
/// of the source. A gap of the source is one here, too, and nothing is derived across it. Any one thread.
class DerivedHistory
{
public:
    explicit DerivedHistory(const Derivation &derivation) : m_derivation(derivation) { }

    /// How raw values of `other` are counted in those of the source: × ratio + shift. Another one begins it anew.
    void setRelation(double ratio, double shift);

    /// Takes what has come since. Looks at no more source samples than `budget`, and takes from it what it used. The time
    /// of the first sample it made; nothing where there is none. `other` may be missing where it isn't needed.
    std::optional<LineTime> advance(const History *source, const History *other, std::size_t &budget);

    const History &history() const { return m_history; }
    /// Its raw values are so many times those of the source: fractions count. What is too large for that is a gap.
    int resolution() const;

private:
    void restart();
    std::optional<double> derive(const History::Sample &sample, const History *other);
    std::optional<double> difference(const History::Sample &sample, const History *other);
    std::optional<double> slope(const History::Sample &sample);
    double average(const History::Sample &sample);

    Derivation m_derivation;
    double m_ratio = 1;
    double m_shift = 0;
    History m_history;
    HistoryMark m_mark, m_otherMark;
    std::uint64_t m_next = 0;              ///< of the source's samples, counted from the first it ever had
    std::deque<History::Sample> m_window;  ///< of the source, since its last gap
    std::int64_t m_sum = 0;                ///< of the window
};

} // namespace dynascope
