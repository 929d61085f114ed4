// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/deviceplace.h"
#include "core/session/journal/journalnote.h"
#include "core/session/session.h"

#include <map>
#include <memory>

namespace dynascope {

/// What a person can do to a device. Each checks first, queues one job, and brings Device up to date with what the servo
/// said. The outcome comes through `done`, if given, and failed() on the GUI thread. Never turns torque on by itself.
/// Every write is in the journal, where there is one.
class Commands : public QObject
{
    Q_OBJECT

public:
    using Done = std::function<void(Result<void>)>;

    /// `session` and `journal` outlive this.
    explicit Commands(Session &session, Journal *journal = nullptr, QObject *parent = nullptr);

    Journal *journal() const { return m_journal; }

    /// Writes a raw value and reads the register back. While one write to a field is on its way the newest of those that
    /// follow waits and the others end Cancelled, so a slider may call this as often as it likes.
    void writeField(Device &device, int fieldIndex, std::int64_t raw, Done done = {});
    /// The same for a register of which nobody knows whether it may be written, or what it does: only where a person,
    /// told so, insists. Refused while STOP holds, for it may be a goal.
    void writeUnknown(Device &device, int fieldIndex, std::int64_t raw, Done done = {});
    void readAll(Device &device, Done done = {});
    void setTorque(const std::vector<Device *> &devices, bool on, Done done = {});
    void setLed(Device &device, bool on, Done done = {}); ///< identifyField(), a colour as bright as it gets
    void reboot(Device &device, Done done = {});
    void factoryReset(Device &device, ResetOption option, Done done = {});
    /// One after the other, each found again before the next; refused before the first where two would end at one place.
    /// The outcome is the first failure; the others are reset nevertheless, unless STOP or the line ended it.
    void factoryReset(const std::vector<Device *> &devices, ResetOption option, Done done = {});
    /// Control Table Backup: the device's own. A restore restarts it; where it then has another ID or baud rate, it is
    /// only found by a scan.
    void controlTableBackup(Device &device, BackupOption option, Done done = {});
    void clearMultiTurn(Device &device, Done done = {});
    void ping(Device &device, Done done = {});

    /// Refused before the first write where it can't end well: ID taken, baud not offered by model or port. A failure says
    /// where the device is now. Torque must be off, or `turnTorqueOff` be set.
    void changeId(Device &device, int newId, bool turnTorqueOff, Done done = {});
    /// Where the device was the only one at the line's baud rate the line follows it, else it is parked.
    void changeBaud(Device &device, int newBaud, bool turnTorqueOff, Done done = {});
    /// The line itself: "work at this baud". Devices elsewhere are parked. Refused where the port can't do it.
    void workAtBaud(LineSession &line, int baudRate, Done done = {});

    /// Another part of the program has moved it, and found it there.
    void moved(DeviceKey key, const Found &found);

    /// While STOP holds, torque-on and goal writes are refused.
    void setStopped(bool stopped) { m_stopped = stopped; }
    bool isStopped() const { return m_stopped; }

signals:
    void succeeded(dynascope::Device *device, const QString &what); ///< for actions a person should hear of
    /// `device` may be null: of a line. Where `field` is one of its fields, that field says the same (Device::value).
    void failed(dynascope::Device *device, const dynascope::Error &error, int field = -1);

private:
    using FieldKey = std::pair<DeviceKey, int>;
    struct Waiting {
        std::int64_t raw = 0;
        bool insisting = false;
        Done done;
    };

    void write(Device &device, int fieldIndex, std::int64_t raw, bool insisting, Done done);

    Result<void> checkWrite(const Device &device, int fieldIndex, std::int64_t raw, bool insisting) const;
    void sendWrite(Device &device, int fieldIndex, std::int64_t raw, Done done);
    void finishWrite(DeviceKey key, int fieldIndex, std::int64_t raw, const Result<std::vector<PollValue>> &values,
                     const Done &done);
    struct TorqueJob;
    void finishTorque(const TorqueJob &job, const Result<std::vector<WrittenField>> &results);
    JournalNote noteWrite(const Device &device, const Field &field, std::int64_t raw,
                          const std::vector<const Field *> &affected = {}) const;
    JournalNote noteMove(const Device &device, const Field &field, std::int64_t raw, bool turnTorqueOff) const;
    JournalNote noteEvent(const Device &device, JournalKind kind, const QString &what = {}) const;
    void refuse(Device *device, const Error &error, const Done &done, int field = -1);
    Done reporting(Device &device, const QString &success, Done done);
    void runAt(Device &device, std::function<Result<void>(Bus &)> operation, Done done);
    void awaitReturn(DeviceKey key, const DevicePlace &from, const DevicePlace &to, int attempts, Done done);
    void finishReturn(Device &device, const DevicePlace &from, const DevicePlace &to, const Found &found,
                      const Done &done);
    void finishChange(DeviceKey key, const DevicePlace &from, const DevicePlace &to, const Result<Found> &found,
                      JournalNote note, const Done &report);
    struct Resets;
    void resetNext(const std::shared_ptr<Resets> &resets);
    void lookAgain(DeviceKey key, const DevicePlace &from, const DevicePlace &to, const JournalNote &note,
                   const Done &report);

    Session &m_session;
    Journal *m_journal;
    bool m_stopped = false;
    std::map<FieldKey, std::optional<Waiting>> m_writes; ///< on their way, each with the newest that waits behind it
};

/// The register that Identify switches: LED or, where each colour has one, LED Blue (red is the alarm's); −1: none.
int identifyField(const ControlTable &table);

/// Of the device's table.
std::vector<Span> spansOf(const Device &device, const std::function<bool(const Field &)> &wanted, int longest = 128);

} // namespace dynascope
