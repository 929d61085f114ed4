// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/table/fieldgroups.h"

namespace dynascope {

/// The registers of several control tables, matched by name: one row each. They stand as in the first table; what only
/// others have stands where its neighbours are. Of one table a row is the index of its field. Pure.
class RegisterRows
{
public:
    RegisterRows() = default;
    explicit RegisterRows(const std::vector<const ControlTable *> &tables); ///< one a device, often the same

    int count() const { return m_count; }
    int fieldOf(int row, int device) const; ///< index in that device's table; −1: it has no such register
    int rowOf(int device, int field) const;
    int deviceWith(int row, int preferred = 0) const; ///< `preferred` if it has the register, else the first that has
    bool isOnAll(int row) const;
    const std::vector<FieldGroup> &groups() const { return m_groups; } ///< `fields` are rows
    /// Registers that others take range, unit, meaning or lock from, in any of the tables.
    const std::set<int> &deciding() const { return m_deciding; }

private:
    void group(const std::vector<const ControlTable *> &tables);

    int m_count = 0;
    std::vector<std::vector<int>> m_fields; ///< by device and row
    std::vector<std::vector<int>> m_rows;   ///< by device and field
    std::vector<FieldGroup> m_groups;
    std::set<int> m_deciding;
};

} // namespace dynascope
