// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/table/fieldgroups.h"

#include "core/session/settings/settingsorder.h"
#include "core/table/indirect.h"

#include <QCoreApplication>

#include <algorithm>

namespace dynascope {
namespace {

constexpr int BytesPerGroup = 128; ///< of a table of bare bytes

struct GroupText
{
    Q_DECLARE_TR_FUNCTIONS(FieldGroup)
};

enum Section { Eeprom, Hybrid, Ram, NotKnown, SectionCount };

Section sectionOf(const Field &field)
{
    switch (field.area) {
    case Area::Eeprom: return Eeprom;
    case Area::Hybrid: return Hybrid;
    case Area::Unknown: return NotKnown;
    case Area::Ram: break;
    }
    return Ram;
}

QString sectionTitle(int section)
{
    switch (section) {
    case Eeprom: return GroupText::tr("EEPROM");
    case Hybrid: return GroupText::tr("Hybrid");
    case NotKnown: return GroupText::tr("Registers");
    default: return GroupText::tr("RAM");
    }
}

QString runTitle(const QString &name)
{
    if (name == u"Indirect Address")
        return GroupText::tr("Indirect addresses");
    if (name == u"Indirect Data")
        return GroupText::tr("Indirect data");
    return name;
}

/// The name of the run that each field is in; empty for those in none. Indirect registers count however few there are.
std::vector<QString> runNames(const ControlTable &table)
{
    std::vector<QString> names;
    for (const Field &field : table.fields()) {
        names.push_back(indirectAddressNumber(field) > 0 ? QStringLiteral("Indirect Address")
                        : indirectDataNumber(field) > 0  ? QStringLiteral("Indirect Data")
                                                         : QString());
    }
    for (const FieldRun &run : longRuns(table)) {
        for (int field = run.first; field <= run.last; ++field)
            names[static_cast<std::size_t>(field)] = run.name;
    }
    return names;
}

std::vector<FieldGroup> byteGroups(const ControlTable &table)
{
    std::vector<FieldGroup> groups;
    for (int field = 0; field < static_cast<int>(table.fields().size()); ++field) {
        if (field % BytesPerGroup == 0) {
            const int last = std::min<int>(field + BytesPerGroup, static_cast<int>(table.fields().size())) - 1;
            groups.push_back({GroupText::tr("Bytes %1 – %2").arg(field).arg(last), field > 0, false, {}});
        }
        groups.back().fields.push_back(field);
    }
    return groups;
}

} // namespace

std::vector<FieldGroup> fieldGroups(const ControlTable &table)
{
    if (table.description().isRaw)
        return byteGroups(table);
    std::vector<FieldGroup> groups(SectionCount);
    for (int section = 0; section < SectionCount; ++section)
        groups[static_cast<std::size_t>(section)].title = sectionTitle(section);
    const std::vector<QString> runs = runNames(table);
    for (int index = 0; index < static_cast<int>(runs.size()); ++index) {
        const QString &run = runs[static_cast<std::size_t>(index)];
        if (run.isEmpty()) {
            groups[sectionOf(table.fields()[static_cast<std::size_t>(index)])].fields.push_back(index);
            continue;
        }
        const QString title = runTitle(run);
        auto group = std::ranges::find(groups, title, &FieldGroup::title);
        if (group == groups.end())
            group = groups.insert(groups.end(), {title, true, true, {}});
        group->fields.push_back(index);
    }
    std::erase_if(groups, [](const FieldGroup &group) { return group.fields.empty(); });
    return groups;
}

std::set<int> decidingFields(const ControlTable &table)
{
    std::set<int> found;
    const auto add = [&](const QString &name) {
        if (const int index = name.isEmpty() ? -1 : table.indexOf(name); index >= 0)
            found.insert(index);
    };
    add(QStringLiteral("Torque Enable"));
    int index = 0;
    for (const Field &field : table.fields()) {
        if (indirectAddressNumber(field) > 0) // its data says of what it is
            found.insert(index);
        ++index;
        add(field.gearRatio.numerator);
        add(field.gearRatio.denominator);
        for (const QString &name : limitingRegisters(field))
            add(name);
    }
    return found;
}

} // namespace dynascope
