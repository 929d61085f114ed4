// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/bus_values.h"

namespace dynascope {

/// What of a request is worth asking again.
struct Remainder {
    Request request;
    std::vector<std::size_t> indices; ///< of the original request's replies, in the order of the new one
};

/// The request for those replies that failed for another reason than a refusal; nothing where none did. In a group read
/// the device that broke the chain goes last, so that it can't break it for the others again.
Remainder remainderOf(const Request &request, const ExchangeResult &result);

/// Puts what the remainder brought where it belongs in `total`.
void merge(ExchangeResult &total, ExchangeResult again, const std::vector<std::size_t> &indices);

} // namespace dynascope
