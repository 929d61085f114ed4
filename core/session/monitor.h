// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/histories.h"
#include "core/session/session.h"
#include "core/session/watch.h"

#include <map>
#include <memory>
#include <optional>
#include <set>

namespace dynascope {

struct DeviceWatches;

/// Decides what is polled and keeps the histories of what is watched. GUI thread.
///
/// Watched fields at full rate, or as often as is wanted; RAM of the selected device at 10 Hz; Torque Enable, Hardware
/// Error Status, temperature and voltage of all devices at 1 Hz; what tells of a restart each 9 s.
/// While somebody looks at all devices at a glance, also their position and load.
class Monitor : public QObject
{
    Q_OBJECT

public:
    explicit Monitor(Session &session, QObject *parent = nullptr);

    void watch(const Watch &watch);
    void unwatch(const Watch &watch); ///< its history stays until clear() or the device goes
    bool isWatched(const Watch &watch) const { return m_watches.contains(watch); }
    /// How often it is wanted, Hz; 0, and so at first: as often as the line allows.
    void setRate(const Watch &watch, double hertz);
    double rate(const Watch &watch) const;
    const std::set<Watch> &watches() const { return m_watches; }
    void select(const std::vector<Device *> &devices); ///< whose RAM the grid shows
    /// Fields of long runs (indirect.h) that the grid shows of them; the others aren't polled.
    void setUnfolded(const std::set<Watch> &fields);
    /// What is read of this device at least each 10 s, whatever else is: what tells of a restart.
    void setSigns(DeviceKey device, const std::set<int> &fields);

    /// Position and load of all devices five times a second, and their limits once: somebody looks at all of them.
    void setGlancing(bool glancing);
    bool isGlancing() const { return m_isGlancing; }

    /// nullptr until its first sample. What was watched when its device went, unplugged or closed with its line, keeps
    /// its history until unwatch() or clear().
    const History *history(const Watch &watch) const { return m_histories->find(watch); }
    void clear(); ///< all histories; not those of a recording
    const Histories &histories() const { return *m_histories; }
    void setHistoryBudget(std::size_t bytes) { m_histories->setBudget(bytes); } ///< of all of them

    /// From now on these are the histories, known up to their end, while Session::now() is a replay's. Nothing is polled
    /// any more, and no sample comes.
    void showRecorded(std::unique_ptr<Histories> histories);
    bool isRecorded() const { return m_isRecorded; }
    /// The last sample up to now; in a replay there are later ones. Nothing where there is none.
    std::optional<History::Sample> newest(const History &history) const;

    bool mayReadFast() const { return m_mayReadFast; }
    void setMayReadFast(bool may); ///< fast reads of those who know them; so at first

    /// What is read of this line, each device by this packing (nullptr: by none). Without gaps in histories.
    using PackingOf = std::function<const IndirectPacking *(const Device &)>;
    PollPlan planOf(const LineSession &line, const PackingOf &packing) const;

    bool isPaused() const { return m_paused; }
    void setPaused(bool paused); ///< no polling at all

signals:
    void watchesChanged();

private:
    void follow(LineSession *line);
    void drop(Device *device);
    void replanSoon();
    void replan();
    void markGaps(const LineSession &line);
    void record(const Batch &batch);
    void eraseHistories(const std::function<bool(const Watch &)> &which);
    void glance(DeviceWatches &watches) const;
    static std::set<int> unknownLimits(const Device &device);
    bool learned(const Batch &batch) const;

    Session &m_session;
    std::set<Watch> m_watches;
    std::map<Watch, double> m_rates; ///< of those not at full rate; stay while they aren't watched
    std::unique_ptr<Histories> m_histories = std::make_unique<Histories>();
    bool m_isRecorded = false;
    std::vector<DeviceKey> m_selected;
    std::set<Watch> m_unfolded;
    std::map<DeviceKey, std::set<int>> m_signs; ///< stay for a device that comes back
    std::map<DeviceKey, std::set<int>> m_asked; ///< read until they are known, by the last plan
    bool m_isGlancing = false;
    bool m_paused = false;
    bool m_mayReadFast = true;
    QTimer m_replanTimer;
    struct SentPlan {
        int generation = 0; ///< of the bus thread that has it
        PollPlan plan;
    };
    std::map<const LineSession *, SentPlan> m_sentPlans; ///< so that nothing is sent twice
};

} // namespace dynascope
