// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/line.h"

#include <QString>

#include <array>
#include <optional>

namespace dynascope::sim {

/// How far behind the byte-time model a served bus hands its replies on, and whether that is still a wire's pace. Kept by
/// the server, on its thread.
class Pacing
{
public:
    static constexpr LineTime Late = std::chrono::milliseconds(1); ///< more than this and a client sees another wire

    /// A reply was handed on at `at`, its last byte being due at `due`.
    void handedOn(LineTime due, LineTime at);
    /// A request was taken up at `at`, after the server had been kept from running for `by` longer than it meant to sleep:
    /// the wire had it up to so much earlier. What is answered to it may be on time and yet too late, or collide with what
    /// an impatient program sent meanwhile.
    void heardLate(LineTime by, LineTime at);

    struct Report {
        std::int64_t replies = 0, late = 0;      ///< since the start; late: by more than Late, requests included
        LineTime median{}, percentile99{}, worst{}; ///< of the latest replies, some thousands at most
        bool keepsUp = true;
    };
    Report report() const;

    /// A sentence when it has fallen behind or keeps up again: once each. Judged over a second and more: one hiccup of the
    /// machine is only counted.
    std::optional<QString> news(LineTime now);

private:
    void begin(LineTime at);
    void count(LineTime error);
    void judge();

    static constexpr LineTime Period = std::chrono::seconds(1);
    std::array<std::int32_t, 4096> m_errors{}; ///< 0.1 µs, of the latest replies, in a ring
    std::int64_t m_replies = 0, m_late = 0;
    LineTime m_begin{}, m_worst{};              ///< of the period being judged
    std::int64_t m_inPeriod = 0, m_lateInPeriod = 0;
    bool m_keepsUp = true;
    std::optional<QString> m_news;
};

} // namespace dynascope::sim
