// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/vitals.h"

#include <QDateTime>

#include <deque>
#include <map>

namespace dynascope {

enum class AlarmKind { Error, Silent, Temperature, OverVoltage, UnderVoltage, Load };
constexpr int AlarmKindCount = 6;

/// How bad something is; more is worse.
enum class AlarmLevel {
    None,
    Near, ///< close to its limit
    Over, ///< at it or beyond
};

/// One episode: from when something was out of bounds until it was well within them again.
struct Alarm {
    quint64 number = 0; ///< counts from 1
    DeviceKey device = 0;
    QString name; ///< of the device, then
    AlarmKind kind = AlarmKind::Error;
    AlarmLevel level = AlarmLevel::Near; ///< the worst it was
    QString cause; ///< in words, of the moment at which it reached that level: "82 °C, its Temperature Limit is 80 °C"
    QDateTime raised;
    QDateTime cleared;       ///< invalid: it lasts
    bool deviceWent = false; ///< it ended because nobody looks at the device any more

    bool isActive() const { return !cleared.isValid(); }
};

/// Raises and clears alarms of what devices say: a value that is beyond a threshold at two readings some time apart
/// raises, one that has been well inside for a while clears, so that nothing flaps. What isn't known changes nothing.
/// Knows no clock but what it is told. Any one thread.
class Alarms
{
public:
    static constexpr std::size_t Most = 1000; ///< of the list; the oldest go, those that are over first

    struct Now {
        LineTime at{};  ///< of any clock that goes on
        QDateTime wall; ///< for the list
    };
    struct Subject {
        DeviceKey device = 0;
        QString name;
    };

    /// How a device is now. True where something of the list changed.
    bool take(const Subject &subject, const Vitals &vitals, const Now &now);
    /// Nobody looks at it any more; what it had is over.
    bool remove(DeviceKey device, const QDateTime &wall);
    void clearEnded(); ///< out of the list

    const std::deque<Alarm> &list() const { return m_list; } ///< the oldest first
    const Alarm *find(quint64 number) const;
    AlarmLevel level(DeviceKey device, AlarmKind kind) const; ///< with hysteresis
    AlarmLevel level(DeviceKey device) const;                 ///< the worst
    std::size_t active() const;                               ///< how many last

private:
    /// One kind of one device: what it is, and what it may become.
    struct State {
        AlarmLevel level = AlarmLevel::None;
        AlarmLevel next = AlarmLevel::None;
        LineTime since{};  ///< `next` has been so since; where it isn't `level`
        LineTime latest{}; ///< of the last reading
        quint64 alarm = 0; ///< in the list; 0: none
    };
    using States = std::array<State, AlarmKindCount>;
    struct Wanted {
        AlarmLevel level = AlarmLevel::None;
        LineTime at{};
        QString cause;
    };

    bool follow(const Subject &subject, AlarmKind kind, State &state, const Wanted &wanted, const Now &now);
    void raise(const Subject &subject, AlarmKind kind, State &state, const Wanted &wanted, const Now &now);
    bool end(State &state, const QDateTime &wall, bool deviceWent);
    Alarm *entry(quint64 number);
    void bound();

    std::map<DeviceKey, States> m_states;
    std::deque<Alarm> m_list;
    quint64 m_last = 0;
};

/// What a kind is called: "Temperature".
QString alarmKindText(AlarmKind kind);

} // namespace dynascope
