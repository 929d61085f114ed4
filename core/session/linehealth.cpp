// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/linehealth.h"

#include <algorithm>
#include <chrono>

namespace dynascope {
namespace {

/// Counts of an ID; none where it was never asked.
DeviceQuality of(const LineQuality &quality, std::uint8_t id)
{
    const DeviceQuality *device = quality.device(id);
    return device ? *device : DeviceQuality{};
}

} // namespace

double LineHealth::seconds() const
{
    return std::chrono::duration<double>(m_latest.at - m_origin.at).count();
}

double LineHealth::rate(quint64 now, quint64 before) const
{
    const double seconds = std::chrono::duration<double>(m_latest.at - m_previous.at).count();
    const bool counted = m_previous.at > LineTime() && seconds > 0 && now >= before;
    return counted ? static_cast<double>(now - before) / seconds : 0.0;
}

double LineHealth::bytesPerSecond(std::uint8_t id) const
{
    return rate(of(m_latest, id).bytes, of(m_previous, id).bytes);
}

double LineHealth::bytesPerSecond() const
{
    return rate(m_latest.sum().bytes, m_previous.sum().bytes);
}

double LineHealth::answersPerSecond(std::chrono::milliseconds interval) const
{
    if (m_polled.size() < 2)
        return 0;
    const auto count = [interval](const Polled &polled) {
        const auto at = std::ranges::find(polled.report.taken, interval, &PollReport::Taken::interval);
        return at == polled.report.taken.end() ? quint64(0) : at->answers;
    };
    const double seconds = std::chrono::duration<double>(m_polled.back().at - m_polled.front().at).count();
    return seconds > 0 ? static_cast<double>(count(m_polled.back()) - count(m_polled.front())) / seconds : 0.0;
}

/// Long enough that what comes once a second is counted right.
void LineHealth::keep(const LineQuality &quality)
{
    using Taken = PollReport::Taken;
    constexpr LineTime Kept = std::chrono::seconds(4);
    const auto goesOn = [](const Taken &before, const Taken &now) {
        return before.interval == now.interval && before.answers <= now.answers;
    };
    if (!m_polled.empty() && !std::ranges::equal(m_polled.back().report.taken, quality.polled.taken, goesOn))
        m_polled.clear(); // another plan
    m_polled.push_back({quality.at, quality.polled});
    while (m_polled.size() > 2 && m_polled.front().at < quality.at - Kept)
        m_polled.pop_front();
}

void LineHealth::startAnew()
{
    m_origin = m_latest;
    show();
}

void LineHealth::startAnew(std::uint8_t id)
{
    const DeviceQuality *present = m_latest.device(id);
    if (!present)
        return;
    const auto origin = std::ranges::find(m_origin.devices, id, &DeviceQuality::id);
    if (origin == m_origin.devices.end())
        m_origin.devices.push_back(*present);
    else
        *origin = *present;
    show();
}

void LineHealth::begin()
{
    m_latest = m_previous = m_origin = {};
    m_polled.clear();
    show();
}

void LineHealth::take(LineQuality quality)
{
    m_previous = std::move(m_latest);
    m_latest = std::move(quality);
    keep(m_latest);
    if (m_origin.at == LineTime())
        m_origin.at = m_latest.at;
    show();
}

void LineHealth::show()
{
    m_shown = m_latest.since(m_origin);
    emit changed();
}

} // namespace dynascope
