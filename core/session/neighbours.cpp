// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/neighbours.h"

#include "core/bus/messages.h"
#include "core/session/linesession.h"

#include <chrono>

namespace dynascope {

QString withNeighbours(const Device &device, const QString &what)
{
    constexpr auto Lately = std::chrono::seconds(10); // as long as the bus remembers
    const LineSession *line = device.line();
    if (!line || line->state() != BusThread::State::Open)
        return what; // that nobody answers says nothing then
    const LineTime now = std::chrono::steady_clock::now().time_since_epoch();
    std::vector<std::uint8_t> others;
    for (const auto &other : line->devices()) {
        if (other.get() != &device && other->state() == Device::State::Present && now - other->lastHeard() < Lately)
            others.push_back(other->id());
    }
    return messages::withOthers({ErrorKind::NothingReceived, what}, others).text;
}

} // namespace dynascope
