// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/dxl/modelsarguments.h"
#include "app/dxl/output.h"
#include "core/table/catalog.h"

namespace CLI {
class App;
}

namespace dynascope::dxl {

void describeModels(CLI::App &app, ModelsArguments &typed);

/// The library of control tables: needs no line.
ExitCode modelsCommand(const Catalog &catalog, const ModelsArguments &arguments, Output &output);
/// The registers of the model that `text`, MODEL[/FIRMWARE], names.
ExitCode showModel(const Catalog &catalog, const QString &text, Output &output);

} // namespace dynascope::dxl
