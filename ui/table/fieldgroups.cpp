// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/table/fieldgroups.h"

#include <QCoreApplication>

#include <algorithm>

namespace dynascope {
namespace {

enum Section { Eeprom, Hybrid, Ram, IndirectAddress, IndirectData, SectionCount };

Section sectionOf(const Field &field)
{
    if (field.name.startsWith(u"Indirect Address"))
        return IndirectAddress;
    if (field.name.startsWith(u"Indirect Data"))
        return IndirectData;
    switch (field.area) {
    case Area::Eeprom: return Eeprom;
    case Area::Hybrid: return Hybrid;
    case Area::Unknown:
    case Area::Ram: break;
    }
    return Ram;
}

QString title(int section)
{
    switch (section) {
    case Eeprom: return QCoreApplication::translate("FieldGroup", "EEPROM");
    case Hybrid: return QCoreApplication::translate("FieldGroup", "Hybrid");
    case IndirectAddress: return QCoreApplication::translate("FieldGroup", "Indirect addresses");
    case IndirectData: return QCoreApplication::translate("FieldGroup", "Indirect data");
    default: return QCoreApplication::translate("FieldGroup", "RAM");
    }
}

} // namespace

std::vector<FieldGroup> fieldGroups(const ControlTable &table)
{
    std::vector<FieldGroup> groups(SectionCount);
    for (int section = 0; section < SectionCount; ++section) {
        groups[static_cast<std::size_t>(section)].title = title(section);
        groups[static_cast<std::size_t>(section)].folded = section == IndirectAddress || section == IndirectData;
    }
    int index = 0;
    for (const Field &field : table.fields())
        groups[sectionOf(field)].fields.push_back(index++);
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
    for (const Field &field : table.fields()) {
        add(field.minimum.reg);
        add(field.maximum.reg);
        for (const Alternate &alternate : field.alternates) {
            add(alternate.reg);
            add(alternate.minimum.reg);
            add(alternate.maximum.reg);
        }
    }
    return found;
}

} // namespace dynascope
