// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/record/udpsender_posix.h"
#include "ui/common/workbench.h"
#include "ui/record/recordwishes.h"
#include "ui/record/watcheddevices.h"

namespace dynascope {

/// Sends what is watched as JSON over UDP while it runs; never waits. GUI thread; all that `workbench` names outlives it.
class SessionStream : public QObject
{
    Q_OBJECT

public:
    explicit SessionStream(const Workbench &workbench, QObject *parent = nullptr);

    /// InvalidArgument: the host is no IP address; NotFound: no way leads there. What ran before has ended then.
    Result<void> start(const StreamWishes &wishes);
    void stop();
    bool isRunning() const { return m_sender.has_value(); }
    const StreamWishes &wishes() const { return m_wishes; } ///< of the last start
    quint64 sent() const { return m_sent; }                 ///< datagrams
    quint64 lost() const { return m_sender ? m_sender->lost() : 0; } ///< that the system did not take

signals:
    void changed();

private:
    void send(const Batch &batch);

    Workbench m_workbench;
    StreamWishes m_wishes;
    std::unique_ptr<WatchedDevices> m_devices;
    std::optional<posix::UdpSender> m_sender;
    RecordingHeader m_header;
    quint64 m_sent = 0;
};

} // namespace dynascope
