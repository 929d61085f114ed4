// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/messages.h"
#include "core/bus/operations.h"

#include <algorithm>
#include <set>

namespace dynascope {

using messages::Shared;
using namespace std::chrono_literals;

namespace {

/// IDs that factory-fresh devices and most robots use: asked one by one where something answered that can't be read.
constexpr int LikelyIds = 20;

Found foundFrom(const Reply &reply, int baudRate)
{
    Found found;
    found.id = reply.id;
    found.baudRate = baudRate;
    found.modelNumber = static_cast<std::uint16_t>(littleEndian(reply.data, 2));
    found.firmware = reply.data[2];
    found.alert = reply.alert;
    return found;
}

/// Asks one device by itself and listens a little longer for a second voice. The reason for doubt; empty: none.
Result<QString> doubtOf(Bus &bus, const Found &found)
{
    const Result<ExchangeResult> answer = bus.exchange(pingRequest(found.id), 1);
    if (!answer)
        return tl::unexpected(answer.error());
    const quint64 before = bus.statistics().bytesReceived;
    if (Result<void> listened = bus.wait(bus.line().hostAllowance() + 1500us); !listened)
        return tl::unexpected(listened.error());
    const bool more = bus.statistics().bytesReceived != before
        || std::ranges::count(answer->seen.strayIds, found.id) > 0;
    const Result<Reply> &reply = answer->replies.front();
    if (!reply && answer->seen.bytesReceived > 0)
        return messages::sharedId(found.id, Shared::Damaged);
    if (!reply)
        return messages::onlyTheScan();
    if (foundFrom(*reply, found.baudRate).modelNumber != found.modelNumber)
        return messages::sharedId(found.id, Shared::TwoModels);
    if (more || answer->seen.damagedPackets > 0)
        return messages::sharedId(found.id, Shared::MoreThanOne);
    return QString();
}

/// A Ping for each, one right after the other. Is it sure that each is one healthy device? Else they are worth a second
/// look, one by one.
Result<bool> confirmAll(Bus &bus, const std::vector<Found> &devices)
{
    const quint64 before = bus.statistics().bytesReceived;
    quint64 heard = 0;
    bool clean = true;
    for (const Found &found : devices) {
        const Result<ExchangeResult> answer = bus.exchange(pingRequest(found.id), 0);
        if (!answer)
            return tl::unexpected(answer.error());
        const Result<Reply> &reply = answer->replies.front();
        const Observations &seen = answer->seen;
        heard += seen.bytesReceived;
        clean = clean && reply && foundFrom(*reply, found.baudRate).modelNumber == found.modelNumber
            && seen.strayPackets == 0 && seen.damagedPackets == 0 && seen.noiseBytes == 0;
    }
    if (Result<void> listened = bus.wait(bus.line().hostAllowance() + 1500us); !listened)
        return tl::unexpected(listened.error());
    return clean && bus.statistics().bytesReceived - before == heard; // and nothing came in between
}

/// Who may be behind answers that could not be read: the IDs in damaged packets, else the usual ones.
std::set<std::uint8_t> suspects(const Observations &seen, const std::vector<Found> &known, int firstId, int lastId)
{
    std::set<std::uint8_t> ids(seen.damagedIds.begin(), seen.damagedIds.end());
    ids.insert(seen.strayIds.begin(), seen.strayIds.end()); // one whose answer might have been a late one
    if (seen.damagedPackets > 0 || seen.noiseBytes > 0) {
        for (int id = firstId; id <= std::min(lastId, LikelyIds); ++id)
            ids.insert(static_cast<std::uint8_t>(id));
    }
    std::erase_if(ids, [&](std::uint8_t id) {
        return id < firstId || id > lastId || id > MaximumId
            || std::ranges::any_of(known, [id](const Found &found) { return found.id == id; });
    });
    return ids;
}

/// Looks for devices one ID at a time. Noise is nobody's; `unread` counts it.
Result<void> askEach(Bus &bus, const std::set<std::uint8_t> &ids, int retries, BaudScan &scan, std::size_t &unread,
    const std::function<void(const Found &)> &found)
{
    for (const std::uint8_t id : ids) {
        const Result<ExchangeResult> answer = bus.exchange(pingRequest(id), retries);
        if (!answer)
            return tl::unexpected(answer.error());
        const Result<Reply> &reply = answer->replies.front();
        const Observations &seen = answer->seen;
        const bool damaged = std::ranges::count(seen.damagedIds, id) > 0;
        if (!reply && !damaged) {
            unread += seen.noiseBytes + (seen.damagedPackets > 0 ? 1 : 0);
            continue;
        }
        Found device;
        if (reply)
            device = foundFrom(*reply, bus.line().baudRate());
        device.id = id;
        device.baudRate = bus.line().baudRate();
        if (!reply || damaged)
            device.doubt = messages::sharedId(id, Shared::Collide);
        scan.devices.push_back(device);
        if (found)
            found(device);
    }
    return {};
}

Result<BaudScan> sweep(Bus &bus, const ScanRequest &wanted, const std::function<void(const Found &)> &found)
{
    std::set<std::uint8_t> ids;
    for (int id = wanted.firstId; id <= std::min<int>(wanted.lastId, MaximumId); ++id)
        ids.insert(static_cast<std::uint8_t>(id));
    BaudScan scan;
    std::size_t unread = 0;
    if (Result<void> asked = askEach(bus, ids, 0, scan, unread, found); !asked)
        return tl::unexpected(asked.error());
    if (unread > 0)
        scan.unreadable = messages::unreadable(unread);
    return scan;
}

/// The second look, one by one, where the first was not clean.
Result<void> doubtEach(Bus &bus, const Observations &seen, BaudScan &scan, const std::function<void(const Found &)> &found)
{
    for (Found &device : scan.devices) {
        Result<QString> doubt = doubtOf(bus, device);
        if (!doubt)
            return tl::unexpected(doubt.error());
        device.doubt = *doubt;
        if (device.doubt.isEmpty() && std::ranges::count(seen.strayIds, device.id) > 0)
            device.doubt = messages::sharedId(device.id, Shared::BothAnswered);
        if (!device.doubt.isEmpty() && found)
            found(device);
    }
    return {};
}

} // namespace

Result<BaudScan> scanBaud(Bus &bus, const ScanRequest &wanted, const std::function<void(const Found &)> &found)
{
    if (wanted.sweep)
        return sweep(bus, wanted, found);
    BaudScan scan;
    const Result<ExchangeResult> answers = bus.broadcastPing(wanted.lastId, [&](const Reply &reply) {
        if (reply.id < wanted.firstId || reply.id > wanted.lastId)
            return;
        scan.devices.push_back(foundFrom(reply, bus.line().baudRate()));
        if (found)
            found(scan.devices.back());
    });
    if (!answers)
        return tl::unexpected(answers.error());
    const Observations &seen = answers->seen;
    const Result<bool> sure = confirmAll(bus, scan.devices);
    if (!sure)
        return tl::unexpected(sure.error());
    if (!*sure || !seen.strayIds.empty()) {
        if (Result<void> doubted = doubtEach(bus, seen, scan, found); !doubted)
            return tl::unexpected(doubted.error());
    }
    const std::size_t known = scan.devices.size();
    const std::set<std::uint8_t> ids = suspects(seen, scan.devices, wanted.firstId, wanted.lastId);
    std::size_t unread = seen.noiseBytes;
    if (Result<void> probed = askEach(bus, ids, 1, scan, unread, found); !probed)
        return tl::unexpected(probed.error());
    const bool doubtful = std::ranges::any_of(scan.devices, [](const Found &one) { return !one.doubt.isEmpty(); });
    if (scan.devices.size() == known && !doubtful && (unread > 0 || seen.damagedPackets > 0))
        scan.unreadable = messages::unreadable(std::max(unread, seen.bytesReceived));
    std::ranges::sort(scan.devices, {}, &Found::id);
    return scan;
}

} // namespace dynascope
