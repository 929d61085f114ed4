// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/resetplan.h"

#include "core/session/linesession.h"
#include "core/session/texts.h"

#include <algorithm>

namespace dynascope {
namespace {

MovePlace placed(const DevicePlace &place)
{
    return {place.baudRate, place.id};
}

Result<void> checkEnds(const std::vector<ResetMove> &resets, const std::vector<MovePlace> &others)
{
    for (std::size_t i = 0; i < resets.size(); ++i) {
        const MovePlace end = placed(resets[i].after);
        for (std::size_t other = 0; other < i; ++other) {
            if (placed(resets[other].after) == end)
                return failure(
                    ErrorKind::InvalidArgument,
                    CommandText::tr(
                        "%1 and %2 would both end at %3: keep their IDs, or reset one, give it another ID, and "
                        "then reset the next")
                        .arg(resets[other].place.name, resets[i].place.name, placeText(end)));
        }
        if (std::ranges::find(others, end) != others.end())
            return failure(ErrorKind::InvalidArgument, CommandText::tr("%1 would end at %2, where another device is")
                                                           .arg(resets[i].place.name, placeText(end)));
    }
    return {};
}

} // namespace

Result<std::vector<std::size_t>> planResets(const std::vector<ResetMove> &resets, const std::vector<MovePlace> &others)
{
    if (const auto fine = checkEnds(resets, others); !fine)
        return tl::unexpected(fine.error());
    std::vector<std::size_t> waiting, order;
    for (std::size_t i = 0; i < resets.size(); ++i)
        waiting.push_back(i);
    while (!waiting.empty()) {
        const auto isFree = [&](std::size_t one) {
            return std::ranges::none_of(waiting, [&](std::size_t other) {
                return other != one && placed(resets[other].place) == placed(resets[one].after);
            });
        };
        const auto next = std::ranges::find_if(waiting, isFree);
        if (next == waiting.end())
            return failure(
                ErrorKind::InvalidArgument,
                CommandText::tr("Each of these would end where another one is: reset them one after the other"));
        order.push_back(*next);
        waiting.erase(next);
    }
    return order;
}

Result<std::vector<Device *>> resetOrder(const std::vector<Device *> &devices, ResetOption option)
{
    std::vector<ResetMove> resets;
    std::vector<MovePlace> others;
    for (const Device *device : devices) {
        if (!device->table().find(Known::Id) || !device->table().find(Known::BaudRate))
            return failure(
                ErrorKind::NotSupported,
                CommandText::tr("It isn't known where %1 would be after a reset").arg(device->displayName()));
        if (option == ResetOption::All && device->table().description().axes > 1)
            return failure(
                ErrorKind::NotSupported,
                CommandText::tr(
                    "%1 is one of two axes, and it isn't known which ID this reset gives it; keep the ID, then "
                    "change it")
                    .arg(device->displayName()));
        resets.push_back({placeOf(*device), placeAfterReset(*device, option)});
    }
    const LineSession *line = devices.empty() ? nullptr : devices.front()->line();
    for (std::size_t i = 0; line && i < line->devices().size(); ++i) {
        const Device *other = line->devices()[i].get();
        if (std::ranges::find(devices, other) != devices.end())
            continue;
        others.push_back({other->baudRate(), other->id()});
        if (const auto secondary = other->raw(Known::SecondaryId); secondary && *secondary <= MaximumId)
            others.push_back({other->baudRate(), static_cast<int>(*secondary)});
    }
    const auto order = planResets(resets, others);
    if (!order)
        return tl::unexpected(order.error());
    std::vector<Device *> ordered;
    for (const std::size_t index : *order)
        ordered.push_back(devices[index]);
    return ordered;
}

} // namespace dynascope
