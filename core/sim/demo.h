// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/sim/ptyserver.h"

namespace dynascope::sim {

class DemoScript;

/// The demo: a small arm of six servos at 1 Mbps, moved by a script inside the simulator (someone else's controller, as
/// far as the window knows), and one fresh XL330-M288 at 57 600, ID 1. The script lets go of a joint that the person
/// writes to, and of all of them once torque went off by the wire, until resume(). Destroy on the thread that made it.
class Demo
{
public:
    static Result<std::unique_ptr<Demo>> start(const Catalog &catalog); ///< `catalog` outlives the demo
    ~Demo();

    QString path() const;
    void resume(); ///< the script takes all joints again and turns their torque on
    PtyServer &server() { return *m_server; }

private:
    Demo() = default;
    std::shared_ptr<DemoScript> m_script; ///< works on the server's thread
    std::unique_ptr<PtyServer> m_server;
};

} // namespace dynascope::sim
