// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/quality.h"

#include <algorithm>
#include <cmath>

namespace dynascope {
namespace {

constexpr double SmallestMicroseconds = 8;
constexpr double StepsOfOctave = 4;

double microseconds(LineTime duration)
{
    return std::chrono::duration<double, std::micro>(duration).count();
}

} // namespace

void DurationCounts::add(LineTime duration)
{
    const double octaves = std::log2(std::max(microseconds(duration), SmallestMicroseconds) / SmallestMicroseconds);
    const auto step = static_cast<std::size_t>(octaves * StepsOfOctave);
    ++m_counts[std::min(step, Steps - 1)];
    ++m_count;
}

LineTime DurationCounts::percentile(double part) const
{
    if (m_count == 0)
        return {};
    const auto wanted = static_cast<quint64>(std::ceil(part * static_cast<double>(m_count)));
    quint64 sum = 0;
    std::size_t step = 0;
    while (step + 1 < Steps && (sum += m_counts[step]) < std::max<quint64>(wanted, 1))
        ++step;
    const double middle = SmallestMicroseconds * std::exp2((static_cast<double>(step) + 0.5) / StepsOfOctave);
    return std::chrono::duration_cast<LineTime>(std::chrono::duration<double, std::micro>(middle));
}

DeviceQuality &QualityLog::device(std::uint8_t id)
{
    std::unique_ptr<DeviceQuality> &device = m_devices[id];
    if (!device) {
        device = std::make_unique<DeviceQuality>();
        device->id = id;
    }
    return *device;
}

void QualityLog::count(const Request &request, const ExchangeResult &result, LineTime origin)
{
    ++m_totals.exchanges;
    m_totals.bytesReceived += result.seen.bytesReceived;
    m_totals.strays += static_cast<quint64>(result.seen.strayPackets);
    m_totals.crcErrors += static_cast<quint64>(result.seen.damagedPackets);
    m_totals.lateAnswers += static_cast<quint64>(result.seen.lateAnswers);
    bool whole = !result.replies.empty();
    LineTime turn = origin;
    for (std::size_t i = 0; i < result.replies.size(); ++i) {
        const Result<Reply> &reply = result.replies[i];
        const std::uint8_t id = reply ? reply->id : i < request.replies.size() ? request.replies[i].id : BroadcastId;
        if (reply && reply->bytes == 0)
            continue; // silent by its Status Return Level: says nothing of the wire
        DeviceQuality &one = device(id);
        if (reply) {
            ++m_totals.replies;
            ++one.good;
            one.bytes += reply->bytes;
            one.responses.add(reply->at - turn);
            turn = std::max(turn, reply->at);
            continue;
        }
        whole = false;
        if (result.brokenAt >= 0 && static_cast<int>(i) > result.brokenAt)
            continue; // hidden by another one's silence
        switch (reply.error().kind) {
        case ErrorKind::Refused:
            ++m_totals.replies;
            ++one.good;
            ++one.refused;
            break;
        case ErrorKind::WrongLength:
            ++m_totals.lengthErrors;
            ++one.lengthErrors;
            break;
        case ErrorKind::DamagedCrc: ++one.crcErrors; break;
        case ErrorKind::LateAnswer: ++one.lateAnswers; break;
        case ErrorKind::CutOff: ++one.cutOff; [[fallthrough]];
        default:
            ++m_totals.timeouts;
            ++one.timeouts;
            break;
        }
    }
    if (whole)
        m_roundTrips.add(result.seen.roundTrip);
}

void QualityLog::countRetry(const Request &request)
{
    ++m_totals.retries;
    for (const ExpectedReply &reply : request.replies)
        ++device(reply.id).retries;
}

LineQuality QualityLog::snapshot() const
{
    LineQuality quality{m_totals, m_roundTrips, {}};
    for (const auto &device : m_devices) {
        if (device)
            quality.devices.push_back(*device);
    }
    return quality;
}

} // namespace dynascope
