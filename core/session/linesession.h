// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/busthread.h"
#include "core/session/device.h"

namespace dynascope {

class Catalog;

/// An open line with the devices known on it. GUI thread; owned by Session.
class LineSession : public QObject
{
    Q_OBJECT

public:
    LineSession(std::unique_ptr<BusThread> thread, const Catalog &catalog, QObject *parent = nullptr);
    ~LineSession() override;

    QString name() const { return m_thread->name(); }
    BusThread &bus() const { return *m_thread; }
    BusThread::State state() const { return m_thread->state(); }
    int baudRate() const { return m_thread->baudRate(); }

    /// In the order of baud rate and ID.
    const std::vector<std::unique_ptr<Device>> &devices() const { return m_devices; }
    Device *device(DeviceKey key) const;
    Device *deviceAt(std::uint8_t id, int baudRate) const;

    /// A scan or an operation saw this; makes the device or brings it up to date.
    Device &heard(const Found &found);
    void forget(DeviceKey key);

    /// Full-rate cycles a second over the last second; 0 while nothing is watched at full rate.
    double cycleRate() const { return m_cycleRate; }
    double busLoad() const { return m_busLoad; } ///< 0..1: part of the last second spent in exchanges

signals:
    void deviceAdded(dynascope::Device *device);
    void deviceAboutToBeRemoved(dynascope::Device *device);
    void deviceChanged(dynascope::Device *device);
    void stateChanged();
    void batchTaken(const dynascope::Batch &batch); ///< after the devices have it
    void rateChanged();                             ///< cycle rate, bus load, statistics: about once a second

private:
    void takeBatches();

    std::unique_ptr<BusThread> m_thread;
    const Catalog &m_catalog;
    std::vector<std::unique_ptr<Device>> m_devices;
    double m_cycleRate = 0;
    double m_busLoad = 0;
};

} // namespace dynascope
