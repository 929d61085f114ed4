// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/result.h"

#include <memory>
#include <optional>
#include <vector>

namespace CLI {
class App;
}

namespace dynascope::dxl {

/// What `dxl move` was told.
struct MoveOptions {
    std::vector<std::pair<int, int>> ids; ///< old, new
    std::optional<int> toBaud;            ///< bits per second
    std::vector<std::uint8_t> movers;     ///< of toBaud; empty: everybody who is found
    bool turnTorqueOff = false;
    bool dryRun = false;
    bool resume = false, forget = false;
};

/// The part of the command line that is `dxl move`.
class MoveArguments
{
public:
    MoveArguments();
    ~MoveArguments();
    void describe(CLI::App &app);
    Result<MoveOptions> understand() const; ///< what was parsed

private:
    struct Typed;
    std::unique_ptr<Typed> m_typed;
};

} // namespace dynascope::dxl
