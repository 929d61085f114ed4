// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/pacing.h"

#include <algorithm>
#include <vector>

namespace dynascope::sim {
namespace {

constexpr LineTime Step = std::chrono::nanoseconds(100); ///< of the errors kept
constexpr std::int64_t Fewest = 3;       ///< late replies before anything is said
constexpr std::int64_t BehindFrom = 20;  ///< one reply in so many late: behind
constexpr std::int64_t AgainBelow = 100; ///< not even one in so many: keeps up again

double milliseconds(LineTime time)
{
    return std::chrono::duration<double, std::milli>(time).count();
}

} // namespace

void Pacing::handedOn(LineTime due, LineTime at)
{
    begin(at);
    const LineTime error = std::clamp(at - due, LineTime{}, LineTime(std::chrono::seconds(100)));
    m_errors[static_cast<std::size_t>(m_replies) % m_errors.size()] = static_cast<std::int32_t>(error / Step);
    ++m_replies;
    count(error);
}

void Pacing::heardLate(LineTime by, LineTime at)
{
    begin(at);
    count(by);
}

void Pacing::begin(LineTime at)
{
    if (m_inPeriod > 0 && at - m_begin >= Period)
        judge();
    if (m_inPeriod == 0)
        m_begin = at;
}

void Pacing::count(LineTime error)
{
    ++m_inPeriod;
    m_worst = std::max(m_worst, error);
    if (error > Late) {
        ++m_late;
        ++m_lateInPeriod;
    }
}

void Pacing::judge()
{
    if (m_keepsUp && m_lateInPeriod >= Fewest && m_lateInPeriod * BehindFrom >= m_inPeriod) {
        m_keepsUp = false;
        m_news = QStringLiteral("This machine does not keep up with the wire: %1 of %2 requests and replies were more "
                                "than %3 ms late, the latest by %4 ms. What a program sees now is no servo's timing")
                     .arg(m_lateInPeriod)
                     .arg(m_inPeriod)
                     .arg(milliseconds(Late))
                     .arg(milliseconds(m_worst), 0, 'f', 1);
    } else if (!m_keepsUp && m_lateInPeriod * AgainBelow < m_inPeriod) {
        m_keepsUp = true;
        m_news = QStringLiteral("The machine keeps up with the wire again");
    }
    m_inPeriod = m_lateInPeriod = 0;
    m_worst = {};
}

std::optional<QString> Pacing::news(LineTime now)
{
    if (m_inPeriod > 0 && now - m_begin >= Period)
        judge();
    return std::exchange(m_news, std::nullopt);
}

Pacing::Report Pacing::report() const
{
    Report report{m_replies, m_late, {}, {}, {}, m_keepsUp};
    const auto known = std::min(static_cast<std::size_t>(m_replies), m_errors.size());
    if (known == 0)
        return report;
    std::vector<std::int32_t> errors(m_errors.begin(), m_errors.begin() + static_cast<std::ptrdiff_t>(known));
    std::ranges::sort(errors);
    report.median = errors[known / 2] * Step;
    report.percentile99 = errors[std::min(known - 1, known * 99 / 100)] * Step;
    report.worst = errors.back() * Step;
    return report;
}

} // namespace dynascope::sim
