// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/record/recording_values.h"
#include "core/session/monitor.h"

namespace dynascope {

/// The watched fields of all devices, as a recording has them: names, units and scales as they are now, and kept so. GUI
/// thread; session and monitor outlive it.
class WatchedDevices : public QObject
{
    Q_OBJECT

public:
    WatchedDevices(Session &session, const Monitor &monitor, QObject *parent = nullptr);

    /// Those of which something is or was watched since this was made; no two have the same label.
    const std::vector<RecordedDevice> &devices() const { return m_devices; }
    bool isEmpty() const; ///< nothing is watched
    /// All registers of it were read meanwhile: says so by changed().
    void takeImage(const Device &device);
    /// Every register that can be read was.
    static bool isImageWhole(const Device &device);

signals:
    /// One came, or its fields, their units, its name, place or registers changed. Without fields: it isn't watched now.
    void changed(const dynascope::RecordedDevice &device);

private:
    void follow(Device *device);
    void update();
    void update(const Device &device);
    RecordedDevice describe(const Device &device);
    QString labelFor(const Device &device) const;

    Session &m_session;
    const Monitor &m_monitor;
    std::vector<RecordedDevice> m_devices;
    std::map<quint32, std::set<int>> m_deciding; ///< registers that decide about units of what is watched
};

} // namespace dynascope
