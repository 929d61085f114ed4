// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/settings/readimages.h"

#include "core/bus/readplan.h"
#include "core/session/procedures/atbaud.h"

#include <algorithm>

namespace dynascope {
namespace {

using Images = std::vector<Result<RegisterImage>>;

bool endsReading(const Error &error)
{
    return !mayHaveArrived(error) && error.kind != ErrorKind::Refused && error.kind != ErrorKind::NotSent;
}

/// The devices of one baud rate.
class Reading
{
public:
    Reading(JobContext &context, const std::vector<ReadSpansPlan> &devices, int baudRate, Images &images)
        : m_context(context), m_bus(context.bus()), m_images(images)
    {
        for (std::size_t i = 0; i < devices.size(); ++i) {
            if (devices[i].place.baudRate != baudRate)
                continue;
            m_traits.push_back(m_bus.traits(devices[i].place.id));
            for (Span span : devices[i].spans) {
                span.id = devices[i].place.id;
                m_spans.push_back(span);
                m_owners.push_back(i);
            }
        }
    }

    Result<void> run()
    {
        std::vector<std::size_t> open(m_spans.size());
        for (std::size_t i = 0; i < open.size(); ++i)
            open[i] = i;
        while (!open.empty()) {
            auto next = readRound(open);
            if (!next)
                return tl::unexpected(next.error());
            open = std::move(*next);
        }
        return {};
    }

private:
    /// Until one of a group is found silent: what is left is planned anew without it.
    Result<std::vector<std::size_t>> readRound(const std::vector<std::size_t> &open)
    {
        std::vector<Span> spans;
        for (const std::size_t i : open)
            spans.push_back(m_spans[i]);
        std::vector<bool> isRead(open.size());
        bool hasLost = false;
        for (const PlannedExchange &planned : planReads(spans, m_traits)) {
            if (hasLost)
                break;
            if (const auto go = m_context.checkpoint(); !go)
                return tl::unexpected(go.error());
            const auto result = m_bus.exchange(planned.request);
            if (!result)
                return tl::unexpected(result.error());
            for (std::size_t place = 0; place < planned.indices.size(); ++place) {
                const std::size_t at = planned.indices[place];
                const auto taken = take(open[at], result->replies[place], planned.indices.size() > 1);
                if (!taken)
                    return tl::unexpected(taken.error());
                isRead[at] = true;
                hasLost = hasLost || !m_images[m_owners[open[at]]];
            }
        }
        std::vector<std::size_t> left;
        for (std::size_t at = 0; at < open.size(); ++at) {
            if (!isRead[at] && m_images[m_owners[open[at]]])
                left.push_back(open[at]);
        }
        return left;
    }

    /// A group read that failed says little of a device: it is asked alone.
    Result<void> take(std::size_t i, const Result<Reply> &reply, bool inGroup)
    {
        auto &image = m_images[m_owners[i]];
        if (!image)
            return {};
        if (reply) {
            image->take(m_spans[i].address, reply->data);
            return {};
        }
        Error error = reply.error();
        if (inGroup) {
            const auto alone = read(m_bus, m_spans[i]);
            if (alone) {
                image->take(m_spans[i].address, alone->data);
                return {};
            }
            error = alone.error();
        }
        if (endsReading(error))
            return tl::unexpected(error);
        if (error.kind != ErrorKind::Refused)
            image = tl::unexpected(error);
        return {};
    }

    JobContext &m_context;
    Bus &m_bus;
    Images &m_images;
    std::vector<Span> m_spans;
    std::vector<std::size_t> m_owners; ///< of each span
    std::vector<Traits> m_traits;
};

} // namespace

Result<std::vector<Result<RegisterImage>>> readImages(JobContext &context, const std::vector<ReadSpansPlan> &devices)
{
    Images images(devices.size());
    std::vector<int> rates;
    for (const ReadSpansPlan &device : devices) {
        if (std::ranges::find(rates, device.place.baudRate) == rates.end())
            rates.push_back(device.place.baudRate);
    }
    for (const int rate : rates) {
        const AtBaud there(context.bus(), rate);
        if (!there.entered())
            return tl::unexpected(there.entered().error());
        if (const auto all = Reading(context, devices, rate, images).run(); !all)
            return tl::unexpected(all.error());
    }
    return images;
}

} // namespace dynascope
