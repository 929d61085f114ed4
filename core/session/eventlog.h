// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/session.h"

#include <deque>

namespace dynascope {

class Journal;
class RamGuard;

/// Something that happened to a device, at a moment of its line's clock.
struct LoggedEvent {
    enum class Kind { Restart, Alert, TorqueOn, TorqueOff, Write };
    LineTime at{};
    Kind kind = Kind::Write;
    DeviceKey device = 0;
    QString name; ///< the device's, then
    QString text; ///< a few words: "Goal Position: 2048 → 3000"

    friend bool operator==(const LoggedEvent &, const LoggedEvent &) = default;
};

/// What happened to the devices, for marks on plots: restarts, alerts, torque, and the writes of this program. The newest,
/// in the order of time. GUI thread.
class EventLog : public QObject
{
    Q_OBJECT

public:
    static constexpr std::size_t Most = 4000;

    /// All outlive this; the last two may be missing.
    EventLog(Session &session, const Journal *journal, const RamGuard *guard, QObject *parent = nullptr);

    const std::deque<LoggedEvent> &events() const { return m_events; }
    /// Index of the first at or after `at`; events().size() where there is none.
    std::size_t indexAt(LineTime at) const;
    void clear();
    /// These, in the order of time, and none that is seen from now on: a recording's.
    void showRecorded(std::deque<LoggedEvent> events);
    bool isRecorded() const { return m_isRecorded; }

signals:
    void added(const dynascope::LoggedEvent &event);

private:
    /// As last seen.
    struct Seen {
        bool isKnown = false;
        bool torque = false;
        bool alert = false;
        Device::State state = Device::State::Present;
    };

    void follow(Device *device);
    void lookAtTorque(const Device &device);
    void lookAtState(const Device &device);
    void onWritten(qint64 number);
    void add(const Device &device, LineTime at, LoggedEvent::Kind kind, const QString &text);

    Session &m_session;
    const Journal *m_journal;
    bool m_isRecorded = false;
    std::map<DeviceKey, Seen> m_seen;
    std::deque<LoggedEvent> m_events;
};

} // namespace dynascope
