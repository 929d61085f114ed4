// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/table/changetracker.h"

#include <algorithm>

namespace dynascope {

ChangeTracker::ChangeTracker(Clock clock, QObject *parent)
    : QObject(parent)
    , m_clock(std::move(clock))
{
    m_timer.setInterval(50);
    connect(&m_timer, &QTimer::timeout, this, &ChangeTracker::step);
}

void ChangeTracker::reset(int devices, int fields)
{
    m_fields = fields;
    m_cells.assign(static_cast<std::size_t>(devices) * static_cast<std::size_t>(fields), Cell());
    m_active.clear();
    m_timer.stop();
}

const ChangeTracker::Cell &ChangeTracker::cell(int device, int field) const
{
    return m_cells[static_cast<std::size_t>(device) * static_cast<std::size_t>(m_fields)
                   + static_cast<std::size_t>(field)];
}

ChangeTracker::Cell &ChangeTracker::cell(int device, int field)
{
    return m_cells[static_cast<std::size_t>(device) * static_cast<std::size_t>(m_fields)
                   + static_cast<std::size_t>(field)];
}

bool ChangeTracker::observe(int device, int field, const FieldValue &value, bool mark)
{
    Cell &seen = cell(device, field);
    const qint64 now = m_clock();
    const bool isPending = value.pending.has_value();
    const bool changed = seen.raw != value.raw || seen.pending != value.pending || seen.state != value.state
        || value.state == FieldState::Failed;
    seen.pending = value.pending;
    seen.state = value.state;
    const bool ofWrite
        = isPending || seen.pendingAt >= 0 || (seen.writtenAt >= 0 && now - seen.writtenAt <= ResultMs);
    if (seen.raw && value.raw && *seen.raw != *value.raw && mark && (ofWrite || now - seen.changedAt >= StillMs))
        seen.markedAt = now;
    if (seen.raw != value.raw) {
        seen.raw = value.raw;
        seen.changedAt = now;
    }
    if (!isPending) {
        seen.writtenAt = seen.pendingAt >= 0 ? now : seen.writtenAt;
        seen.pendingAt = -1;
    } else if (seen.pendingAt < 0) {
        seen.pendingAt = now;
    }
    if (seen.markedAt >= 0 || seen.pendingAt >= 0) {
        m_active.emplace(device, field);
        if (!m_timer.isActive())
            m_timer.start();
    }
    return changed;
}

double ChangeTracker::fade(int device, int field) const
{
    const Cell &seen = cell(device, field);
    if (seen.markedAt < 0)
        return 0;
    return std::clamp(1.0 - static_cast<double>(m_clock() - seen.markedAt) / FadeMs, 0.0, 1.0);
}

bool ChangeTracker::showsPending(int device, int field) const
{
    const Cell &seen = cell(device, field);
    return seen.pendingAt >= 0 && m_clock() - seen.pendingAt >= PendingMs;
}

void ChangeTracker::step()
{
    const qint64 now = m_clock();
    const std::set<std::pair<int, int>> active = m_active;
    for (const auto &[device, field] : active) {
        Cell &seen = cell(device, field);
        if (seen.markedAt >= 0 && now - seen.markedAt >= FadeMs)
            seen.markedAt = -1;
        const bool waits = seen.pendingAt >= 0 && now - seen.pendingAt < PendingMs;
        if (seen.markedAt < 0 && !waits)
            m_active.erase({device, field});
    }
    if (m_active.empty())
        m_timer.stop();
    for (const auto &[device, field] : active)
        emit looksChanged(device, field);
}

} // namespace dynascope
