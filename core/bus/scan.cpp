// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/scan.h"

#include "core/bus/messages.h"

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

/// The hooks, and what came while nobody else used the line.
class Scan
{
public:
    Scan(Bus &bus, const ScanHooks &hooks) : m_bus(bus), m_hooks(hooks) { }

    /// Lets others use the line, whose bytes are none of ours.
    Result<void> between(double part)
    {
        if (!m_hooks.between)
            return {};
        const quint64 before = m_bus.statistics().bytesReceived;
        Result<void> go = m_hooks.between(part);
        m_others += m_bus.statistics().bytesReceived - before;
        return go;
    }
    void found(const Found &device) const
    {
        if (m_hooks.found)
            m_hooks.found(device);
    }
    quint64 received() const { return m_bus.statistics().bytesReceived - m_others; }
    /// Listens a little longer for a second voice.
    Result<void> listen() { return m_bus.wait(m_bus.line().hostAllowance() + 1500us); }

    Bus &bus() { return m_bus; }
    const ScanHooks &hooks() const { return m_hooks; }
    BaudScan result;
    std::size_t unread = 0; ///< bytes and packets that are nobody's

private:
    Bus &m_bus;
    const ScanHooks &m_hooks;
    quint64 m_others = 0;
};

/// Asks one device by itself. The reason for doubt; empty: none.
Result<QString> doubtOf(Scan &scan, const Found &found)
{
    const Result<ExchangeResult> answer = scan.bus().exchange(pingRequest(found.id), 1);
    if (!answer)
        return tl::unexpected(answer.error());
    const Observations &seen = answer->seen;
    const quint64 before = scan.received();
    if (Result<void> listened = scan.listen(); !listened)
        return tl::unexpected(listened.error());
    const bool more = scan.received() != before || std::ranges::count(seen.strayIds, found.id) > 0;
    const Result<Reply> &reply = answer->replies.front();
    if (!reply && seen.bytesReceived > 0)
        return messages::sharedId(found.id, Shared::Damaged);
    if (!reply)
        return messages::onlyTheScan();
    if (foundFrom(*reply, found.baudRate).modelNumber != found.modelNumber)
        return messages::sharedId(found.id, Shared::TwoModels);
    if (more || seen.damagedPackets > 0)
        return messages::sharedId(found.id, Shared::MoreThanOne);
    return QString();
}

/// A Ping for each, one right after the other. Is it sure that each is one healthy device? Else they are worth a second
/// look, one by one.
Result<bool> confirmAll(Scan &scan)
{
    const quint64 before = scan.received();
    quint64 heard = 0;
    bool clean = true;
    for (const Found &found : scan.result.devices) {
        if (Result<void> go = scan.between(1); !go)
            return tl::unexpected(go.error());
        const Result<ExchangeResult> answer = scan.bus().exchange(pingRequest(found.id), 0);
        if (!answer)
            return tl::unexpected(answer.error());
        const Result<Reply> &reply = answer->replies.front();
        const Observations &seen = answer->seen;
        heard += seen.bytesReceived;
        clean = clean && reply && foundFrom(*reply, found.baudRate).modelNumber == found.modelNumber
            && seen.strayPackets == 0 && seen.damagedPackets == 0 && seen.noiseBytes == 0;
    }
    if (Result<void> listened = scan.listen(); !listened)
        return tl::unexpected(listened.error());
    return clean && scan.received() - before == heard; // and nothing came in between
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

/// One that answered a Ping of its own: did it alone? `answer` is what came to that Ping.
Result<QString> doubtOfAnswer(Scan &scan, const Found &device, const Observations &seen)
{
    const quint64 before = scan.received();
    if (Result<void> listened = scan.listen(); !listened)
        return tl::unexpected(listened.error());
    if (std::ranges::count(seen.damagedIds, device.id) > 0)
        return messages::sharedId(device.id, Shared::Collide);
    const bool isStray = std::ranges::count(seen.strayIds, device.id) > 0;
    if (!isStray && scan.received() == before)
        return QString();
    Result<QString> doubt = doubtOf(scan, device);
    if (doubt && doubt->isEmpty() && isStray)
        return messages::sharedId(device.id, Shared::BothAnswered);
    return doubt;
}

/// Looks for devices one ID at a time. Noise is nobody's.
Result<void> askEach(Scan &scan, const std::set<std::uint8_t> &ids, bool isSweep)
{
    const int rate = scan.bus().line().baudRate();
    std::size_t asked = 0;
    for (const std::uint8_t id : ids) {
        const double part = static_cast<double>(asked++) / static_cast<double>(ids.size());
        if (Result<void> go = scan.between(isSweep ? part : 1); !go)
            return go;
        const Result<ExchangeResult> answer = scan.bus().exchange(pingRequest(id), isSweep ? 0 : 1);
        if (!answer)
            return tl::unexpected(answer.error());
        const Result<Reply> &reply = answer->replies.front();
        const Observations &seen = answer->seen;
        if (!reply && std::ranges::count(seen.damagedIds, id) == 0) {
            scan.unread += seen.noiseBytes + (seen.damagedPackets > 0 ? 1 : 0);
            continue;
        }
        Found device;
        if (reply)
            device = foundFrom(*reply, rate);
        device.id = id;
        device.baudRate = rate;
        const Result<QString> doubt
            = reply ? doubtOfAnswer(scan, device, seen) : messages::sharedId(id, Shared::Collide);
        if (!doubt)
            return tl::unexpected(doubt.error());
        device.doubt = *doubt;
        scan.result.devices.push_back(device);
        scan.found(device);
    }
    return {};
}

/// The second look, one by one, where the first was not clean.
Result<void> doubtEach(Scan &scan, const Observations &seen)
{
    for (Found &device : scan.result.devices) {
        if (Result<void> go = scan.between(1); !go)
            return go;
        Result<QString> doubt = doubtOf(scan, device);
        if (!doubt)
            return tl::unexpected(doubt.error());
        device.doubt = *doubt;
        if (device.doubt.isEmpty() && std::ranges::count(seen.strayIds, device.id) > 0)
            device.doubt = messages::sharedId(device.id, Shared::BothAnswered);
        if (!device.doubt.isEmpty())
            scan.found(device);
    }
    return {};
}

/// When all are known and shown: whether one that seems healthy is two that are alike.
Result<void> compareEach(Scan &scan)
{
    for (Found &device : scan.result.devices) {
        const std::optional<VolatileSpan> span
            = scan.hooks().volatileOf && device.doubt.isEmpty() ? scan.hooks().volatileOf(device) : std::nullopt;
        if (!span)
            continue;
        Result<QString> doubt = compareReads(scan.bus(), device, *span, [&] { return scan.between(1); });
        if (!doubt)
            return tl::unexpected(doubt.error());
        device.doubt = *doubt;
        if (!device.doubt.isEmpty())
            scan.found(device);
    }
    return {};
}

Result<void> sweep(Scan &scan, const ScanRequest &wanted)
{
    std::set<std::uint8_t> ids;
    for (int id = wanted.firstId; id <= std::min<int>(wanted.lastId, MaximumId); ++id)
        ids.insert(static_cast<std::uint8_t>(id));
    if (Result<void> asked = askEach(scan, ids, true); !asked)
        return asked;
    if (scan.unread > 0)
        scan.result.unreadable = messages::unreadable(scan.unread);
    return {};
}

Result<void> broadcast(Scan &scan, const ScanRequest &wanted)
{
    std::vector<Found> &devices = scan.result.devices;
    const Result<ExchangeResult> answers = scan.bus().broadcastPing(wanted.lastId, [&](const Reply &reply) {
        if (reply.id < wanted.firstId || reply.id > wanted.lastId)
            return;
        devices.push_back(foundFrom(reply, scan.bus().line().baudRate()));
        scan.found(devices.back());
    });
    if (!answers)
        return tl::unexpected(answers.error());
    const Observations &seen = answers->seen;
    const Result<bool> sure = confirmAll(scan);
    if (!sure)
        return tl::unexpected(sure.error());
    if (!*sure || !seen.strayIds.empty()) {
        if (Result<void> doubted = doubtEach(scan, seen); !doubted)
            return doubted;
    }
    const std::size_t known = devices.size();
    const std::set<std::uint8_t> ids = suspects(seen, devices, wanted.firstId, wanted.lastId);
    scan.unread = seen.noiseBytes;
    if (Result<void> probed = askEach(scan, ids, false); !probed)
        return probed;
    const bool doubtful = std::ranges::any_of(devices, [](const Found &one) { return !one.doubt.isEmpty(); });
    if (devices.size() == known && !doubtful && (scan.unread > 0 || seen.damagedPackets > 0))
        scan.result.unreadable = messages::unreadable(std::max(scan.unread, seen.bytesReceived));
    std::ranges::sort(devices, {}, &Found::id);
    return {};
}

} // namespace

Result<BaudScan> scanBaud(Bus &bus, const ScanRequest &wanted, const ScanHooks &hooks)
{
    Scan scan(bus, hooks);
    if (Result<void> looked = wanted.sweep ? sweep(scan, wanted) : broadcast(scan, wanted); !looked)
        return tl::unexpected(looked.error());
    if (Result<void> compared = compareEach(scan); !compared)
        return tl::unexpected(compared.error());
    return std::move(scan.result);
}

} // namespace dynascope
