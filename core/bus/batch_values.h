// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/poll_values.h"

#include <algorithm>

namespace dynascope {

/// Did all of this value come in the same reply as a longer one, or one before it? Who keeps samples keeps it once: a
/// reply that answers two spans of the plan stands in the batch for both. Any thread.
inline bool standsInAnother(const Batch &batch, const PollValue &value)
{
    return !value.data.empty() && std::ranges::any_of(batch.values, [&value](const PollValue &other) {
        const bool holds = other.device == value.device && other.at == value.at && other.address <= value.address
            && other.address + other.data.size() >= value.address + value.data.size();
        return holds && (other.data.size() > value.data.size() || &other < &value);
    });
}

} // namespace dynascope
