// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/replay/replayclock.h"
#include "core/replay/replaydata.h"

#include <QElapsedTimer>
#include <QThread>
#include <QTimer>

namespace dynascope {

class Monitor;

/// Plays a recording into a session: its devices hold what they held at the position, its histories are whole from the
/// begin, and Session::now() is the position. Reads the file on a thread of its own. GUI thread; one recording, once.
class Replayer : public QObject
{
    Q_OBJECT

public:
    /// Both outlive this, and know nothing yet; the session's lines are RecordedLines.
    Replayer(Session &session, Monitor &monitor, QObject *parent = nullptr);
    ~Replayer() override;

    /// Devices and header are there at once, all the rest with loaded(). BadFile.
    Result<void> open(const QString &path);

    QString path() const { return m_path; }
    const RecordingHeader &header() const { return m_header; }
    const ReplayDevices &devices() const { return m_devices; }
    bool isWhole() const { return m_isWhole; } ///< it was ended, not cut off
    bool isLoaded() const { return m_isLoaded; }
    int percentLoaded() const;
    quint64 samples() const { return m_data.samples; }
    std::size_t damagedParts() const { return m_data.damagedParts; }
    const std::deque<LoggedEvent> &events() const { return m_data.events; }
    /// The field of which most was recorded; nothing where nothing was.
    std::optional<Watch> busiest() const { return m_busiest; }

    const ReplayClock &clock() const { return m_clock; }
    void seek(LineTime to);
    void play();
    void pause();
    void setSpeed(double speed);
    void step(int samples); ///< so many readings of busiest() on, or back; pauses

    /// What the wall clock said then, in this machine's time zone.
    QDateTime wallTime(LineTime at) const;

signals:
    void loadProgressed();
    void loaded();
    void moved();        ///< the position; devices hold what they held there
    void jumped();       ///< before moved(): sought elsewhere. What is remembered of before says nothing
    void stateChanged(); ///< it plays, or does not; its speed

private:
    void takeData(Result<ReplayData> data);
    void lookOver();
    void onTimer();
    void show(bool isSought); ///< else it has come there by playing, however fast
    void showBefore(LineTime at);
    void showBetween(LineTime from, LineTime to);
    using Batches = std::map<LineSession *, Batch>;
    void addMissed(Batches &batches, LineTime from, LineTime to) const;
    static void tell(Batches &batches);

    Session &m_session;
    Monitor &m_monitor;
    QString m_path;
    RecordingHeader m_header;
    ReplayDevices m_devices;
    ReplayData m_data;
    ReplayClock m_clock;
    std::optional<LineTime> m_shown; ///< up to where devices have been told
    std::optional<Watch> m_busiest;
    bool m_isWhole = false, m_isLoaded = false;
    QTimer m_timer;
    QElapsedTimer m_passed;
    std::shared_ptr<ReplayProgress> m_progress;
    std::unique_ptr<QThread> m_thread;
};

} // namespace dynascope
