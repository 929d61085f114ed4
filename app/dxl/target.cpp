// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/dxl/target.h"

#include <algorithm>

namespace dynascope::dxl {

std::optional<Device> target(const Work &work, bool onlyIfNamed)
{
    const std::vector<RegisterArgument> &registers = work.options.registers;
    if (registers.size() > 1)
        work.output.expectMany();
    Device device(work.bus, work.options.id);
    if (onlyIfNamed && std::ranges::all_of(registers, &RegisterArgument::isByAddress))
        return device;
    if (const auto known = device.identify(work.catalog); !known) {
        work.output.fail(withAdvice(known.error(), work.options));
        return std::nullopt;
    }
    return device;
}

} // namespace dynascope::dxl
