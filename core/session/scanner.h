// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/session.h"

#include <set>

namespace dynascope {

struct ScanRange {
    std::vector<int> bauds; ///< in the order to try; at least one
    int firstId = 0;
    int lastId = 252;
    bool sweep = false; ///< one Ping after the other, where the broadcast one fails
};

/// The rates most worth trying first: the last one used, 57 600, 1 M, then the rest.
std::vector<int> likelyBauds(int lastUsed);
const std::vector<int> &allBauds(); ///< every rate an X, MX or P device can have, ascending

/// Looks for devices on one line; they appear in its LineSession as they answer. Commands that wait meanwhile run
/// between two of its exchanges: of a sweep after one Ping, else after a broadcast Ping, which takes up to 0.8 s. GUI
/// thread.
class Scanner : public QObject
{
    Q_OBJECT

public:
    explicit Scanner(QObject *parent = nullptr);

    void start(LineSession &line, const ScanRange &range);
    void cancel();
    bool isRunning() const { return m_job != 0; }
    bool wasCancelled() const { return m_wasCancelled; } ///< the last scan ended by cancel() or STOP
    double progress() const { return m_progress; } ///< 0..1
    int currentBaud() const { return m_currentBaud; }
    int found() const { return static_cast<int>(m_seen.size()); } ///< devices, by ID and baud rate

signals:
    void progressChanged(); ///< also at start
    /// `message` is empty where it went well, else one sentence.
    void finished(int found, const QString &message);

private:
    QPointer<LineSession> m_line;
    JobId m_job = 0;
    bool m_wasCancelled = false;
    int m_run = 0; ///< notes of an earlier scan are dropped by this
    double m_progress = 0;
    int m_currentBaud = 0;
    std::set<std::pair<int, std::uint8_t>> m_seen; ///< baud rate and ID
};

} // namespace dynascope
