// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/deviceplace.h"

namespace dynascope {

/// Factory Resets of several devices of one line. Pure.
struct ResetMove {
    DevicePlace place, after;
};
/// In which order, so that each finds its place free. InvalidArgument, with the reason, where two would end at one
/// place, or one at a place of `others`, who are not reset.
Result<std::vector<std::size_t>> planResets(const std::vector<ResetMove> &resets, const std::vector<MovePlace> &others);

/// The devices in that order; all of one line. NotSupported where it isn't known where one of them would be afterwards.
Result<std::vector<Device *>> resetOrder(const std::vector<Device *> &devices, ResetOption option);

} // namespace dynascope
