// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace dynascope::test {

/// Whether this is built under sanitizers, where the same work takes a dozen times as long. What only adds certainty by
/// its amount is done less often then; every kind of it is still done.
#ifdef DYNASCOPE_SANITIZED
constexpr bool Sanitized = true;
#else
constexpr bool Sanitized = false;
#endif

} // namespace dynascope::test
