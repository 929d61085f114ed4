// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/dxl/interrupt.h"
#include "core/bus/jobcontext.h"
#include "core/bus/messages.h"

namespace dynascope::dxl {

/// Lets a procedure run right here: there is nobody else on this line's thread to give way to. Ctrl-C ends it between
/// its exchanges, but not between the first and last write of a change of place.
class DirectJob final : public JobContext
{
public:
    explicit DirectJob(Bus &bus) : m_bus(bus) {}

    Bus &bus() override { return m_bus; }
    Result<void> checkpoint() override
    {
        return m_bus.isCancelled() ? Result<void>(tl::unexpected(messages::cancelled())) : Result<void>();
    }
    void post(std::function<void()> note) override { note(); }

protected:
    void enterExclusive() override { m_bus.setCancel(nullptr); }
    void leaveExclusive() override { m_bus.setCancel(&interrupted()); }

private:
    Bus &m_bus;
};

} // namespace dynascope::dxl
