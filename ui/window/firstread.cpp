// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/window/firstread.h"

#include "core/session/commands.h"

namespace dynascope {

FirstRead::FirstRead(const Workbench &workbench, QObject *parent)
    : QObject(parent)
    , m_workbench(workbench)
{
    connect(&workbench.session, &Session::lineAdded, this, &FirstRead::follow);
    connect(&workbench.session, &Session::deviceAboutToBeRemoved, this, [this](Device *device) {
        m_shown.erase(device->key());
        m_asked.erase(device->key());
    });
    for (const auto &line : workbench.session.lines())
        follow(line.get());
}

void FirstRead::follow(LineSession *line)
{
    connect(line, &LineSession::deviceChanged, this, &FirstRead::onDevice);
    connect(line, &LineSession::stateChanged, this, [this, line] { onLine(line); });
}

void FirstRead::show(const std::vector<Device *> &devices)
{
    m_shown.clear();
    for (const Device *device : devices)
        m_shown.insert(device->key());
    for (Device *device : devices)
        read(*device);
}

void FirstRead::onDevice(Device *device)
{
    if (device->state() == Device::State::Silent)
        m_asked.erase(device->key());
    else if (device->state() == Device::State::Present && m_shown.contains(device->key()))
        read(*device);
}

void FirstRead::onLine(LineSession *line)
{
    for (const auto &device : line->devices()) {
        if (line->state() != BusThread::State::Open)
            m_asked.erase(device->key());
        else if (m_shown.contains(device->key()))
            read(*device);
    }
}

void FirstRead::read(Device &device)
{
    if (device.line()->state() != BusThread::State::Open
        || device.state() == Device::State::Silent || !m_asked.insert(device.key()).second)
        return;
    m_workbench.commands.readAll(
        device, [here = QPointer<FirstRead>(this), key = device.key()](const Result<void> &result) {
            if (here && !result)
                here->m_asked.erase(key); // the next look at it asks again
        });
}

} // namespace dynascope
