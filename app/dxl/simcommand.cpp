// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/dxl/commands.h"
#include "app/dxl/interrupt.h"
#include "core/sim/ptyserver.h"

#include <cstdio>

namespace dynascope::dxl {

ExitCode simCommand(const Catalog &catalog, const Options &options, Output &output)
{
    Interrupt interrupt; // before the server's thread begins
    const auto specs = sim::parseServoSpecs(options.devices, catalog);
    if (!specs)
        return output.refuse(specs.error());
    auto bus = std::make_unique<sim::SimulatedBus>(catalog);
    for (const sim::ServoSpec &spec : *specs) {
        if (const auto servo = bus->add(spec); !servo)
            return output.refuse(servo.error());
    }
    const auto server = sim::PtyServer::start(std::move(bus), options.link);
    if (!server)
        return output.fail(server.error());
    std::printf("%s\n", qUtf8Printable((*server)->path()));
    std::fflush(stdout);
    interrupt.wait();
    return ExitCode::Done;
}

} // namespace dynascope::dxl
