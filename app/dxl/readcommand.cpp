// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/dxl/commands.h"
#include "app/dxl/showvalue.h"
#include "app/dxl/target.h"

namespace dynascope::dxl {

namespace {

/// One register, read and printed.
Result<void> readOne(Output &output, Device &device, const RegisterArgument &argument, const Field *field)
{
    if (!field) {
        const auto bytes = device.read(argument.address, argument.length);
        if (!bytes)
            return tl::unexpected(bytes.error());
        showBytes(output, device, argument, *bytes);
        return {};
    }
    const auto raw = device.read(*field);
    if (!raw)
        return tl::unexpected(raw.error());
    showField(output, device, *field, *raw);
    return {};
}

} // namespace

ExitCode readCommand(const Work &work)
{
    std::optional<Device> device = target(work, true);
    if (!device)
        return ExitCode::Failed;
    const std::vector<RegisterArgument> &registers = work.options.registers;
    std::vector<const Field *> fields; // nullptr where an address was given
    for (const RegisterArgument &argument : registers) {
        const auto field = argument.isByAddress() ? Result<const Field *>(nullptr) : device->field(argument.field);
        if (!field)
            return work.output.refuse(field.error());
        fields.push_back(*field);
    }
    ExitCode code = ExitCode::Done;
    for (std::size_t i = 0; i < registers.size(); ++i) {
        const auto done = readOne(work.output, *device, registers[i], fields[i]);
        if (done)
            continue;
        // Who answered the Ping is at the right baud rate.
        const Error error = device->isIdentified() ? done.error() : withAdvice(done.error(), work.options);
        code = showFailure(work.output, *device, registers[i], error);
        if (done.error().kind != ErrorKind::Refused)
            break; // whoever is silent once would let each further register wait
    }
    return code;
}

} // namespace dynascope::dxl
