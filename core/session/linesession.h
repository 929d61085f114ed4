// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/busthread.h"
#include "core/session/devicekeys.h"
#include "core/session/linehealth.h"
#include "core/session/packedreads.h"
#include "core/session/pollforesight.h"

#include <QElapsedTimer>
#include <QTimer>

#include <map>

namespace dynascope {

class Catalog;

/// An open line with the devices known on it. GUI thread; owned by Session.
class LineSession : public QObject
{
    Q_OBJECT

public:
    /// `factory`, `catalog` and `keys` outlive this.
    LineSession(LineFactory &factory, const QString &name, int baudRate, const Catalog &catalog, DeviceKeys &keys,
                QObject *parent = nullptr);
    ~LineSession() override;

    QString name() const { return m_thread->name(); }
    BusThread &bus() const { return *m_thread; } ///< another one after reopen()
    int generation() const { return m_generation; } ///< counts the bus threads; a new one may stand at the old address
    /// A lost line once more, keeping its devices; under another name where its adapter came up elsewhere.
    void reopen(const QString &name = {});
    /// Ends the bus thread. Everything that was asked of it gets its answer, even if that is Cancelled, before this
    /// returns.
    void close();
    BusThread::State state() const { return m_thread->state(); }
    int baudRate() const { return m_thread->baudRate(); }
    const Catalog &catalog() const { return m_catalog; }
    bool isRecorded() const { return m_factory.isRecorded(); } ///< nothing can be asked: it shows what was
    void show(Batch batch); ///< of a recording, as if the poller had brought it

    const std::vector<std::unique_ptr<Device>> &devices() const { return m_devices; } ///< by baud rate and ID
    Device *device(DeviceKey key) const;
    Device *deviceAt(std::uint8_t id, int baudRate) const;

    /// A scan or an operation saw this; makes the device or brings it up to date.
    Device &heard(const Found &found);
    /// The same device now stands elsewhere: ID or baud rate changed, or it was reset.
    void moveDevice(Device &device, const Found &found);
    void forget(DeviceKey key);
    void answered(Device &device); ///< it did just now: not silent any more
    /// What the bus thread polls from now on; a new one, after reopen(), polls nothing.
    void setPollPlan(PollPlan plan);
    /// The line itself moves; devices elsewhere are parked.
    void setWorkingBaudRate(int bitsPerSecond);

    /// Full-rate cycles a second over the last second; 0 while nothing is watched at full rate.
    double cycleRate() const { return m_cycleRate; }
    double possibleRate() const { return m_foresight.possibleRate(); } ///< what the wire would allow for the same
    const PollPrediction &prediction() const { return m_foresight.prediction(); } ///< with what adapter and host add
    const PollPlan &pollPlan() const { return m_plan; }
    /// See limitsOf(). Empty until they are looked for, which asking begins; rateChanged() tells.
    const std::vector<RateLimit> &limits();
    PolledLine polled() const;              ///< what is asked of predictPoll()
    /// Asks adapter and driver to hand over what comes at once (Line::lowerLatency).
    void lowerLatency(QObject *context, std::function<void(const Result<void> &)> done);
    double busLoad() const { return m_busLoad; } ///< 0..1: part of the last second in which the wire carried bytes
    LineHealth &health() { return m_health; }

    /// From now on what comes of its stretch, read at `since` or later, counts for the packed registers. What doesn't
    /// come by way of the entries ends it. See IndirectReads, which alone calls this.
    void setPacking(Device &device, IndirectPacking packing, LineTime since);
    void endPacking(Device &device);
    const IndirectPacking *packing(DeviceKey device) const { return m_packed.packing(device); }

signals:
    void packingLost(dynascope::Device *device); ///< what was read came by no entry of it
    void deviceAdded(dynascope::Device *device);
    void deviceAboutToBeRemoved(dynascope::Device *device);
    void deviceChanged(dynascope::Device *device);
    void deviceLocated(dynascope::Device *device); ///< it was looked for after a change or a reboot, and found
    void stateChanged();
    void batchTaken(const dynascope::Batch &batch); ///< after the devices have it
    void rateChanged();                             ///< cycle rate, bus load, statistics: about once a second

private:
    void startThread(const QString &name, int baudRate);
    void onThreadState();
    void takeBatches();
    void take(const Batch &batch);
    void unpack(Batch &batch);
    bool isPresent(const Device &device) const;
    void countFailure(Device &device, const PollValue &value);
    void measureRates();
    void park(Device &device);
    void countAnew(const Device &device);

    LineFactory &m_factory;
    const Catalog &m_catalog;
    DeviceKeys &m_keys;
    std::unique_ptr<BusThread> m_thread;
    std::vector<std::unique_ptr<Device>> m_devices;
    std::map<DeviceKey, int> m_failures; ///< poll answers missing in a row
    int m_generation = 0;
    LineHealth m_health;
    PackedReads m_packed;
    QTimer m_rateTimer;
    QTimer m_frameTimer;
    QElapsedTimer m_sinceMeasured;
    int m_fullRateCycles = 0;
    LineTime m_busyAtMeasure{};
    PollPlan m_plan;
    double m_cycleRate = 0;
    PollForesight m_foresight;
    double m_busLoad = 0;
};

} // namespace dynascope
