// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/jobqueue.h"
#include "core/bus/quality_values.h"

namespace dynascope {

/// What the bus thread has for the GUI thread. Lives there and runs the deliveries; filled from any thread. At most one
/// notice is on its way, however much comes.
class Outbox : public QObject
{
    Q_OBJECT

public:
    static constexpr std::size_t MaximumBatches = 2000; ///< the oldest go first

    using Delivery = std::function<void()>;
    using RecipientPtr = std::shared_ptr<const Recipient>;

    void deliver(RecipientPtr recipient, Delivery delivery);
    void deliverAlways(Delivery delivery) { deliver(nullptr, std::move(delivery)); }

    void addBatch(Batch batch);
    void setStatistics(const BusStatistics &statistics, bool tell);
    std::vector<Batch> takeBatches();
    BusStatistics statistics() const;
    void setQuality(LineQuality quality); ///< and tells
    LineQuality quality() const;

    /// Runs what has come, in its order. GUI thread. A delivery may destroy the outbox.
    void drain();

signals:
    void batchesReady();
    void statisticsChanged();
    void qualityChanged();

private:
    void notify();

    mutable std::mutex m_mutex;
    std::vector<std::pair<RecipientPtr, Delivery>> m_deliveries;
    std::deque<Batch> m_batches;
    BusStatistics m_statistics;
    LineQuality m_quality;
    bool m_noticePending = false;
    bool m_batchNoticePending = false; ///< told, and not yet taken
    bool m_tellBatches = false;
    bool m_tellStatistics = false;
    bool m_tellQuality = false;
};

} // namespace dynascope
