// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/seriallinefactory.h"
#include "core/bus/usbidentity.h"

#include <QDir>
#include <QSerialPortInfo>

#include <algorithm>

namespace dynascope {
namespace {

using namespace std::chrono_literals;

/// After a change the system goes on describing what is new: names and rights come a little later.
constexpr auto Settling = 3s;

bool isUsb(const QString &name)
{
    return name.contains(QLatin1String("USB")) || name.contains(QLatin1String("ACM"));
}

/// What the list follows from, at a fiftieth of its cost. Empty where the system has no such folder.
QStringList traces()
{
    QStringList all = QDir(QStringLiteral("/sys/class/tty")).entryList(QDir::Dirs | QDir::NoDotAndDotDot);
    for (QString &name : all) {
        if (isUsb(name))
            name += usbIdentity(name).plug;
    }
    return all;
}

std::vector<PortInfo> lookUp()
{
    std::vector<PortInfo> ports;
    const QList<QSerialPortInfo> infos = QSerialPortInfo::availablePorts();
    for (const QSerialPortInfo &info : infos) {
        QString text = info.description();
        if (!info.manufacturer().isEmpty() && !text.contains(info.manufacturer()))
            text = text.isEmpty() ? info.manufacturer() : QStringLiteral("%1 (%2)").arg(text, info.manufacturer());
        ports.push_back({info.systemLocation(), text, info.serialNumber(), usbIdentity(info.portName()).identity});
    }
    std::ranges::stable_sort(ports, [](const PortInfo &a, const PortInfo &b) {
        return isUsb(a.name) != isUsb(b.name) ? isUsb(a.name) : a.name < b.name;
    });
    return ports;
}

} // namespace

std::vector<PortInfo> SerialPortList::ports() const
{
    const auto now = std::chrono::steady_clock::now();
    QStringList present = traces();
    if (present != m_traces || present.isEmpty()) {
        m_traces = std::move(present);
        m_settledAt = now + Settling;
    }
    if (now < m_settledAt || !m_isSettled) {
        m_isSettled = now >= m_settledAt;
        m_ports = lookUp();
    }
    return m_ports;
}

} // namespace dynascope
