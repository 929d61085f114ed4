// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/line.h"
#include "tests/fuzz/fuzzinput.h"

#include <deque>

namespace fuzz {

/// A line in virtual time whose answers the input dictates. To each request: pieces until a 0 (see answer()); silence
/// once the input has ended. Delays add up, bytes keep their order.
class DictatedLine final : public dynascope::Line
{
public:
    using LineTime = dynascope::LineTime;

    explicit DictatedLine(Input &input);

    QString name() const override { return QStringLiteral("dictated"); }
    LineTime now() const override { return m_now; }
    dynascope::Result<void> write(ByteView packet) override;
    dynascope::Result<void> read(Bytes &buffer, LineTime deadline) override;
    void discardInput() override;
    int baudRate() const override { return 1'000'000; }
    dynascope::Result<void> setBaudRate(int) override { return {}; }
    LineTime hostAllowance() const override { return m_allowance; }

    /// All bytes that were read since the last call, in order.
    Bytes takeDelivered() { return std::exchange(m_delivered, {}); }

private:
    void answer(const Bytes &request);
    Bytes piece(int kind, const Bytes &request);
    void send(const Bytes &bytes);

    Input &m_input;
    LineTime m_allowance;
    LineTime m_now{};
    LineTime m_wireFree{};
    std::deque<std::pair<LineTime, std::uint8_t>> m_arrivals;
    Bytes m_delivered;
    bool m_echo;
    bool m_lost = false;
};

} // namespace fuzz
