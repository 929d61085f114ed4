// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/ratelimit.h"

#include <QFutureWatcher>

namespace dynascope {

/// What polling of one line will be like and what holds it up, worked out in the thread pool and kept until the line, or
/// what is asked of it, is no longer like that. GUI thread; owned by LineSession.
class PollForesight : public QObject
{
    Q_OBJECT

public:
    explicit PollForesight(QObject *parent = nullptr);

    /// Works out what isn't known of this line; changed() follows. While it works on another, the next call does.
    void look(PolledLine line);
    /// So does this for its limits.
    void lookForLimits(PolledLine line);
    void clear(); ///< the line is gone: what is being worked out is dropped

    const PollPrediction &prediction() const { return m_seen.prediction; }
    double possibleRate() const { return m_seen.possibleRate; } ///< see possibleCycleRate(), Hz
    const std::vector<RateLimit> &limits() const { return m_seen.limits; } ///< empty: not looked for yet

signals:
    void changed();

private:
    void take();

    struct Seen {
        PollPrediction prediction;
        double possibleRate = 0;
        std::vector<RateLimit> limits;
    };
    PolledLine m_line; ///< what m_seen is of, or will be
    Seen m_seen;
    QFutureWatcher<Seen> m_work;
    bool m_limitsWanted = false;
    bool m_isDropped = false;
};

} // namespace dynascope
