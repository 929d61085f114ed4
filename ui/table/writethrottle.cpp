// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/table/writethrottle.h"

namespace dynascope {

WriteThrottle::WriteThrottle(std::function<void(std::int64_t)> send, QObject *parent)
    : QObject(parent)
    , m_send(std::move(send))
{
    m_timer.setSingleShot(true);
    m_timer.setTimerType(Qt::PreciseTimer);
    m_timer.setInterval(IntervalMs);
    connect(&m_timer, &QTimer::timeout, this, &WriteThrottle::next);
}

void WriteThrottle::submit(std::int64_t raw)
{
    m_waiting = raw;
    if (!m_timer.isActive())
        next();
}

void WriteThrottle::next()
{
    if (!m_waiting)
        return;
    const std::int64_t raw = *m_waiting;
    m_waiting.reset();
    m_timer.start();
    m_send(raw);
}

} // namespace dynascope
