// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/record/recording.h"
#include "core/replay/replaydevices.h"
#include "core/session/eventlog.h"
#include "core/session/histories.h"

#include <atomic>

namespace dynascope {

/// A reply that was asked for and did not come.
struct MissedReply {
    LineTime at{};
    DeviceKey device = 0;
    std::uint16_t address = 0;
    std::uint16_t length = 0;
};

/// All that a recording holds of its devices, in memory.
struct ReplayData {
    std::unique_ptr<Histories> histories;
    std::vector<MissedReply> missed; ///< by time
    std::deque<LoggedEvent> events;  ///< by time; of the device whose name they begin with, else of none (0)
    quint64 samples = 0;
    LineTime last{}; ///< of all, missed ones included: a recording's index tells when its last cycle began
    std::size_t damagedParts = 0; ///< that were passed over
};

/// What a reader tells to another thread, and is told by it.
struct ReplayProgress {
    std::atomic<int> percent{0};
    std::atomic<bool> isCancelled{false};
};

/// Reads all of it, in two threads. Any thread; the recording and `devices` are its own meanwhile. Cancelled: half of it is no use.
/// `names` are the devices', by key, as events name them.
Result<ReplayData> loadReplay(Recording &recording, const ReplayDevices &devices,
                              const std::map<DeviceKey, QString> &names, std::size_t budget, ReplayProgress &progress);

} // namespace dynascope
