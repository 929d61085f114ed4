// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/window/replayroom.h"

namespace dynascope {

ReplayRoom::ReplayRoom(const Catalog &catalog)
    : m_session(m_lines, catalog)
    , m_monitor(m_session)
    , m_replayer(m_session, m_monitor)
{
}

Result<std::unique_ptr<ReplayRoom>> ReplayRoom::open(const Catalog &catalog, const QString &path,
                                                     std::size_t historyBudget)
{
    std::unique_ptr<ReplayRoom> room(new ReplayRoom(catalog));
    if (historyBudget > 0)
        room->m_monitor.setHistoryBudget(historyBudget);
    if (const auto opened = room->m_replayer.open(path); !opened)
        return tl::unexpected(opened.error());
    room->m_window = std::make_unique<ReplayWindow>(room->m_session, room->m_monitor, room->m_replayer);
    return room;
}

} // namespace dynascope
