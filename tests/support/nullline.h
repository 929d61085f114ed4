// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/line.h"
#include "core/bus/poll_values.h"


/// A line that answers at once and costs next to nothing: each request gets the answer made for it the first time, as
/// soon as it has left. What remains is what bus and poller themselves take.
class NullLine final : public dynascope::Line
{
public:
    QString name() const override { return QStringLiteral("null"); }
    dynascope::LineTime now() const override { return m_now; }
    dynascope::Result<void> write(dynascope::ByteView packet) override;
    dynascope::Result<void> read(dynascope::Bytes &buffer, dynascope::LineTime deadline) override;
    void discardInput() override { m_waiting = nullptr; }
    int baudRate() const override { return 4'000'000; }
    dynascope::Result<void> setBaudRate(int) override { return {}; }
    dynascope::LineTime hostAllowance() const override { return {}; }

private:
    struct Known {
        dynascope::Bytes request, answer;
    };
    dynascope::LineTime m_now{}, m_at{};
    std::vector<Known> m_known;
    const dynascope::Bytes *m_waiting = nullptr;
};

/// So many devices with one span of that length each, read in every cycle.
dynascope::PollPlan nullPlan(int devices, int length, bool fast, bool group);
