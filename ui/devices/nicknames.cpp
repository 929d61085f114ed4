// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/devices/nicknames.h"

#include <QSettings>
#include <QUrl>

#include <algorithm>

namespace dynascope {

QString asNickname(const QString &text)
{
    return text.left(4 * MaximumNickname).simplified().left(MaximumNickname).trimmed();
}

Nicknames::Nicknames(const Workbench &workbench, QObject *parent)
    : QObject(parent)
    , m_workbench(workbench)
{
    connect(&workbench.session, &Session::lineAdded, this, &Nicknames::follow);
    connect(&workbench.session, &Session::lineAboutToBeRemoved, this,
            [this](const LineSession *line) { m_adapters.remove(line); });
    connect(&workbench.session, &Session::deviceAdded, this, &Nicknames::recall);
    connect(&workbench.session, &Session::deviceAboutToBeRemoved, this, [this](Device *device) {
        device->disconnect(this);
        m_keys.remove(device->key());
    });
    for (const auto &line : workbench.session.lines())
        follow(line.get());
    for (Device *device : workbench.session.devices())
        recall(device);
}

/// Opened again it may be on another adapter, or have another name. While it is lost, the one that was there counts.
void Nicknames::follow(const LineSession *line)
{
    connect(line, &LineSession::stateChanged, this, [this, line] {
        if (line->state() == BusThread::State::Open)
            m_adapters.remove(line);
    });
}

/// The adapter itself where it can be told from others: /dev/ttyUSB0 may be another one tomorrow. And the baud rate:
/// what is new always has ID 1.
QString Nicknames::keyOf(const Device &device)
{
    const QString port = device.line()->name();
    if (!m_adapters.contains(device.line())) {
        const std::vector<PortInfo> ports = m_workbench.ports.ports();
        const auto at = std::ranges::find(ports, port, &PortInfo::name);
        m_adapters.insert(device.line(), at == ports.end() || at->identity.isEmpty() ? port : at->identity);
    }
    return QStringLiteral("nicknames/%1/%2 %3 %4")
        .arg(QString::fromLatin1(QUrl::toPercentEncoding(m_adapters.value(device.line()))))
        .arg(device.modelNumber())
        .arg(device.baudRate())
        .arg(device.id());
}

void Nicknames::recall(Device *device)
{
    if (!device->line())
        return;
    const QString key = keyOf(*device);
    m_keys.insert(device->key(), key);
    if (device->nickname().isEmpty())
        device->setNickname(asNickname(QSettings().value(key).toString()));
    connect(device, &Device::attributesChanged, this, [this, device] { keep(*device); });
}

void Nicknames::keep(const Device &device)
{
    QSettings settings;
    const QString key = keyOf(device);
    QString &last = m_keys[device.key()];
    if (last != key)
        settings.remove(last);
    last = key;
    if (device.nickname().isEmpty())
        settings.remove(key);
    else if (settings.value(key).toString() != device.nickname())
        settings.setValue(key, device.nickname());
}

} // namespace dynascope
