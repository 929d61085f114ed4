// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/dxl/commands.h"
#include "app/dxl/showvalue.h"
#include "app/dxl/target.h"
#include "core/bus/operations.h"

#include <algorithm>

namespace dynascope::dxl {

namespace {

/// What is to be read of one device, and what came of it.
struct RegisterRead {
    Device *device = nullptr;
    std::vector<const Field *> fields; ///< nullptr where an address was given
    std::vector<Result<Bytes>> values; ///< as many as could be asked for
    bool silent = false;               ///< whoever is silent once would let each further register wait

    Span span(std::size_t i, const RegisterArgument &argument) const
    {
        const int address = fields[i] ? fields[i]->address : argument.address;
        const int length = fields[i] ? fields[i]->size : argument.length;
        return {device->id(), static_cast<std::uint16_t>(address), static_cast<std::uint16_t>(length)};
    }
};

/// One register of all devices, in a group read where they have it at the same place; who failed in the group is asked
/// alone.
Result<void> readRegister(const Work &work, std::vector<RegisterRead> &readings, std::size_t i)
{
    std::vector<RegisterRead *> asked;
    std::vector<Span> spans;
    for (RegisterRead &reading : readings) {
        if (reading.silent)
            continue;
        asked.push_back(&reading);
        spans.push_back(reading.span(i, work.options.registers[i]));
    }
    auto answers = readMany(work.bus, spans);
    if (!answers)
        return tl::unexpected(answers.error());
    for (std::size_t place = 0; place < asked.size(); ++place) {
        Result<ReadReply> &answer = (*answers)[place];
        if (!answer && spans.size() > 1 && answer.error().kind != ErrorKind::Refused)
            answer = read(work.bus, spans[place]);
        if (!answer && endsAll(answer.error()))
            return tl::unexpected(answer.error());
        asked[place]->silent = !answer && answer.error().kind != ErrorKind::Refused;
        asked[place]->values.push_back(answer ? Result<Bytes>(std::move(answer->data))
                                              : tl::unexpected(answer.error()));
    }
    return {};
}

ExitCode show(const Work &work, RegisterRead &reading)
{
    ExitCode code = ExitCode::Done;
    for (std::size_t i = 0; i < reading.values.size(); ++i) {
        const RegisterArgument &argument = work.options.registers[i];
        const Result<Bytes> &value = reading.values[i];
        if (!value) {
            // Who answered the Ping is at the right baud rate.
            const Error error =
                reading.device->isIdentified() ? value.error() : withAdvice(value.error(), work.options);
            code = showFailure(work.output, *reading.device, argument, error);
        } else if (reading.fields[i]) {
            const std::int64_t raw = rawFromBytes(*reading.fields[i], *value);
            reading.device->learn(*reading.fields[i], raw);
            showField(work.output, *reading.device, *reading.fields[i], raw);
        } else {
            showBytes(work.output, *reading.device, argument, *value);
        }
    }
    return code;
}

Result<RegisterRead> readingOf(Device &device, const std::vector<RegisterArgument> &registers)
{
    RegisterRead reading;
    reading.device = &device;
    for (const RegisterArgument &argument : registers) {
        const auto field = argument.isByAddress() ? Result<const Field *>(nullptr) : device.field(argument.field);
        if (!field)
            return tl::unexpected(field.error());
        reading.fields.push_back(*field);
    }
    return reading;
}

} // namespace

ExitCode readCommand(const Work &work)
{
    const std::vector<RegisterArgument> &registers = work.options.registers;
    const bool byAddress = std::ranges::all_of(registers, &RegisterArgument::isByAddress);
    Targets targets = findTargets(work, registers.size(), byAddress);
    if (targets.ended)
        return targets.code;
    std::vector<RegisterRead> readings;
    for (Device &device : targets.devices) {
        auto reading = readingOf(device, registers);
        if (!reading)
            return work.output.refuse(reading.error());
        readings.push_back(std::move(*reading));
    }
    ExitCode code = targets.code;
    for (std::size_t i = 0; i < registers.size(); ++i) {
        if (const auto done = readRegister(work, readings, i); !done) {
            code = work.output.fail(done.error());
            break;
        }
    }
    for (RegisterRead &reading : readings) {
        if (show(work, reading) != ExitCode::Done)
            code = ExitCode::Failed;
    }
    return code;
}

} // namespace dynascope::dxl
