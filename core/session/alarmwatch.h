// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/faultrecords.h"

namespace dynascope {

/// Looks at all devices some times a second, whatever is on screen, and keeps their alarms and what was before faults.
/// It asks for nothing itself: what is polled is Monitor's. GUI thread.
class AlarmWatch : public QObject
{
    Q_OBJECT

public:
    /// Both outlive this.
    AlarmWatch(Session &session, Monitor &monitor, QObject *parent = nullptr);

    const Alarms &alarms() const { return m_alarms; }
    const FaultRecords &records() const { return m_records; }
    const Vitals *vitals(DeviceKey device) const; ///< nullptr: it is not there
    void clearEnded();                            ///< out of the list
    void startAnew();                             ///< nothing was: a replay has gone elsewhere
    void look();                                  ///< now; else ten times a second while there are devices

signals:
    void looked();        ///< vitals may have become others
    void alarmsChanged(); ///< the list

private:
    struct Watched {
        std::vector<VitalField> fields;
        Vitals vitals;
    };

    void add(Device *device);
    void remove(Device *device);
    void keepFaults(const Device &device, const Watched &watched, LineTime now);

    Session &m_session;
    Alarms m_alarms;
    FaultRecords m_records;
    std::map<DeviceKey, Watched> m_devices;
    std::set<quint64> m_kept; ///< active alarms whose record was begun
    QTimer m_timer;
};

} // namespace dynascope
