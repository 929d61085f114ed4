// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/linefactory.h"
#include "tests/support/fakeservos.h"

/// Hands out one FakeLine with servos 1, 2, 3 at 1 Mbps that hold their ID at 132. Look at `log` only after the bus
/// thread has been closed.
class FakeFactory final : public dynascope::LineFactory
{
public:
    using Prepare = std::function<void(FakeLine &, FakeServos &)>;

    /// `prepare` runs on the bus thread, before the line is used.
    explicit FakeFactory(Prepare prepare = {}) : m_prepare(std::move(prepare)) { }

    bool knows(const QString &name) const override { return name == QLatin1String("fake"); }
    dynascope::Result<std::unique_ptr<dynascope::Line>> open(const QString &name, int baudRate) override;

    std::shared_ptr<std::vector<FakeLine::Sent>> log = std::make_shared<std::vector<FakeLine::Sent>>();

private:
    const Prepare m_prepare;
    std::unique_ptr<FakeServos> m_servos;
};
