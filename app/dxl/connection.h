// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/bus.h"

#include <memory>

namespace dynascope {
class Catalog;
class LineFactory;
namespace sim {
class Demo;
}
}

namespace dynascope::dxl {

struct Options;

/// An open line and its bus, and behind the port "sim" the demo that is served there. One thread. What waits on the bus
/// ends with Cancelled once somebody interrupts.
class Connection
{
public:
    /// `catalog` outlives the connection.
    static Result<std::unique_ptr<Connection>> open(const Catalog &catalog, const Options &options);
    ~Connection();

    Bus &bus() { return m_bus; }

private:
    Connection(std::unique_ptr<Line> line, std::unique_ptr<sim::Demo> demo);

    std::unique_ptr<sim::Demo> m_demo; ///< outlives the line
    std::unique_ptr<Line> m_line;
    Bus m_bus;
};

/// Text with what to try next where a device was silent.
Error withAdvice(const Error &error, const Options &options);

} // namespace dynascope::dxl
