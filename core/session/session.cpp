// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/session.h"

#include <algorithm>
#include <chrono>

namespace dynascope {

Session::Session(LineFactory &factory, const Catalog &catalog, QObject *parent)
    : QObject(parent)
    , m_factory(factory)
    , m_catalog(catalog)
{
}

Session::Clock Session::machineClock()
{
    return {[] { return LineTime(std::chrono::steady_clock::now().time_since_epoch()); },
            [] { return QDateTime::currentDateTime(); }};
}

Session::~Session()
{
    while (!m_lines.empty())
        close(*m_lines.back());
}

LineSession &Session::open(const QString &name, int baudRate)
{
    const auto present = std::ranges::find_if(m_lines, [&name](const auto &line) { return line->name() == name; });
    if (present != m_lines.end())
        close(**present);
    m_factory.prepare(name);
    m_lines.push_back(std::make_unique<LineSession>(m_factory, name, baudRate, m_catalog, m_keys));
    LineSession *line = m_lines.back().get();
    connect(line, &LineSession::deviceAdded, this, &Session::deviceAdded);
    connect(line, &LineSession::deviceAboutToBeRemoved, this, &Session::deviceAboutToBeRemoved);
    emit lineAdded(line);
    return *line;
}

void Session::close(LineSession &line)
{
    const auto isIt = [&line](const auto &other) { return other.get() == &line; };
    if (std::ranges::none_of(m_lines, isIt))
        return;
    line.close(); // what its bus thread still delivers finds a whole line, and may close it, too
    if (std::ranges::none_of(m_lines, isIt))
        return;
    while (!line.devices().empty())
        line.forget(line.devices().back()->key());
    emit lineAboutToBeRemoved(&line);
    const auto at = std::ranges::find_if(m_lines, isIt);
    const std::unique_ptr<LineSession> dying = std::move(*at); // out of the list first
    m_lines.erase(at);
}

Device *Session::device(DeviceKey key) const
{
    for (const auto &line : m_lines) {
        if (Device *device = line->device(key))
            return device;
    }
    return nullptr;
}

std::vector<Device *> Session::devices() const
{
    std::vector<Device *> devices;
    for (const auto &line : m_lines) {
        for (const auto &device : line->devices())
            devices.push_back(device.get());
    }
    return devices;
}

} // namespace dynascope
