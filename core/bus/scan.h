// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/bus.h"

#include <functional>

/// Who is on the line, at the rate it works at. Bus thread.
namespace dynascope {

/// A device as a scan saw it.
struct Found {
    std::uint8_t id = 0;
    int baudRate = 57600;
    std::uint16_t modelNumber = 0;
    std::uint8_t firmware = 0;
    bool alert = false;
    QString doubt; ///< empty, or why this may not be one healthy device ("two devices seem to share this ID")

    friend bool operator==(const Found &, const Found &) = default;
};

struct ScanRequest {
    int firstId = 0, lastId = MaximumId;
    /// One Ping after the other instead of the broadcast one, for buses on which that fails. Slow: each absent ID costs
    /// a whole deadline.
    bool sweep = false;
};

/// Registers of a model that two devices hardly have alike at a time, and what one device's can't do between two reads.
/// Made from the control table; the bus includes none.
struct VolatileSpan {
    std::uint16_t address = 0, length = 0;
    int tickAt = -1; ///< Realtime Tick: two bytes, milliseconds, 0..32767; counted from `address`. −1: none
    /// A register that changes no faster than so: raw, two's complement.
    struct Steady {
        int at = 0; ///< from `address`
        int size = 1;
        double slack = 0;
        double perSecond = 0;
    };
    std::vector<Steady> steady;
};

/// What a scan tells and asks while it runs; each may be empty.
struct ScanHooks {
    /// With each device as it answers, and once more with one that turns out doubtful.
    std::function<void(const Found &)> found;
    /// Between two exchanges, `part` of the scan's request (0..1) being done: here others may use the bus. An error
    /// ends the scan with it. The longest exchange is the broadcast Ping, up to 0.8 s: devices that answer it in turn
    /// can't be told to stop, and whoever spoke before would talk into their answers.
    std::function<Result<void>(double part)> between;
    /// Where it names one, the scan ends with two reads of it, which tells two alike devices under one ID: they answer
    /// a Ping as one.
    std::function<std::optional<VolatileSpan>(const Found &)> volatileOf;
};

/// What a scan at one rate came to.
struct BaudScan {
    std::vector<Found> devices; ///< by ID
    QString unreadable;         ///< empty, or what came that belongs to none of them
};

/// Broadcast Ping at the line's present baud rate, each answer confirmed by a unicast Ping. Answers beyond the wanted
/// IDs are dropped.
Result<BaudScan> scanBaud(Bus &bus, const ScanRequest &wanted, const ScanHooks &hooks = {});

/// Reads `span` of one device again and again, with `between` in between. Why it may be two of them; empty: no sign, or
/// it answers no Read, asked twice. Two reads where nothing is wrong; six until it is called doubtful: noise damages one
/// of them, two devices nearly all.
Result<QString> compareReads(
    Bus &bus, const Found &device, const VolatileSpan &span, const std::function<Result<void>()> &between);

} // namespace dynascope
