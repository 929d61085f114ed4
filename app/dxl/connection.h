// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/bus.h"

#include <memory>

namespace dynascope::dxl {

struct Options;

/// An open line and its bus. One thread.
class Connection
{
public:
    static Result<std::unique_ptr<Connection>> open(const Options &options);

    Bus &bus() { return m_bus; }

private:
    explicit Connection(std::unique_ptr<Line> line);

    std::unique_ptr<Line> m_line;
    Bus m_bus;
};

/// Text with what to try next where a device was silent.
Error withAdvice(const Error &error, const Options &options);

} // namespace dynascope::dxl
