// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/sim/control.h"
#include "core/sim/controlsocket.h"
#include "core/sim/ptyserver.h"

namespace dynascope::sim {

/// Takes the lines of a control channel from a local socket, and from a pair of files if wanted, to the bus's thread, and
/// the answers back, from a thread of its own. Created and destroyed on one thread, before the server goes.
class ControlChannel
{
public:
    struct Settings {
        std::unique_ptr<ControlSocket> socket{}; ///< may be none
        int input = -1, output = -1; ///< also lines from here, their answers there; not closed
        QStringList names{};         ///< of the devices
        std::function<void()> quit{}; ///< on the server's thread
    };
    /// `server` outlives it.
    static Result<std::unique_ptr<ControlChannel>> start(PtyServer &server, Settings settings);
    ~ControlChannel();

private:
    ControlChannel() = default;
    class Worker;
    std::unique_ptr<Worker> m_worker;
};

} // namespace dynascope::sim
