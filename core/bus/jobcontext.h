// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/bus.h"

#include <functional>

namespace dynascope {

enum class Priority { Scan, Normal, Click }; ///< a waiting job of higher priority runs at the next checkpoint

/// What a job may use. Bus thread, only while the job runs.
class JobContext
{
public:
    virtual ~JobContext() = default;

    virtual Bus &bus() = 0;

    /// Between exchanges: lets waiting jobs of higher priority run, puts this job's baud rate back, and says whether to
    /// go on: Cancelled, Stopped, PortLost.
    virtual Result<void> checkpoint() = 0;

    /// Runs `note` on the GUI thread if the job's context object still lives there. For progress.
    virtual void post(std::function<void()> note) = 0;

    /// While one is held, only STOP and closing get in: between the first and last write of an ID or baud change.
    class Exclusive
    {
    public:
        explicit Exclusive(JobContext &context) : m_context(context) { m_context.enterExclusive(); }
        ~Exclusive() { m_context.leaveExclusive(); }
        Exclusive(const Exclusive &) = delete;
        Exclusive &operator=(const Exclusive &) = delete;

    private:
        JobContext &m_context;
    };

protected:
    virtual void enterExclusive() = 0;
    virtual void leaveExclusive() = 0;
};

using JobId = quint64;

/// With a context: runs the job and returns its delivery. Without: the delivery of `refusal`.
using ErasedJob = std::function<std::function<void()>(JobContext *, const Error &refusal)>;

} // namespace dynascope
