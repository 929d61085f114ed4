// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/quality.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace dynascope {
namespace {

/// Each octave from 2^13 ns on has 2^3 steps of one width; below it, down to 0, there is one of the same number.
constexpr int FirstOctave = 13;
constexpr int StepBits = 3;

std::size_t stepOf(LineTime duration, std::size_t steps)
{
    const auto ns = static_cast<std::uint64_t>(std::max<LineTime::rep>(duration.count(), 0));
    const int octave = std::max(static_cast<int>(std::bit_width(ns)) - FirstOctave, 0);
    const std::uint64_t within = ns >> (FirstOctave - StepBits + std::max(octave - 1, 0));
    const auto step = static_cast<std::size_t>(within) + (octave > 1 ? static_cast<std::size_t>(octave - 1) << StepBits : 0);
    return std::min(step, steps - 1);
}

LineTime beginOf(std::size_t step)
{
    const std::size_t octave = step >> StepBits;
    const std::size_t within = octave == 0 ? step : (step & ((1U << StepBits) - 1)) + (1U << StepBits);
    return LineTime(static_cast<LineTime::rep>(within)
        << (static_cast<std::size_t>(FirstOctave - StepBits) + (octave == 0 ? 0 : octave - 1)));
}

constexpr std::array Counts{&DeviceQuality::good, &DeviceQuality::refused, &DeviceQuality::timeouts,
    &DeviceQuality::cutOff, &DeviceQuality::crcErrors, &DeviceQuality::lengthErrors, &DeviceQuality::lateAnswers,
    &DeviceQuality::retries, &DeviceQuality::bytes};
constexpr std::array TotalCounts{&BusStatistics::exchanges, &BusStatistics::replies, &BusStatistics::timeouts,
    &BusStatistics::crcErrors, &BusStatistics::lengthErrors, &BusStatistics::strays, &BusStatistics::lateAnswers,
    &BusStatistics::retries, &BusStatistics::bytesSent, &BusStatistics::bytesReceived};

} // namespace

void DurationCounts::add(LineTime duration)
{
    ++m_counts[stepOf(duration, Steps)];
    ++m_count;
}

LineTime DurationCounts::percentile(double part) const
{
    if (m_count == 0)
        return {};
    const double wanted = std::max(part * static_cast<double>(m_count), 1.0);
    double sum = 0;
    std::size_t step = 0;
    while (step + 1 < Steps && sum + m_counts[step] < wanted)
        sum += m_counts[step++];
    // Within the step as if they were spread evenly.
    const double inside = std::clamp((wanted - sum) / std::max(m_counts[step], 1U), 0.0, 1.0);
    const LineTime begin = beginOf(step);
    return begin + LineTime(std::llround(inside * static_cast<double>((beginOf(step + 1) - begin).count())));
}

DurationCounts DurationCounts::since(const DurationCounts &before) const
{
    DurationCounts rest = *this;
    for (std::size_t step = 0; step < Steps; ++step)
        rest.m_counts[step] -= before.m_counts[step];
    rest.m_count -= before.m_count;
    return rest;
}

double DeviceQuality::badShare() const
{
    return asked() > 0 ? static_cast<double>(bad()) / static_cast<double>(asked()) : 0.0;
}

DeviceQuality DeviceQuality::since(const DeviceQuality &before) const
{
    DeviceQuality rest = *this;
    for (const auto count : Counts)
        rest.*count -= before.*count;
    rest.responses = responses.since(before.responses);
    return rest;
}

DeviceQuality &DeviceQuality::operator+=(const DeviceQuality &other)
{
    for (const auto count : Counts)
        this->*count += other.*count;
    return *this;
}

const DeviceQuality *LineQuality::device(std::uint8_t id) const
{
    const auto known = std::ranges::find(devices, id, &DeviceQuality::id);
    return known == devices.end() ? nullptr : &*known;
}

DeviceQuality LineQuality::sum() const
{
    DeviceQuality sum;
    sum.id = BroadcastId;
    for (const DeviceQuality &device : devices)
        sum += device;
    return sum;
}

LineQuality LineQuality::since(const LineQuality &before) const
{
    LineQuality rest = *this;
    for (const auto count : TotalCounts)
        rest.totals.*count -= before.totals.*count;
    rest.totals.busy -= before.totals.busy;
    rest.roundTrips = roundTrips.since(before.roundTrips);
    for (DeviceQuality &device : rest.devices) {
        if (const DeviceQuality *earlier = before.device(device.id))
            device = device.since(*earlier);
    }
    return rest;
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

void QualityLog::count(const Request &request, const ExchangeResult &result, LineTime origin, bool asking)
{
    ++m_totals.exchanges;
    m_totals.bytesReceived += result.seen.bytesReceived;
    m_totals.strays += static_cast<quint64>(result.seen.strayPackets);
    m_totals.crcErrors += static_cast<quint64>(result.seen.damagedPackets);
    m_totals.lateAnswers += static_cast<quint64>(result.seen.lateAnswers);
    bool whole = !result.replies.empty();
    for (std::size_t i = 0; i < result.replies.size(); ++i) {
        const Result<Reply> &reply = result.replies[i];
        const std::uint8_t id = reply ? reply->id : i < request.replies.size() ? request.replies[i].id : BroadcastId;
        if (reply && reply->bytes == 0)
            continue; // silent by its Status Return Level: says nothing of the wire
        if (asking && !reply && reply.error().kind == ErrorKind::NothingReceived) {
            whole = false;
            continue; // nobody is there, which was the question
        }
        DeviceQuality &one = device(id);
        if (reply) {
            ++m_totals.replies;
            ++one.good;
            one.bytes += reply->bytes;
            one.responses.add(reply->at - origin);
            continue;
        }
        whole = false;
        if (result.isHidden(i))
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
    LineQuality quality{m_totals, m_roundTrips, {}, {}, {}};
    for (const auto &device : m_devices) {
        if (device)
            quality.devices.push_back(*device);
    }
    return quality;
}

} // namespace dynascope
