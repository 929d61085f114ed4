// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/outbox.h"

#include <utility>

namespace dynascope {

void Outbox::deliver(RecipientPtr recipient, Delivery delivery)
{
    const std::lock_guard lock(m_mutex);
    m_deliveries.emplace_back(std::move(recipient), std::move(delivery));
    notify();
}

void Outbox::addBatch(Batch batch)
{
    const std::lock_guard lock(m_mutex);
    m_batches.push_back(std::move(batch));
    if (m_batches.size() > MaximumBatches)
        m_batches.pop_front();
    if (m_batchNoticePending)
        return;
    m_batchNoticePending = m_tellBatches = true;
    notify();
}

void Outbox::setStatistics(const BusStatistics &statistics, bool tell)
{
    const std::lock_guard lock(m_mutex);
    m_statistics = statistics;
    if (!tell)
        return;
    m_tellStatistics = true;
    notify();
}

std::vector<Batch> Outbox::takeBatches()
{
    const std::lock_guard lock(m_mutex);
    std::vector<Batch> batches(std::make_move_iterator(m_batches.begin()), std::make_move_iterator(m_batches.end()));
    m_batches.clear();
    m_batchNoticePending = false;
    return batches;
}

BusStatistics Outbox::statistics() const
{
    const std::lock_guard lock(m_mutex);
    return m_statistics;
}

void Outbox::setQuality(LineQuality quality)
{
    const std::lock_guard lock(m_mutex);
    std::swap(m_quality, quality);
    m_tellQuality = true;
    notify();
}

LineQuality Outbox::quality() const
{
    const std::lock_guard lock(m_mutex);
    return m_quality;
}

void Outbox::notify()
{
    if (std::exchange(m_noticePending, true))
        return;
    QMetaObject::invokeMethod(this, &Outbox::drain, Qt::QueuedConnection);
}

void Outbox::drain()
{
    decltype(m_deliveries) deliveries;
    bool tellBatches = false;
    bool tellStatistics = false;
    bool tellQuality = false;
    {
        const std::lock_guard lock(m_mutex);
        m_noticePending = false;
        deliveries.swap(m_deliveries);
        tellBatches = std::exchange(m_tellBatches, false);
        tellStatistics = std::exchange(m_tellStatistics, false);
        tellQuality = std::exchange(m_tellQuality, false);
    }
    const QPointer<Outbox> self(this);
    for (const auto &[recipient, delivery] : deliveries) {
        if (!recipient || recipient->isThere())
            delivery();
        if (!self)
            return;
    }
    if (tellBatches)
        emit batchesReady();
    if (self && tellStatistics)
        emit statisticsChanged();
    if (self && tellQuality)
        emit qualityChanged();
}

} // namespace dynascope
