// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QTimer>

#include <cstdint>
#include <functional>
#include <optional>

namespace dynascope {

/// At most 30 writes a second of what may change far more often; the last value is always sent.
class WriteThrottle : public QObject
{
    Q_OBJECT

public:
    static constexpr int IntervalMs = 34;

    explicit WriteThrottle(std::function<void(std::int64_t)> send, QObject *parent = nullptr);

    void submit(std::int64_t raw);
    bool isWaiting() const { return m_waiting.has_value(); } ///< something is still to be sent
    void drop() { m_waiting.reset(); }

private:
    void next();

    std::function<void(std::int64_t)> m_send;
    QTimer m_timer; ///< runs for an interval after each write
    std::optional<std::int64_t> m_waiting;
};

} // namespace dynascope
