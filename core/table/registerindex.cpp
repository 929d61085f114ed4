// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/table/registerindex.h"

#include <algorithm>
#include <tuple>

namespace dynascope {
namespace {

constexpr int NoMatch = 5;

QStringList wordsOf(const QString &text)
{
    QStringList words;
    for (const QString &word : text.split(u' ', Qt::SkipEmptyParts))
        words.append(normalizedName(word));
    return words;
}

std::optional<int> numberIn(const QString &text)
{
    bool ok = false;
    const int number = text.toInt(&ok, text.startsWith(u"0x", Qt::CaseInsensitive) ? 16 : 10);
    return ok && number >= 0 && number <= 0xFFFF ? std::optional(number) : std::nullopt;
}

void addOwner(std::vector<RegisterIndex::Owner> &owners, const ControlTable::Description &table)
{
    const bool goesOn = !owners.empty() && owners.back().modelNumber == table.modelNumber
                        && owners.back().firmwareTo + 1 == table.firmwareFrom;
    if (goesOn)
        owners.back().firmwareTo = table.firmwareTo;
    else
        owners.push_back({table.modelNumber, table.firmwareFrom, table.firmwareTo});
}

} // namespace

void RegisterIndex::add(const ControlTable &table)
{
    for (const Field &field : table.fields()) {
        QList<std::size_t> &same = m_byName[field.name];
        const auto known = std::find_if(same.begin(), same.end(), [&](std::size_t index) {
            return m_entries[index].address == field.address && m_entries[index].size == field.size;
        });
        if (known != same.end()) {
            addOwner(m_entries[*known].owners, table.description());
            continue;
        }
        Kept entry;
        entry.name = field.name;
        entry.address = field.address;
        entry.size = field.size;
        entry.plain = normalizedName(field.name);
        entry.words = wordsOf(field.name);
        qsizetype digits = 0;
        while (digits < entry.plain.size() && entry.plain.at(entry.plain.size() - 1 - digits).isDigit())
            ++digits;
        entry.stem = entry.plain.chopped(digits);
        entry.number = digits > 0 && digits < 9 ? entry.plain.last(digits).toInt() : -1;
        addOwner(entry.owners, table.description());
        same.append(m_entries.size());
        m_entries.push_back(std::move(entry));
    }
}

std::vector<const RegisterIndex::Entry *> RegisterIndex::atAddress(int address) const
{
    std::vector<const Entry *> found;
    for (const Kept &entry : m_entries) {
        if (entry.address <= address && address < entry.address + entry.size)
            found.push_back(&entry);
    }
    std::sort(found.begin(), found.end(), [address](const Entry *a, const Entry *b) {
        return std::tuple(a->address != address, -static_cast<int>(a->owners.size()), a->name, a->size)
               < std::tuple(b->address != address, -static_cast<int>(b->owners.size()), b->name, b->size);
    });
    return found;
}

/// 0 is the very name, NoMatch none at all. `words` are normalized, as the name is.
int RegisterIndex::rank(const Kept &entry, const QString &wanted, const QStringList &words)
{
    if (entry.plain == wanted)
        return 0;
    if (entry.plain.startsWith(wanted))
        return 1;
    if (entry.plain.contains(wanted))
        return 2;
    const auto all = [&words](const auto &holds) { return std::all_of(words.begin(), words.end(), holds); };
    if (all([&](const QString &word) { return entry.words.contains(word); }))
        return 3;
    const auto isSomewhere = [&](const QString &word) {
        return entry.plain.contains(word) || numberIn(word) == int(entry.address);
    };
    return all(isSomewhere) ? 4 : NoMatch;
}

std::vector<const RegisterIndex::Entry *> RegisterIndex::find(const QString &text) const
{
    if (const std::optional<int> address = numberIn(text.trimmed()))
        return atAddress(*address);
    const QString wanted = normalizedName(text);
    if (wanted.isEmpty())
        return {};
    const QStringList words = wordsOf(text);
    std::vector<std::pair<int, const Kept *>> found;
    for (const Kept &entry : m_entries) {
        if (const int place = rank(entry, wanted, words); place < NoMatch)
            found.emplace_back(place, &entry);
    }
    std::sort(found.begin(), found.end(), [](const auto &a, const auto &b) {
        const auto key = [](const auto &one) {
            return std::tie(one.first, one.second->stem, one.second->number, one.second->name, one.second->address,
                            one.second->size);
        };
        return key(a) < key(b);
    });
    std::vector<const Entry *> entries;
    entries.reserve(found.size());
    for (const auto &one : found)
        entries.push_back(one.second);
    return entries;
}

} // namespace dynascope
