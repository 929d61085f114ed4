// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/record/recorder.h"
#include "ui/common/workbench.h"
#include "ui/record/recordwishes.h"
#include "ui/record/watcheddevices.h"

#include <QElapsedTimer>
#include <QTimer>

namespace dynascope {

struct LoggedEvent;

/// Records what is watched, of all devices of all open lines, batch by batch as the lines bring them. What comes to be
/// watched, or goes, meanwhile is recorded from then on, or no more; in CSV that is a new file. GUI thread; all that
/// `workbench` names outlives it. Its end waits until everything is in the file.
class SessionRecorder : public QObject
{
    Q_OBJECT

public:
    explicit SessionRecorder(const Workbench &workbench, QObject *parent = nullptr);
    ~SessionRecorder() override;

    /// InvalidArgument: nothing is watched, or it is recording; BadFile: the folder or the file can't be made.
    Result<void> start(const RecordWishes &wishes);
    void stop();   ///< without waiting; ended() follows
    void finish(); ///< at once, waiting until all is written: the program ends. Nothing follows
    void add(const LoggedEvent &event);

    bool isRunning() const { return m_recorder && !m_isEnding; }
    bool isEnding() const { return m_recorder && m_isEnding; }
    RecorderStatus status() const; ///< of the one that runs, else of the last
    std::chrono::seconds length() const;

signals:
    void changed();                  ///< started, ending
    void ended();                    ///< all is in the file, or `status().error` says why not
    void fellBehind(quint64 lost);   ///< so many samples in all are not in the file: said when the first are lost

private:
    void follow(LineSession *line);
    void readTables();
    void lookAtLost();
    void onEnded();

    Workbench m_workbench;
    std::unique_ptr<WatchedDevices> m_devices;
    std::unique_ptr<Recorder> m_recorder;
    std::vector<QMetaObject::Connection> m_lines;
    RecorderStatus m_last;
    QElapsedTimer m_elapsed;
    std::chrono::seconds m_length{0};
    QTimer m_lostTimer;
    bool m_isEnding = false;
    bool m_isLostTold = false;
};

} // namespace dynascope
