// SPDX-License-Identifier: GPL-3.0-or-later
// What devices report, collected and told once a frame.
#include "ui/table/fieldtablemodel.h"

#include <algorithm>

namespace dynascope {

void FieldTableModel::note(int device, int first, int last)
{
    bool any = false;
    for (int field = first; field <= last; ++field) {
        const int row = m_rows.rowOf(device, field);
        if (m_tracker.observe(device, row, deviceAt(device).value(field), m_live)) {
            m_dirty[static_cast<std::size_t>(row)] = 1;
            any = true;
        }
    }
    if (any && m_live && !m_frame.isActive())
        m_frame.start();
}

void FieldTableModel::flush()
{
    std::vector<char> dirty(m_dirty.size(), 0);
    dirty.swap(m_dirty);
    if (std::ranges::find(dirty, 1) == dirty.end())
        return;
    const bool decided
        = std::ranges::any_of(m_rows.deciding(), [&](int row) { return dirty[static_cast<std::size_t>(row)] != 0; });
    if (decided) {
        emitEverything();
        return;
    }
    for (int group = 0; group < static_cast<int>(groups().size()); ++group)
        emitRows(group, dirty, firstValueColumn(), lastValueColumn());
    emit updated();
}

void FieldTableModel::emitRows(int group, const std::vector<char> &dirty, int firstColumn, int lastColumn)
{
    // One change per stretch of rows, small gaps included: a signal costs more than a few rows painted for nothing.
    constexpr int Gap = 8;
    const std::vector<int> &fields = groups()[static_cast<std::size_t>(group)].fields;
    const auto tell = [&](int first, int last) {
        const auto id = static_cast<quintptr>(group) + 1;
        emit dataChanged(createIndex(first, firstColumn, id), createIndex(last, lastColumn, id));
    };
    int first = -1;
    int last = -1;
    for (int row = 0; row < static_cast<int>(fields.size()); ++row) {
        if (!dirty[static_cast<std::size_t>(fields[static_cast<std::size_t>(row)])])
            continue;
        if (first >= 0 && row - last > Gap) {
            tell(first, last);
            first = -1;
        }
        first = first < 0 ? row : first;
        last = row;
    }
    if (first >= 0)
        tell(first, last);
}

void FieldTableModel::emitEverything()
{
    const std::vector<char> all(m_dirty.size(), 1);
    for (int group = 0; group < static_cast<int>(groups().size()); ++group)
        emitRows(group, all, 0, columnCount() - 1);
    emit headerDataChanged(Qt::Horizontal, 0, columnCount() - 1);
    emit updated();
}

} // namespace dynascope
