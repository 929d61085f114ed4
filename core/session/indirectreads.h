// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/ratelimit.h"
#include "core/session/indirectkept.h"
#include "core/session/indirectpacking.h"
#include "core/session/monitor.h"
#include "core/session/settingscommands.h"

namespace dynascope {

/// Reads scattered watched registers by Indirect Data, where a person wants it: sets the Indirect Addresses, keeps on
/// disk what they held, and puts that back. RAM only. While it is on, a byte of each stretch tells whether it still
/// comes by way of the entries; a device that was restarted, or set otherwise, is read as before. GUI thread; owned
/// by app.
class IndirectReads : public QObject
{
    Q_OBJECT

public:
    /// All outlive this. `folder` empty: nothing is kept on disk.
    IndirectReads(Session &session, Monitor &monitor, SettingsCommands &settings, const QString &folder,
                  QObject *parent = nullptr);

    /// Off: what they held is put back, entry by entry, where nobody else has set it since.
    void setOn(LineSession &line, bool on, UsedEntries used = UsedEntries::Refuse);
    bool isOn(const LineSession &line) const { return m_on.contains(&line); }
    bool isBusy(const LineSession &line) const; ///< entries are being read or written
    int packedDevices(const LineSession &line) const;

    /// What it would bring.
    struct Forecast {
        int devices = 0; ///< that have something to be packed; 0: `obstacle` says why, of one that has not
        QString obstacle;
        PolledLine without, with; ///< for predictPoll(), which takes its time
    };
    Forecast forecast(const LineSession &line) const;

    /// Devices here whose entries a program that was ended has left; see leftFound().
    std::vector<Device *> left(const LineSession &line) const;
    void putBackLeft(LineSession &line);
    void forgetLeft(const LineSession &line); ///< of all devices, here or not

signals:
    void changed(dynascope::LineSession *line); ///< on, off, busy, packed devices
    void told(const QString &text, bool isProblem);
    void leftFound(dynascope::LineSession *line);

private:
    enum class Stage { Reading, Writing, Checking, Live, PuttingBack };
    struct Task {
        int number = 0; ///< what comes of one before says nothing of this
        Stage stage = Stage::Reading;
        IndirectPacking packing;
        bool isAbandoned = false; ///< put back once it can be
        bool begins = false;      ///< after it was put back
    };

    void follow(LineSession *line);
    void onLineState(LineSession &line);
    void onDevice(Device &device);
    void look();
    std::vector<int> wantedOf(const Device &device) const;
    Result<IndirectPacking> plan(const Device &device, bool unreadIsFresh) const;
    void begin(Device &device);
    void write(Device &device, Task &task);
    void check(Device &device, Task &task);
    void putBack(Device &device, bool begins);
    void writeBack(Device &device, Task &task);
    void finish(Device &device, bool isBack);
    void lost(Device &device);
    void refuse(Device &device, const QString &why);
    void readEntries(Device &device, std::vector<Span> more,
                     std::function<void(Device &, Task &, const std::vector<PollValue> &, LineTime)> then);
    Task &startTask(Device &device, Stage stage);
    Task *taskOf(DeviceKey device, int number);

    Session &m_session;
    Monitor &m_monitor;
    SettingsCommands &m_settings;
    std::map<const LineSession *, UsedEntries> m_on;
    IndirectKept m_kept;
    std::map<DeviceKey, Task> m_tasks;
    std::set<DeviceKey> m_refused; ///< not again before a person wants it anew
    int m_tasksSoFar = 0;
    QTimer m_lookTimer;
};

} // namespace dynascope
