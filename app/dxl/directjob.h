// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/busthread.h"

namespace dynascope::dxl {

/// Lets a procedure run right here: there is nobody else on this line's thread to give way to.
class DirectJob final : public JobContext
{
public:
    explicit DirectJob(Bus &bus) : m_bus(bus) {}

    Bus &bus() override { return m_bus; }
    Result<void> checkpoint() override { return {}; }
    void post(std::function<void()> note) override { note(); }

protected:
    void enterExclusive() override {}
    void leaveExclusive() override {}

private:
    Bus &m_bus;
};

} // namespace dynascope::dxl
