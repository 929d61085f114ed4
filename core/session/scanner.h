// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/session.h"

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

/// Looks for devices on one line; they appear in its LineSession as they answer. GUI thread.
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
    int found() const { return m_found; }

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
    int m_found = 0;
};

} // namespace dynascope
