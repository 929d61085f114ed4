// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/session.h"

namespace dynascope {

/// What a person can do to a device. Each checks first, queues one job, and brings Device up to date with what the servo
/// said. The outcome comes through `done`, if given, and failed() on the GUI thread. Never turns torque on by itself.
class Commands : public QObject
{
    Q_OBJECT

public:
    using Done = std::function<void(Result<void>)>;

    explicit Commands(Session &session, QObject *parent = nullptr);

    /// Writes a raw value and reads the register back. A write to the same field that still waits is replaced, so a slider
    /// may call this as often as it likes.
    void writeField(Device &device, int fieldIndex, std::int64_t raw, Done done = {});
    void readAll(Device &device, Done done = {});
    void setTorque(const std::vector<Device *> &devices, bool on, Done done = {});
    void setLed(Device &device, bool on, Done done = {});
    void reboot(Device &device, Done done = {});
    void factoryReset(Device &device, ResetOption option, Done done = {});
    void clearMultiTurn(Device &device, Done done = {});
    void ping(Device &device, Done done = {});

    /// Refused before the first write where it can't end well: ID taken, baud not offered by model or port. A failure says
    /// where the device is now. Torque must be off, or `turnTorqueOff` be set.
    void changeId(Device &device, int newId, bool turnTorqueOff, Done done = {});
    void changeBaud(Device &device, int newBaud, bool turnTorqueOff, Done done = {});
    /// The line itself: "work at this baud". Devices elsewhere are parked.
    void workAtBaud(LineSession &line, int baudRate, Done done = {});

    /// While STOP holds, torque-on and goal writes are refused.
    void setStopped(bool stopped) { m_stopped = stopped; }
    bool isStopped() const { return m_stopped; }

signals:
    void succeeded(dynascope::Device *device, const QString &what); ///< for actions a person should hear of
    void failed(dynascope::Device *device, const dynascope::Error &error);

private:
    Session &m_session;
    bool m_stopped = false;
};

} // namespace dynascope
