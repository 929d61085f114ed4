// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/sim/pacing.h"
#include "core/sim/simulatedbus.h"

#include <QString>

#include <functional>
#include <memory>

namespace dynascope::sim {

/// Serves a simulated bus on a pseudo-terminal from a thread of its own, paced by the wall clock, so that any DYNAMIXEL
/// program opens it as its serial port. Created and destroyed on one thread; post() from any.
class PtyServer
{
public:
    /// The bus belongs to the server's thread from now on. `link`: also a symbolic link there, removed at the end; an
    /// existing one is replaced only if it leads to a pseudo-terminal, as one does that was left behind. `onTick` runs on
    /// that thread about every 10 ms. `onPacing` too, with a sentence when the machine falls behind the wire's pace or
    /// keeps up again.
    static Result<std::unique_ptr<PtyServer>> start(std::unique_ptr<SimulatedBus> bus, const QString &link = {},
                                                    std::function<void(SimulatedBus &, LineTime)> onTick = {},
                                                    std::function<void(const QString &)> onPacing = {});
    ~PtyServer();

    /// Of the terminal a client opens: "/dev/pts/7". Unplugged by the bus's faults, it is gone; plugged in again, it
    /// may have another name, and only `link` leads there.
    QString path() const;

    /// Runs `change` on the server's thread, between packets.
    void post(std::function<void(SimulatedBus &, LineTime now)> change);
    /// As post(), and waits for it. Not from the server's own thread. For tests and control channels.
    void call(std::function<void(SimulatedBus &, LineTime now)> change);

    /// How it goes. On the server's thread only: in what post() and call() run.
    struct State {
        QString path; ///< of the terminal now; empty while it is unplugged
        Pacing::Report pacing;
    };
    State state() const;

private:
    PtyServer();
    class Worker;
    std::unique_ptr<Worker> m_worker;
};

} // namespace dynascope::sim
