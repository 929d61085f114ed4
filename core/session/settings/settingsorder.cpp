// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/settings/settingsorder.h"

#include "core/session/journal/journalwrites.h"

#include <algorithm>
#include <map>

namespace dynascope {
namespace {

/// The torque lock and the resets are in the EEPROM; a goal may depend on all else, and a watchdog may refuse it.
int rankOf(const ControlTable &table, const Field &field)
{
    if (&field == table.find(Known::StatusReturnLevel))
        return 4;
    if (field.name == u"Bus Watchdog")
        return 3;
    if (isGoal(field))
        return 2;
    return field.area == Area::Eeprom ? 0 : 1;
}

/// Which names must come before a field besides those that reset it.
using Limits = std::map<const Field *, QStringList>;

bool mustPrecede(const Field &one, const Field &other, const Limits &limits)
{
    return one.resets.contains(other.name) || limits.at(&other).contains(one.name);
}

} // namespace

QStringList limitingRegisters(const Field &field)
{
    QStringList names;
    const auto add = [&names](const QString &name) {
        if (!name.isEmpty())
            names << name;
    };
    add(field.minimum.reg);
    add(field.maximum.reg);
    for (const Alternate &alternate : field.alternates) {
        add(alternate.reg);
        add(alternate.minimum.reg);
        add(alternate.maximum.reg);
    }
    return names;
}

std::vector<const Field *> inOrder(const ControlTable &table, std::vector<const Field *> fields)
{
    std::ranges::stable_sort(fields, [&](const Field *a, const Field *b) {
        return std::pair(rankOf(table, *a), a->address) < std::pair(rankOf(table, *b), b->address);
    });
    Limits limits;
    for (const Field *field : fields)
        limits.emplace(field, limitingRegisters(*field));
    std::vector<const Field *> ordered;
    while (!fields.empty()) {
        const auto isFree = [&](const Field *field) {
            return std::ranges::none_of(
                fields, [&](const Field *other) { return other != field && mustPrecede(*other, *field, limits); });
        };
        auto next = std::ranges::find_if(fields, isFree);
        if (next == fields.end()) // they bound each other
            next = fields.begin();
        ordered.push_back(*next);
        fields.erase(next);
    }
    return ordered;
}

} // namespace dynascope
