// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/dxl/dxl.h"

#include "app/dxl/commands.h"

namespace dynascope::dxl {

namespace {

ExitCode perform(const Options &options, Output &output)
{
    const auto catalog = Catalog::builtIn();
    if (!catalog)
        return output.fail(catalog.error());
    if (options.command == Command::Sim)
        return simCommand(*catalog, options, output);

    const auto connection = Connection::open(options);
    if (!connection)
        return output.fail(connection.error());
    const Work work{options, *catalog, (*connection)->bus(), output};
    switch (options.command) {
    case Command::Scan: return scanCommand(work);
    case Command::Ping: return pingCommand(work);
    case Command::Read: return readCommand(work);
    case Command::Write: return writeCommand(work);
    case Command::Stats: return statsCommand(work);
    case Command::Sim: break;
    }
    return ExitCode::Usage;
}

} // namespace

int run(int argc, const char *const *argv)
{
    const auto options = parseOptions(argc, argv);
    if (!options)
        return static_cast<int>(options.error());
    Output output(options->json);
    const ExitCode code = perform(*options, output);
    output.finish();
    return static_cast<int>(code);
}

} // namespace dynascope::dxl
