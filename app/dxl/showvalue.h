// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/dxl/arguments.h"
#include "app/dxl/device.h"
#include "app/dxl/output.h"

namespace dynascope::dxl {

/// "Present Position = 2048 (180.00 °)", or {"id":1,"field":"Present Position","address":132,"raw":2048,...}.
void showField(Output &output, Device &device, const Field &field, std::int64_t raw);
/// "132:4 = 2048", or {"id":1,"address":132,"length":4,"raw":2048}; more than four bytes as hexadecimal digits.
void showBytes(Output &output, const Device &device, const RegisterArgument &argument, const Bytes &bytes);

/// Prints the error; in a JSON array a place for the register it belongs to.
ExitCode showFailure(Output &output, const Device &device, const RegisterArgument &argument, const Error &error);

} // namespace dynascope::dxl
