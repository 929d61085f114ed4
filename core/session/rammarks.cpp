// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/rammarks.h"

#include "core/session/journal/journalwrites.h"

#include <algorithm>

namespace dynascope {
namespace {

const QLatin1String HybridSave("Hybrid Save");

std::size_t at(int index)
{
    return static_cast<std::size_t>(index);
}

/// After a start. HYBRID holds then what was stored, which no table says.
std::optional<std::int64_t> initialOf(const Field &field)
{
    return field.area == Area::Ram ? field.initial : std::nullopt;
}

/// The field's part of the change's bytes; nothing where they don't hold all of it.
std::optional<std::int64_t> partOf(const RegisterChange &change, const Bytes &bytes, const Field &field)
{
    if (field.address < change.address)
        return std::nullopt;
    const auto from = at(field.address - change.address);
    if (from + field.size > bytes.size())
        return std::nullopt;
    return rawFromBytes(field, ByteView(bytes).subspan(from, field.size));
}

std::optional<std::int64_t> readingOf(const Field &field, std::span<const PollValue> values)
{
    const Bytes bytes = bytesIn(values, field.address, field.size);
    return bytes.empty() ? std::nullopt : std::optional(rawFromBytes(field, bytes));
}

} // namespace

bool isLostAtPowerOff(const ControlTable &table, const Field &field)
{
    const bool isVolatile = field.area == Area::Ram || field.area == Area::Hybrid;
    const bool acts = isGoal(field) || isIndirectData(field) || &field == table.find(Known::TorqueEnable)
        || field.name.startsWith(QLatin1String("LED")) || field.name.startsWith(QLatin1String("External Port Data"))
        || field.name.endsWith(QLatin1String(" Offset")); // Y: added to what the controllers follow
    return isVolatile && field.isWritable() && !acts && field.name != HybridSave;
}

bool RamMarks::take(const ControlTable &table, const JournalEntry &entry)
{
    const bool mayBeThere = entry.state == JournalState::Done || entry.state == JournalState::Unconfirmed;
    if (entry.kind != JournalKind::Write || !mayBeThere)
        return false;
    const auto count = m_marks.size();
    bool changed = false;
    const bool isRevert = entry.undoes > 0 || entry.redoes > 0; // puts back all that it names
    for (std::size_t i = 0; i < entry.changes.size(); ++i) {
        const RegisterChange &change = entry.changes[i];
        const Bytes &now = change.shown.empty() ? change.after : change.shown;
        for (const Field &field : table.fields()) {
            const auto raw = partOf(change, now, field);
            const int index = table.indexOf(&field);
            if (!raw || (i > 0 && change.shown.empty()))
                continue;
            if (field.name == HybridSave && entry.state == JournalState::Done) {
                std::erase_if(m_marks, [&table](const auto &mark) {
                    return table.fields()[at(mark.first)].area == Area::Hybrid;
                });
            } else if (isLostAtPowerOff(table, field) && (i == 0 || isRevert)) {
                const RamMark *known = find(index);
                const bool isKnown = entry.state == JournalState::Done || !change.shown.empty();
                if (known && known->isLost && !isKnown)
                    continue; // nobody knows whether it has arrived: it stays on offer
                written(field, index, *raw, partOf(change, change.before, field), entry.number);
                changed = true;
            } else if (isLostAtPowerOff(table, field)) { // the servo itself did that: another mode, another gain
                m_marks.erase(index);
            }
        }
    }
    return changed || count != m_marks.size();
}

void RamMarks::written(const Field &field, int index, std::int64_t raw, std::optional<std::int64_t> before,
                       qint64 number)
{
    RamMark mark{raw, before, number, false};
    if (const RamMark *known = find(index))
        mark.before = known->before;
    if (raw == initialOf(field) || raw == mark.before)
        m_marks.erase(index);
    else
        m_marks.insert_or_assign(index, mark);
}

const RamMark *RamMarks::find(int field) const
{
    const auto found = m_marks.find(field);
    return found == m_marks.end() ? nullptr : &found->second;
}

std::vector<int> RamMarks::set() const
{
    std::vector<int> fields;
    for (const auto &[field, mark] : m_marks) {
        if (!mark.isLost)
            fields.push_back(field);
    }
    return fields;
}

std::vector<int> RamMarks::lost() const
{
    std::vector<int> fields;
    for (const auto &[field, mark] : m_marks) {
        if (mark.isLost)
            fields.push_back(field);
    }
    std::ranges::stable_sort(fields, {}, [this](int field) { return m_marks.at(field).number; });
    return fields;
}

std::vector<SetReading> RamMarks::readings(const ControlTable &table, std::span<const PollValue> values) const
{
    std::vector<SetReading> readings;
    for (const auto &[index, mark] : m_marks) {
        const Field &field = table.fields()[at(index)];
        const auto now = readingOf(field, values);
        const auto initial = initialOf(field);
        if (now && !mark.isLost)
            readings.push_back({*now, mark.set, initial ? initial : mark.before});
    }
    return readings;
}

int RamMarks::restarted(const ControlTable &table, std::span<const PollValue> values)
{
    int lost = 0;
    for (auto &[index, mark] : m_marks) {
        const auto now = readingOf(table.fields()[at(index)], values);
        if (mark.isLost || !now || *now == mark.set)
            continue;
        mark.isLost = true;
        mark.before = now;
        ++lost;
    }
    return lost;
}

bool RamMarks::dropChanged(const ControlTable &table, std::span<const PollValue> values)
{
    return std::erase_if(m_marks, [&](const auto &mark) {
        const auto now = readingOf(table.fields()[at(mark.first)], values);
        return !mark.second.isLost && now && *now != mark.second.set;
    }) > 0;
}

void RamMarks::recovered(int field)
{
    if (const auto mark = m_marks.find(field); mark != m_marks.end())
        mark->second.isLost = false;
}

bool RamMarks::dropLost()
{
    return std::erase_if(m_marks, [](const auto &mark) { return mark.second.isLost; }) > 0;
}

} // namespace dynascope
