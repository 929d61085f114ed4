// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/indirectpacking.h"

#include "core/table/indirect.h"

#include <QCoreApplication>

#include <algorithm>
#include <map>

namespace dynascope {
namespace {

struct IndirectTexts {
    Q_DECLARE_TR_FUNCTIONS(IndirectPacking)
};

/// Of one number: where it points, and where that is read.
struct Slot {
    int pointer = -1; ///< Indirect Address, index in the table
    int data = -1;    ///< Indirect Data
};

std::map<int, Slot> slotsOf(const ControlTable &table)
{
    std::map<int, Slot> found;
    const std::span<const Field> fields = table.fields();
    for (std::size_t i = 0; i < fields.size(); ++i) {
        if (const int number = indirectAddressNumber(fields[i]); number > 0 && fields[i].isWritable())
            found[number].pointer = static_cast<int>(i);
        if (const int number = indirectDataNumber(fields[i]); number > 0 && fields[i].size == 1)
            found[number].data = static_cast<int>(i);
    }
    std::erase_if(found, [](const auto &one) { return one.second.pointer < 0 || one.second.data < 0; });
    return found;
}

QString problemOf(const Field &field)
{
    if (field.area == Area::Eeprom)
        return IndirectTexts::tr("%1 is in EEPROM: only RAM can be pointed at").arg(field.name);
    if (indirectDataNumber(field) > 0 || indirectAddressNumber(field) > 0)
        return IndirectTexts::tr("%1 is part of the indirect block itself").arg(field.name);
    if (field.access == Access::Unknown)
        return IndirectTexts::tr("nobody knows what %1 is").arg(field.name);
    return {};
}

/// The first `count` entries one behind the other in the table that nobody uses.
class SlotSearch
{
public:
    SlotSearch(const ControlTable &table, const std::function<std::optional<std::int64_t>(int)> &known,
               UsedEntries used)
        : m_table(table), m_known(known), m_used(used)
    {
    }
    /// Empty: there are none, `why` says it.
    std::vector<Slot> find(std::size_t count, QString &why) const
    {
        std::vector<Slot> run;
        int longest = 0;
        bool unread = false;
        for (const auto &[number, one] : slotsOf(m_table)) {
            const std::optional<std::int64_t> value = m_known(one.pointer);
            unread = unread || !value;
            const bool isFree = value && (m_used == UsedEntries::Take || value == field(one.pointer).initial);
            if (!isFree) {
                run.clear();
                continue;
            }
            if (!run.empty() && field(one.data).address != field(run.back().data).end())
                run.clear(); // the next block stands elsewhere
            run.push_back(one);
            longest = std::max(longest, static_cast<int>(run.size()));
            if (run.size() == count)
                return run;
        }
        why = unread ? IndirectTexts::tr("what the Indirect Addresses hold has not been read")
                     : IndirectTexts::tr("%1 bytes are to be packed, and only %2 Indirect Addresses in a row are free")
                           .arg(count).arg(longest);
        return {};
    }

private:
    const Field &field(int index) const { return m_table.fields()[static_cast<std::size_t>(index)]; }

    const ControlTable &m_table;
    const std::function<std::optional<std::int64_t>(int)> &m_known;
    UsedEntries m_used;
};

} // namespace

std::vector<int> IndirectPacking::fields() const
{
    std::vector<int> all;
    for (const Place &place : places)
        all.push_back(place.field);
    return all;
}

int IndirectPacking::addressOf(int field) const
{
    const auto place = std::ranges::find(places, field, &Place::field);
    return place == places.end() ? -1 : address + place->offset;
}

bool IndirectPacking::isThrough(ByteView data) const
{
    return data.size() == length && (mark < 0 || data.back() == mark);
}

Result<IndirectPacking> packIndirect(const ControlTable &table, const std::vector<int> &fields,
                                     const std::function<std::optional<std::int64_t>(int field)> &known,
                                     UsedEntries used, PackingMark mark)
{
    if (slotsOf(table).empty())
        return failure(ErrorKind::NotSupported,
                       IndirectTexts::tr("%1 has no Indirect Addresses that can be set").arg(table.model()));
    std::vector<int> sorted = fields;
    std::ranges::sort(sorted);
    if (sorted.empty() || std::ranges::adjacent_find(sorted) != sorted.end())
        return failure(ErrorKind::InvalidArgument, IndirectTexts::tr("each register is packed once, and one at least"));
    if (sorted.front() < 0 || sorted.back() >= static_cast<int>(table.fields().size()))
        return failure(ErrorKind::InvalidArgument, IndirectTexts::tr("there is no such register"));
    IndirectPacking packing;
    std::vector<std::int64_t> bytes; // addresses that are to be seen, in their order
    for (const int index : sorted) {
        const Field &field = table.fields()[static_cast<std::size_t>(index)];
        if (const QString problem = problemOf(field); !problem.isEmpty())
            return failure(ErrorKind::InvalidArgument, problem);
        packing.places.push_back({index, static_cast<int>(bytes.size())});
        for (int byte = 0; byte < field.size; ++byte)
            bytes.push_back(field.address + byte);
    }
    QString why;
    const int spared = static_cast<int>(bytes.back() - bytes.front() + 1) - static_cast<int>(bytes.size());
    const std::size_t marks = mark == PackingMark::Last ? 1 : 0;
    const std::vector<Slot> found = SlotSearch(table, known, used).find(bytes.size() + marks, why);
    if (found.empty())
        return failure(ErrorKind::NotFound, why);
    if (marks > 0) {
        const int at = table.fields()[static_cast<std::size_t>(found.back().pointer)].address;
        const bool isLow = (at & 0xFF) != 0;
        bytes.push_back(isLow ? at : at + 1);
        packing.mark = static_cast<int>(isLow ? bytes.back() & 0xFF : bytes.back() >> 8);
    }
    for (std::size_t i = 0; i < bytes.size(); ++i)
        packing.entries.push_back({found[i].pointer, known(found[i].pointer).value_or(0), bytes[i]});
    packing.address = table.fields()[static_cast<std::size_t>(found.front().data)].address;
    packing.length = static_cast<std::uint16_t>(bytes.size());
    packing.bytesSpared = spared;
    return packing;
}

bool isSettableEntry(const Field &field)
{
    return indirectAddressNumber(field) > 0 && field.isWritable() && field.area == Area::Ram;
}

bool mayBePointedAt(const Field &field)
{
    return (field.area == Area::Ram || field.area == Area::Hybrid) && field.access != Access::Unknown
        && indirectDataNumber(field) == 0 && indirectAddressNumber(field) == 0;
}

Result<IndirectPacking> packWorthwhile(const ControlTable &table, const std::vector<int> &fields,
                                       const std::function<std::optional<std::int64_t>(int field)> &known,
                                       UsedEntries used)
{
    const auto isLasting = [](const Field &field) { return indirectAddressNumber(field) > 0 && !isSettableEntry(field); };
    if (std::ranges::any_of(table.fields(), isLasting))
        return failure(ErrorKind::NotSupported, IndirectTexts::tr("its Indirect Addresses are in EEPROM"));
    auto packing = packIndirect(table, fields, known, used, PackingMark::Last);
    if (packing && packing->bytesSpared <= 1)
        return failure(ErrorKind::NotSupported, IndirectTexts::tr("what is plotted at full rate stands side by side"));
    return packing;
}

} // namespace dynascope
