// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/table/registerrows.h"

#include <QHash>
#include <QSet>

#include <algorithm>
#include <map>

namespace dynascope {
namespace {

/// Takes `names` into `all`, those that it hasn't yet behind the ones they follow here.
void takeInto(QStringList &all, const QStringList &names)
{
    QSet<QString> known(all.begin(), all.end());
    qsizetype at = 0;
    for (const QString &name : names) {
        if (known.contains(name)) {
            at = all.indexOf(name) + 1;
        } else {
            all.insert(at++, name);
            known.insert(name);
        }
    }
}

std::vector<const ControlTable *> distinct(const std::vector<const ControlTable *> &tables)
{
    std::vector<const ControlTable *> found;
    for (const ControlTable *table : tables) {
        if (std::ranges::find(found, table) == found.end())
            found.push_back(table);
    }
    return found;
}

} // namespace

RegisterRows::RegisterRows(const std::vector<const ControlTable *> &tables)
{
    QStringList names;
    for (const ControlTable *table : distinct(tables)) {
        QStringList own;
        for (const Field &field : table->fields())
            own << field.name;
        takeInto(names, own);
    }
    m_count = static_cast<int>(names.size());
    QHash<QString, int> rowByName;
    for (int row = 0; row < m_count; ++row)
        rowByName.insert(names[row], row);
    for (const ControlTable *table : tables) {
        std::vector<int> fields(static_cast<std::size_t>(m_count), -1);
        std::vector<int> rows;
        for (const Field &field : table->fields()) {
            const int row = rowByName.value(field.name);
            fields[static_cast<std::size_t>(row)] = static_cast<int>(rows.size());
            rows.push_back(row);
        }
        for (const int field : decidingFields(*table))
            m_deciding.insert(rows[static_cast<std::size_t>(field)]);
        m_fields.push_back(std::move(fields));
        m_rows.push_back(std::move(rows));
    }
    group(tables);
}

/// A register is in the group that the first table has it in.
void RegisterRows::group(const std::vector<const ControlTable *> &tables)
{
    QStringList titles;
    std::map<QString, FieldGroup> groups;
    std::vector<QString> titleOf(static_cast<std::size_t>(m_count));
    for (const ControlTable *table : distinct(tables)) {
        const auto device = std::ranges::find(tables, table) - tables.begin();
        QStringList own;
        for (const FieldGroup &group : fieldGroups(*table)) {
            own << group.title;
            FieldGroup &known = groups[group.title];
            known = {group.title, group.folded || known.folded, group.isRun || known.isRun, {}};
            for (const int field : group.fields) {
                QString &title = titleOf[static_cast<std::size_t>(rowOf(static_cast<int>(device), field))];
                title = title.isEmpty() ? group.title : title;
            }
        }
        takeInto(titles, own);
    }
    for (int row = 0; row < m_count; ++row)
        groups[titleOf[static_cast<std::size_t>(row)]].fields.push_back(row);
    for (const QString &title : titles) {
        if (!groups[title].fields.empty())
            m_groups.push_back(groups[title]);
    }
}

int RegisterRows::fieldOf(int row, int device) const
{
    return m_fields[static_cast<std::size_t>(device)][static_cast<std::size_t>(row)];
}

int RegisterRows::rowOf(int device, int field) const
{
    return m_rows[static_cast<std::size_t>(device)][static_cast<std::size_t>(field)];
}

int RegisterRows::deviceWith(int row, int preferred) const
{
    if (fieldOf(row, preferred) >= 0)
        return preferred;
    for (int device = 0; device < static_cast<int>(m_fields.size()); ++device) {
        if (fieldOf(row, device) >= 0)
            return device;
    }
    return preferred;
}

bool RegisterRows::isOnAll(int row) const
{
    return std::ranges::all_of(
        m_fields, [row](const std::vector<int> &fields) { return fields[static_cast<std::size_t>(row)] >= 0; });
}

} // namespace dynascope
