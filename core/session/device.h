// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/poll_values.h"
#include "core/bus/scan.h"
#include "core/table/controltable.h"

#include <QObject>

namespace dynascope {

class LineSession;
using DeviceKey = quint32; ///< our own number of a device; stays when its ID, baud or line changes

enum class FieldState {
    Unknown, ///< never read
    Fresh,
    Stale,   ///< read, but too long ago for what it is, or the device is gone
    Pending, ///< a write is on its way; value() is still the old one
    Failed,  ///< the last read or write failed; FieldValue::error says why
};

/// One register as last seen.
struct FieldValue {
    std::optional<std::int64_t> raw; ///< what the servo said last
    LineTime at{};                   ///< when
    FieldState state = FieldState::Unknown;
    std::optional<std::int64_t> pending; ///< what is being written
    std::optional<std::int64_t> unconfirmed; ///< was sent, and nothing was read since: raw may hold no more
    QString error;
};

/// A servo: who it is, where it is, its register image. GUI thread, owned by its LineSession. Changes only through
/// Session's commands and what the bus brings.
class Device : public QObject
{
    Q_OBJECT

public:
    enum class State {
        Present, ///< answers at the line's working baud
        Parked,  ///< on another baud of this line: stands in the tree, isn't polled
        Silent,  ///< does not answer any more
        Rebooting,
    };

    /// `line` owns it; none in tests of what only shows a device.
    Device(DeviceKey key, LineSession *line, ControlTablePtr table, const Found &found);

    DeviceKey key() const { return m_key; }
    LineSession *line() const { return m_line; }
    const Found &found() const { return m_found; }
    const ControlTable &table() const { return *m_table; } ///< of an unknown model: bare bytes
    const ControlTablePtr &sharedTable() const { return m_table; } ///< for who may outlive the device
    bool isFirmwareNewerThanKnown() const { return m_table->isNewerThanKnown(m_found.firmware); }
    bool isKnownModel() const { return !m_table->description().isRaw; }
    QString model() const { return m_table->model(); }
    std::uint8_t id() const { return m_found.id; }
    int baudRate() const { return m_found.baudRate; }
    int firmware() const { return m_found.firmware; }
    int modelNumber() const { return m_found.modelNumber; }
    QString doubt() const { return m_found.doubt; }
    QString nickname() const { return m_nickname; }
    QString displayName() const; ///< nickname, else "XM430-W350 #3"
    State state() const { return m_state; }
    LineTime lastHeard() const { return m_lastHeard; }
    bool alert() const { return m_alert; }
    bool answersOnlyPing() const { return m_answersOnlyPing; } ///< while Silent: it is there, but no Read is answered
    Traits traits() const;

    const FieldValue &value(int fieldIndex) const { return m_values[static_cast<std::size_t>(fieldIndex)]; }
    std::optional<std::int64_t> raw(QStringView fieldName) const;
    std::optional<std::int64_t> raw(Known field) const;
    EffectiveField effective(int fieldIndex) const;
    bool mayHaveTorqueOn() const; ///< it is on, or was turned on or off and nobody could read what came of it
    bool isTorqueOn() const { return raw(Known::TorqueEnable).value_or(0) == 1; }
    bool goalTurnsTorqueOn() const; ///< by its Drive Mode, where its firmware knows that
    /// Why the field can't be written now, a sentence; empty where it can. Silence is no reason: a device may be told to
    /// be silent (Status Return Level) and hear nevertheless. `insisting`: though nobody knows (Field::mayBeTried).
    QString lockReason(int fieldIndex, bool insisting = false) const;

    void setNickname(const QString &name);

    /// @name For LineSession and the commands
    /// @{
    void setFound(const Found &found);
    void setState(State state);
    void setAlert(bool alert);
    void setAnswersOnlyPing(bool onlyPing);
    void setHeard(LineTime at);
    /// Bytes that were read; a pending field stays pending, a failed one failed until its value moves; older news are
    /// dropped. Stale: the device was there then.
    void take(const PollValue &value, FieldState as = FieldState::Fresh);
    void takeReadBack(int fieldIndex, std::int64_t raw); ///< a job has just read this value back
    void setPending(int fieldIndex, std::int64_t raw);
    void clearPending(int fieldIndex);           ///< the write is over; take() what was read back
    void setFailed(int fieldIndex, const QString &error);
    void setUnconfirmed(int fieldIndex, std::int64_t sent, const QString &error); ///< failed, but may have been done
    void clearFailures();                        ///< somebody asked for everything anew
    void setAllStale();
    /// @}

signals:
    void fieldsChanged(int first, int last); ///< indices of the table's fields; merged by the receiver
    void attributesChanged();                ///< id, baud, state, alert, nickname

private:
    DeviceKey m_key;
    LineSession *m_line;
    ControlTablePtr m_table;
    Found m_found;
    QString m_nickname;
    State m_state = State::Present;
    bool m_alert = false;
    bool m_answersOnlyPing = false;
    LineTime m_lastHeard{};
    std::vector<FieldValue> m_values; ///< one per field of the table
};

} // namespace dynascope
