// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/health/wantedrates.h"

#include "core/session/monitor.h"

#include <QSettings>
#include <QUrl>

namespace dynascope {
namespace {

constexpr double Slowest = 0.01, Fastest = 1000; ///< Hz; a settings file may say anything

} // namespace

WantedRates::WantedRates(Session &session, Monitor &monitor, QObject *parent)
    : QObject(parent)
    , m_session(session)
    , m_monitor(monitor)
{
    connect(&monitor, &Monitor::watchesChanged, this, &WantedRates::look);
    look();
}

void WantedRates::look()
{
    const std::set<Watch> watches = m_monitor.watches();
    std::erase_if(m_seen, [&watches](const auto &seen) { return !watches.contains(seen.first); });
    for (const Watch &watch : watches) {
        const double now = m_monitor.rate(watch);
        const auto [seen, isNew] = m_seen.try_emplace(watch, now);
        const QString key = isNew || seen->second != now ? keyOf(watch) : QString();
        if (key.isEmpty())
            continue;
        if (!isNew) {
            seen->second = now;
            now > 0 ? QSettings().setValue(key, now) : QSettings().remove(key);
            continue;
        }
        const double wanted = QSettings().value(key).toDouble();
        if (now <= 0 && wanted >= Slowest && wanted < Fastest) {
            seen->second = wanted;
            m_monitor.setRate(watch, wanted); // which calls this once more
        }
    }
}

QString WantedRates::keyOf(const Watch &watch) const
{
    const Device *device = m_session.device(watch.device);
    if (!device || !device->line())
        return {};
    const auto part = [](const QString &text) { return QString::fromLatin1(QUrl::toPercentEncoding(text)); };
    const QString &field = device->table().fields()[static_cast<std::size_t>(watch.field)].name;
    return QStringLiteral("rates/%1/%2-%3/%4")
        .arg(part(device->line()->name()))
        .arg(device->modelNumber())
        .arg(device->id())
        .arg(part(field));
}

} // namespace dynascope
