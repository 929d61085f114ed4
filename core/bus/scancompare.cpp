// SPDX-License-Identifier: GPL-3.0-or-later
// Two alike devices under one ID answer a Ping as one; their volatile registers give them away.
#include "core/bus/messages.h"
#include "core/bus/scan.h"

#include <algorithm>
#include <cmath>

namespace dynascope {

using messages::Shared;

namespace {

constexpr int FirstReads = 2, MoreReads = 4;
constexpr int UnsoundToDoubt = 2; ///< of the second look
constexpr int MostSilent = 2;     ///< one answer may be lost, or come late from a busy host
constexpr double ClockError = 0.03; ///< of a servo's clock
constexpr double TickSlack = 2;     ///< ms: rounded, and a little more
constexpr int TickPeriod = 32768;

struct Sample {
    Bytes data;
    LineTime from{}, to{}; ///< when it was taken: between these
};

/// What was read; nothing where it came damaged, or with something else.
struct Look {
    std::optional<Sample> sample;
    bool isSilent = false;  ///< this Read wasn't answered: tells nothing
    bool isRefused = false; ///< nor will another be
};

double milliseconds(LineTime time)
{
    return std::chrono::duration<double, std::milli>(time).count();
}

std::int64_t signedAt(ByteView data, int at, int size)
{
    const std::uint32_t raw = littleEndian(data.subspan(static_cast<std::size_t>(at)), size);
    const int unused = 64 - 8 * size;
    return static_cast<std::int64_t>(static_cast<std::uint64_t>(raw) << unused) >> unused;
}

bool ticksRight(const Sample &before, const Sample &after, int at)
{
    const double least = milliseconds(after.from - before.to);
    const double most = milliseconds(after.to - before.from);
    if (most > TickPeriod / 2.0)
        return true; // somebody else used the line in between: it may have gone round
    const ByteView first = before.data, second = after.data;
    const auto offset = static_cast<std::size_t>(at);
    const std::uint32_t passed
        = (littleEndian(second.subspan(offset), 2) - littleEndian(first.subspan(offset), 2)) % TickPeriod;
    const double slack = TickSlack + ClockError * most;
    return passed >= least - slack && passed <= most + slack;
}

/// Can one device have said both?
bool areOfOne(const Sample &before, const Sample &after, const VolatileSpan &span)
{
    if (span.tickAt >= 0 && !ticksRight(before, after, span.tickAt))
        return false;
    const double seconds = milliseconds(after.to - before.from) / 1000;
    return std::ranges::all_of(span.steady, [&](const VolatileSpan::Steady &one) {
        const std::int64_t moved = signedAt(after.data, one.at, one.size) - signedAt(before.data, one.at, one.size);
        return std::abs(static_cast<double>(moved)) <= one.slack + one.perSecond * seconds;
    });
}

Result<Look> take(Bus &bus, std::uint8_t id, const VolatileSpan &span)
{
    const LineTime begin = bus.line().now();
    const Result<ExchangeResult> answer = bus.exchange(readRequest({id, span.address, span.length}), 0);
    if (!answer)
        return tl::unexpected(answer.error());
    const Result<Reply> &reply = answer->replies.front();
    const Observations &seen = answer->seen;
    Look look;
    if (reply && seen.strayPackets == 0 && seen.damagedPackets == 0 && seen.noiseBytes == 0)
        look.sample = Sample{reply->data, begin, reply->at};
    else if (!reply)
        look.isSilent = seen.bytesReceived == 0 || reply.error().kind == ErrorKind::LateAnswer;
    look.isRefused = !reply && reply.error().kind == ErrorKind::Refused;
    return look;
}

} // namespace

Result<QString> compareReads(
    Bus &bus, const Found &device, const VolatileSpan &span, const std::function<Result<void>()> &between)
{
    std::optional<Sample> before;
    bool anyDamaged = false;
    int silent = 0;
    for (const int reads : {FirstReads, MoreReads}) {
        int unsound = 0;
        for (int i = 0; i < reads; ++i) {
            if (const Result<void> go = between ? between() : Result<void>(); !go)
                return tl::unexpected(go.error());
            Result<Look> look = take(bus, device.id, span);
            if (!look)
                return tl::unexpected(look.error());
            silent += look->isSilent ? 1 : 0;
            if (look->isRefused || silent == MostSilent)
                return QString();
            if (look->isSilent) {
                --i;
                continue;
            }
            const bool jumps = look->sample && before && !areOfOne(*before, *look->sample, span);
            unsound += !look->sample || jumps ? 1 : 0;
            anyDamaged = anyDamaged || !look->sample;
            if (look->sample)
                before = std::move(look->sample);
        }
        if (unsound < (reads == FirstReads ? 1 : UnsoundToDoubt))
            return QString();
    }
    return messages::sharedId(device.id, anyDamaged ? Shared::ReadsDamaged : Shared::ReadsDiffer);
}

} // namespace dynascope
