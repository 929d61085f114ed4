// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/dxl/arguments.h"
#include "app/dxl/device.h"
#include "app/dxl/output.h"

namespace dynascope::dxl {

QString areaName(Area area);       ///< "EEPROM"; "?" where it isn't known
QString accessName(Access access); ///< "R", "RW"; "?" where it isn't known

/// {"id":1,"field":"Present Position","address":132,"raw":2048,"value":180.0,"unit":"deg"}
Document fieldDocument(const Device &device, const Field &field, const EffectiveField &units, std::int64_t raw);
/// "Present Position = 2048 (180.00 °)", or that document.
void showField(Output &output, Device &device, const Field &field, std::int64_t raw);
/// "132:4 = 2048", or {"id":1,"address":132,"length":4,"raw":2048}; more than four bytes as hexadecimal digits.
void showBytes(Output &output, const Device &device, const RegisterArgument &argument, const Bytes &bytes);

/// Says that the value was sent, and why that is all; {"id":1,"field":"LED","address":65,"sent":1,"confirmed":false}.
void showSent(Output &output, const Device &device, const Field *field, const RegisterArgument &argument,
              const Bytes &bytes);

/// Prints the error, behind it `aftermath` (what was done before it, if anything); in a JSON array a place for the
/// register it belongs to.
ExitCode showFailure(Output &output, const Device &device, const RegisterArgument &argument, const Error &error,
                     const QString &aftermath = {});
/// The error of a device that can't be read for its Status Return Level, with the way out; every other as it is.
Error withWayOut(const Error &error, const Device &device);

} // namespace dynascope::dxl
