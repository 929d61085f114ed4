// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/dxl/device.h"

#include <functional>
#include <optional>

namespace dynascope::dxl {

/// One register of a device as it was read, or why it could not be.
struct Reading {
    const Field *field = nullptr;
    std::optional<std::int64_t> raw;
    QString error; ///< where there is no value
};

/// Reads the wanted fields, neighbours together; where a stretch of them is refused, one by one. `progress` is told how
/// far it is, 0 to 1. Fails where the device falls silent.
Result<std::vector<Reading>> readFields(Device &device, const std::function<bool(const Field &)> &wanted,
                                        const std::function<void(double)> &progress);

} // namespace dynascope::dxl
