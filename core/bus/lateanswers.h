// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/bus_values.h"

#include <optional>

namespace dynascope {

/// The answers that were asked for, did not come in time and may still come. A status packet has no sequence number:
/// a late one looks like the answer to the next request of the same device and length. But adapters that delay keep the
/// order, so one answer that can be no late one proves that nothing older is under way.
class LateAnswers
{
public:
    bool isEmpty() const { return m_entries.empty(); }
    /// An answer of `id` came that can be none of them: nothing older than its request will. But another device that is
    /// itself slow with what it was told may answer that yet.
    void clear(std::uint8_t id, LineTime now);
    /// The line works at another rate. An answer to a Ping at the old one says nothing of who is there at the new one.
    void rateChanged();

    /// No adapter and no network holds an answer back for longer than this: what was not heard by then was lost.
    static constexpr LineTime Longest = std::chrono::seconds(10);
    void forgetOld(LineTime now);

    /// What of `result` is missing, or was not said by a device thought to be mute, may still come. `origin` is from when on it could be awaited.
    void addMissing(const Request &request, const ExchangeResult &result, LineTime origin);
    /// Whoever is there may still answer a broadcast Ping.
    void addPings(LineTime origin);
    /// All that `request` asks for: it was given up.
    void addAll(const Request &request, LineTime origin);

    /// May this status packet be one of them? An error comes without data, whatever was asked for; Ping knows none.
    bool couldBe(std::uint8_t id, std::size_t length, bool isError) const;
    bool couldBePing(std::uint8_t id) const; ///< may what looks like an answer to Ping be one of them?
    /// May what looks like an answer to Ping be one of them, and not one to Ping, which says the same at any time?
    bool couldFakePing(std::uint8_t id) const;
    bool couldBeFast(std::size_t packetSize) const;
    /// May the first answer to `request` be mistaken?
    bool concern(const Request &request) const;
    /// A number of bytes that no late answer of this device has: what a Read of as many brings is its own answer. 0: all
    /// that a table surely has are taken.
    std::uint16_t distinctLength(std::uint8_t id) const;
    /// From when on a status packet like this one could be awaited.
    std::optional<LineTime> originOf(std::uint8_t id, std::size_t length) const;

private:
    struct Entry {
        std::uint8_t id = 0; ///< BroadcastId: of anybody
        std::size_t length = 0; ///< data bytes; of a fast reply the whole packet's
        enum class Kind { Plain, Ping, Fast } kind = Kind::Plain;
        LineTime origin{};
        LineTime heldUntil{}; ///< so long the device may take
    };
    void add(const Entry &entry);
    static Entry entryFor(const Request &request, const ExpectedReply &reply, LineTime origin);

    std::vector<Entry> m_entries; ///< no two alike: as many as there are kinds of requests
};

} // namespace dynascope
