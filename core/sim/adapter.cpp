// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/adapter.h"

#include "core/sim/damage.h"

#include <algorithm>

namespace dynascope::sim {

void Adapter::setFaults(const LineFaults &faults, LineTime now)
{
    m_faults = faults;
    m_chance = Chance(~faults.seed);
    m_sent = m_answered = 0;
    m_unplugAt.reset();
    m_nextNoise.reset();
    if (faults.noisePerSecond > 0)
        m_nextNoise = now + noiseGap();
    if (m_unplugged) // what came meanwhile
        unplug();
    m_unplugged = false;
    if (faults.unplugged)
        unplug();
}

void Adapter::send(Transmission &packet)
{
    const int before = m_sent;
    m_sent += static_cast<int>(packet.bytes.size());
    if (m_unplugged) {
        packet.bytes.clear();
    } else if (m_faults.unplugAtSent && *m_faults.unplugAtSent < m_sent) {
        packet.bytes.resize(static_cast<std::size_t>(std::max(0, *m_faults.unplugAtSent - before)));
        m_unplugAt = std::min(packet.end(), m_unplugAt.value_or(packet.end()));
    }
    if (!m_faults.echo.on)
        return;
    packet.lateness = m_faults.echo.delay;
    if (m_faults.echo.damage && !packet.bytes.empty()) {
        packet.atAdapter = packet.bytes;
        damagePacket(packet.atAdapter, PacketForm::Instruction, *m_faults.echo.damage, m_chance);
    }
}

void Adapter::take(const std::vector<HeardByte> &bytes)
{
    for (const HeardByte &byte : bytes) {
        if (!m_held.empty() && byte.at > m_held.front().at + m_faults.latencyTimer)
            release(m_held.front().at + m_faults.latencyTimer);
        m_held.push_back(byte);
        if (m_faults.latencyTimer <= LineTime{} || static_cast<int>(m_held.size()) >= m_faults.latencyBuffer)
            release(byte.at);
    }
}

void Adapter::release(LineTime at)
{
    for (const HeardByte &byte : m_held) {
        m_last = std::max(m_last, at + byte.lateness);
        m_ready.push_back({m_last, byte.byte, byte.answer});
    }
    m_held.clear();
}

void Adapter::deliver(Bytes &to, LineTime now)
{
    if (m_unplugAt && *m_unplugAt <= now)
        unplug();
    if (m_unplugged) {
        m_held.clear();
        m_ready.clear();
        return;
    }
    if (!m_held.empty() && m_held.front().at + m_faults.latencyTimer <= now)
        release(m_held.front().at + m_faults.latencyTimer);
    if (!m_ready.empty() && m_ready.front().at <= now)
        m_delivered.first = m_ready.front().at;
    while (!m_ready.empty() && m_ready.front().at <= now) {
        const Ready byte = m_ready.front();
        if (byte.answer && m_faults.unplugAtAnswered && m_answered++ == *m_faults.unplugAtAnswered)
            return unplug();
        m_delivered.second = byte.at;
        m_ready.pop_front();
        to.push_back(byte.byte);
    }
}

void Adapter::unplug()
{
    m_unplugged = true;
    m_unplugAt.reset();
    m_held.clear();
    m_ready.clear();
}

std::optional<LineTime> Adapter::next() const
{
    std::optional<LineTime> next = m_unplugAt;
    const auto consider = [&next](LineTime at) { next = next ? std::min(*next, at) : at; };
    if (!m_ready.empty())
        consider(m_ready.front().at);
    if (!m_held.empty())
        consider(std::max(m_last, m_held.front().at + m_faults.latencyTimer));
    return next;
}

std::optional<LineTime> Adapter::quiet() const
{
    if (!m_held.empty())
        return std::max(m_last, m_held.front().at + m_faults.latencyTimer);
    return m_ready.empty() ? std::nullopt : std::optional(m_last);
}

void Adapter::makeNoise(std::optional<LineTime> busyUntil)
{
    if (busyUntil) {
        m_nextNoise = *busyUntil;
        return;
    }
    take({{*m_nextNoise, {}, m_chance.byte(), false}});
    *m_nextNoise += noiseGap();
}

/// Anything between nothing and twice the average.
LineTime Adapter::noiseGap()
{
    const double seconds = 2 * m_chance.fraction() / m_faults.noisePerSecond;
    return LineTime(1) + std::chrono::duration_cast<LineTime>(std::chrono::duration<double>(seconds));
}

} // namespace dynascope::sim
