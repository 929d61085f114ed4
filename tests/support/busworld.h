// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/busthread.h"
#include "tests/support/fakefactory.h"

#include <QStringList>

namespace dynascope {

/// An open line, and what its jobs came to.
struct BusWorld {
    /// `prepare` runs on the bus thread, before the line is used.
    explicit BusWorld(std::function<void(FakeLine &, FakeServos &)> prepare = {})
        : factory(std::move(prepare)), thread(factory, QStringLiteral("fake"), 1'000'000)
    {
    }
    JobId run(Priority priority, std::function<Result<int>(JobContext &)> job, QObject *context = nullptr)
    {
        return thread.run<int>(
            priority, context, std::move(job), [this](const Result<int> &result) { outcomes << text(result); });
    }
    static QString text(const Result<int> &result) { return result ? QString::number(*result) : result.error().text; }

    FakeFactory factory;
    QStringList outcomes;
    BusThread thread;
};

} // namespace dynascope
