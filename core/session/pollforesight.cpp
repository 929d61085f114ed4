// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/pollforesight.h"

#include "core/bus/cyclelimit.h"

#include <QPromise>
#include <QThreadPool>

#include <memory>

namespace dynascope {

PollForesight::PollForesight(QObject *parent)
    : QObject(parent)
{
    connect(&m_work, &QFutureWatcherBase::finished, this, &PollForesight::take);
}

/// Planning takes its time, 50 ms for thirty servos: only where something is other than it was, and elsewhere.
void PollForesight::look(PolledLine line)
{
    if (m_work.isRunning())
        return;
    const bool isKnown = line.isLike(m_line) && m_seen.prediction.shares.sum() > 0;
    if (isKnown && (!m_limitsWanted || !m_seen.limits.empty()))
        return;
    m_line = line;
    m_isDropped = false;
    const auto promise = std::make_shared<QPromise<Seen>>();
    promise->start();
    m_work.setFuture(promise->future());
    QThreadPool::globalInstance()->start([promise, line = std::move(line), withLimits = m_limitsWanted] {
        Seen seen;
        seen.prediction = predictPoll(line.plan, line.baudRate, line.delays, line.silent);
        seen.possibleRate = possibleCycleRate(line.plan, line.baudRate);
        if (withLimits)
            seen.limits = limitsOf(line);
        promise->addResult(std::move(seen));
        promise->finish();
    });
}

void PollForesight::lookForLimits(PolledLine line)
{
    m_limitsWanted = true;
    if (m_seen.limits.empty())
        look(std::move(line));
}

void PollForesight::clear()
{
    m_seen = {};
    m_isDropped = true;
}

void PollForesight::take()
{
    if (m_isDropped)
        return;
    m_seen = m_work.result();
    m_limitsWanted = false; // whoever still looks asks again
    emit changed();
}

} // namespace dynascope
