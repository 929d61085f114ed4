// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/result.h"

#include <memory>
#include <optional>

namespace CLI {
class App;
}

namespace dynascope::dxl {

/// What `dxl sim` was told.
struct SimOptions {
    QString devices, busFile; ///< one of them
    QString faults;           ///< words
    QString link;
    std::optional<std::uint64_t> seed{};
    bool controlledByInput = false;
    // dxl sim ctl
    bool isControl = false;
    QString controlled; ///< link or terminal
    QString line;       ///< for its control channel
};

/// The part of the command line that is `dxl sim`.
class SimArguments
{
public:
    SimArguments();
    ~SimArguments();
    void describe(CLI::App &app);
    Result<SimOptions> understand() const; ///< what was parsed

private:
    struct Typed;
    std::unique_ptr<Typed> m_typed;
};

} // namespace dynascope::dxl
