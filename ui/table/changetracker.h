// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/device.h"

#include <QTimer>

#include <functional>
#include <set>

namespace dynascope {

/// When each value of the grid last changed: what fades, and which write has been waiting for long enough to be shown.
/// GUI thread. Its timer runs only while something fades or waits.
class ChangeTracker : public QObject
{
    Q_OBJECT

public:
    using Clock = std::function<qint64()>; ///< milliseconds, monotonic

    static constexpr qint64 StillMs = 3000;   ///< a value that changes after standing still this long is marked
    static constexpr qint64 FadeMs = 1000;    ///< for this long
    static constexpr qint64 ResultMs = 500;   ///< what changes within this time after a write is its result
    static constexpr qint64 PendingMs = 150;  ///< quicker writes show only their result: a slider must not flicker

    explicit ChangeTracker(Clock clock, QObject *parent = nullptr);

    void reset(int devices, int fields);
    /// Takes note of a value as it is now; true where it isn't what it was. `mark` false: without marking what changed
    /// (nobody saw it change).
    bool observe(int device, int field, const FieldValue &value, bool mark);

    double fade(int device, int field) const; ///< 1 just changed … 0
    bool showsPending(int device, int field) const;

signals:
    void looksChanged(int device, int field); ///< paint this cell again

private:
    struct Cell {
        std::optional<std::int64_t> raw, pending;
        FieldState state = FieldState::Unknown;
        qint64 changedAt = 0;
        qint64 markedAt = -1;  ///< −1: not marked
        qint64 pendingAt = -1; ///< −1: no write waits
        qint64 writtenAt = -1; ///< when a write ended, whose result may come a moment later; −1: never
    };

    const Cell &cell(int device, int field) const;
    Cell &cell(int device, int field);
    void step();

    Clock m_clock;
    QTimer m_timer;
    int m_fields = 0;
    std::vector<Cell> m_cells;
    std::set<std::pair<int, int>> m_active; ///< (device, field) that fade or wait
};

} // namespace dynascope
