// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/dxl/commands.h"
#include "app/dxl/device.h"

#include <deque>
#include <functional>

namespace dynascope::dxl {

/// The devices that a command names, as far as they answered.
struct Targets {
    std::deque<Device> devices;
    ExitCode code = ExitCode::Done; ///< Failed where one of them did not answer, which has been said
    bool ended = false;             ///< the line is gone, or somebody interrupted

    bool areAll() const { return code == ExitCode::Done; }
};

/// A result for each device and each of `results` of it, and the devices by their Ping, unless `blind`: then they are
/// only named.
Targets findTargets(const Work &work, std::size_t results, bool blind = false);

/// Carries `action` out on each device of the command, once it has said what it is. Failures are printed, and take a
/// place in the JSON.
/// `before` sees all of them first: where it fails, nothing is done.
ExitCode forEachDevice(const Work &work, const std::function<Result<void>(Device &)> &action,
                       const std::function<Result<void>(const std::deque<Device> &)> &before = {});

/// Prints why something failed with a device; in a JSON array a place for it.
void showDeviceFailure(const Work &work, std::uint8_t id, const Error &error);

} // namespace dynascope::dxl
