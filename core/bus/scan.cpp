// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/operations.h"

#include <algorithm>
#include <set>

namespace dynascope {

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

QString sharedId(std::uint8_t id)
{
    return QStringLiteral("two devices seem to share ID %1").arg(id);
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
    const bool more = bus.statistics().bytesReceived != before || answer->seen.strayPackets > 0;
    const Result<Reply> &reply = answer->replies.front();
    if (!reply && answer->seen.bytesReceived > 0)
        return sharedId(found.id) + QStringLiteral(": its answers come damaged");
    if (!reply)
        return QStringLiteral("it answered the scan, but no Ping of its own");
    if (foundFrom(*reply, found.baudRate).modelNumber != found.modelNumber)
        return sharedId(found.id) + QStringLiteral(": it answered as two different models");
    if (more || answer->seen.damagedPackets > 0)
        return sharedId(found.id) + QStringLiteral(": more came than one answer");
    return QString();
}

/// Who may be behind answers that could not be read: the IDs in damaged packets, else the usual ones.
std::set<std::uint8_t> suspects(const Observations &seen, const std::vector<Found> &known, int firstId, int lastId)
{
    std::set<std::uint8_t> ids(seen.damagedIds.begin(), seen.damagedIds.end());
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

/// Something answered the broadcast that could not be read: looks for it one ID at a time.
Result<void> probeSuspects(Bus &bus, const std::set<std::uint8_t> &ids, int baudRate, std::vector<Found> &devices,
    const std::function<void(const Found &)> &found)
{
    for (const std::uint8_t id : ids) {
        const Result<ExchangeResult> answer = bus.exchange(pingRequest(id), 1);
        if (!answer)
            return tl::unexpected(answer.error());
        if (answer->seen.bytesReceived == 0)
            continue;
        Found device;
        const Result<Reply> &reply = answer->replies.front();
        if (reply)
            device = foundFrom(*reply, baudRate);
        device.id = id;
        device.baudRate = baudRate;
        if (!reply || answer->seen.damagedPackets > 0)
            device.doubt = sharedId(id) + QStringLiteral(": their answers collide");
        devices.push_back(device);
        if (found)
            found(device);
    }
    return {};
}

} // namespace

Result<std::vector<Found>> scanBaud(Bus &bus, int firstId, int lastId, const std::function<void(const Found &)> &found)
{
    const int baudRate = bus.line().baudRate();
    std::vector<Found> devices;
    const Result<ExchangeResult> answers = bus.broadcastPing(lastId, [&](const Reply &reply) {
        if (reply.id < firstId || reply.id > lastId)
            return;
        devices.push_back(foundFrom(reply, baudRate));
        if (found)
            found(devices.back());
    });
    if (!answers)
        return tl::unexpected(answers.error());
    const std::vector<std::uint8_t> &twice = answers->seen.strayIds;
    for (Found &device : devices) {
        Result<QString> doubt = doubtOf(bus, device);
        if (!doubt)
            return tl::unexpected(doubt.error());
        device.doubt = *doubt;
        if (device.doubt.isEmpty() && std::ranges::count(twice, device.id) > 0)
            device.doubt = sharedId(device.id) + QStringLiteral(": both answered the scan");
        if (!device.doubt.isEmpty() && found)
            found(device);
    }
    const std::set<std::uint8_t> ids = suspects(answers->seen, devices, firstId, lastId);
    if (Result<void> probed = probeSuspects(bus, ids, baudRate, devices, found); !probed)
        return tl::unexpected(probed.error());
    std::ranges::sort(devices, {}, &Found::id);
    return devices;
}

} // namespace dynascope
