// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/backup/comparebackups.h"

#include "core/session/profile/profile.h"
#include "core/session/texts.h"

#include <algorithm>
#include <array>
#include <set>

namespace dynascope {
namespace {

ComparedRegister oneSided(const Backup &backup, const BackupRegister &one, bool isHere)
{
    const Field &field = backup.fieldOf(one);
    ComparedRegister row;
    row.name = field.name;
    row.use = backupUse(*backup.table, field);
    row.state = isHere ? ComparedRegister::State::OnlyHere : ComparedRegister::State::OnlyThere;
    (isHere ? row.here : row.there) = one.raw;
    (isHere ? row.hereText : row.thereText) = backup.text(one);
    return row;
}

ComparedRegister bothSided(const Backup &here, const BackupRegister &one, const Backup &there,
                           const BackupRegister &other)
{
    ComparedRegister row = oneSided(here, one, true);
    row.there = other.raw;
    row.thereText = there.text(other);
    row.why = otherMeaning(*here.table, here.fieldOf(one), *there.table, there.fieldOf(other), one.raw, here.lookup());
    row.state = !row.why.isEmpty()     ? ComparedRegister::State::OtherMeaning
                : one.raw == other.raw ? ComparedRegister::State::Same
                                       : ComparedRegister::State::Differs;
    return row;
}

/// A bit that is set and has a name here, but none there; empty: there is none.
QString unknownBit(const Field &from, const Field &to, std::int64_t raw)
{
    for (const BitField &bit : from.bits) {
        const bool isKnown = std::ranges::any_of(
            to.bits, [&](const BitField &other) { return (other.mask() & bit.mask()) == bit.mask(); });
        if ((raw & bit.mask()) != 0 && !isKnown)
            return bit.name;
    }
    return {};
}

std::map<int, std::uint8_t> bytesOf(const Backup &backup)
{
    std::map<int, std::uint8_t> all;
    for (const BackupBytes &stretch : backup.bytes) {
        for (std::size_t i = 0; i < stretch.bytes.size(); ++i)
            all[stretch.address + static_cast<int>(i)] = stretch.bytes[i];
    }
    return all;
}

/// What isn't there in a backup of a known model was 0, or was not read.
void compareBytes(const Backup &here, const Backup &there, std::vector<ComparedRegister> &rows)
{
    const std::map<int, std::uint8_t> mine = bytesOf(here), others = bytesOf(there);
    std::set<int> addresses;
    for (const auto &[address, byte] : mine)
        addresses.insert(address);
    for (const auto &[address, byte] : others)
        addresses.insert(address);
    for (const int address : addresses) {
        const auto one = mine.find(address), other = others.find(address);
        ComparedRegister row;
        row.name = BackupText::tr("Byte %1").arg(address);
        row.here = one == mine.end() ? 0 : one->second;
        row.there = other == others.end() ? 0 : other->second;
        if (row.here == row.there)
            continue;
        row.hereText = QString::number(*row.here);
        row.thereText = QString::number(*row.there);
        row.state = ComparedRegister::State::Differs;
        row.use = BackupUse::Reading; // nobody knows what it is, so nothing hangs on it
        rows.push_back(std::move(row));
    }
}

} // namespace

BackupUse backupUse(const ControlTable &table, const Field &field)
{
    if (field.access == Access::Read)
        return field.area == Area::Eeprom ? BackupUse::Identity : BackupUse::Reading;
    switch (profileUse(table, field)) {
    case ProfileUse::Calibration: return BackupUse::Calibration;
    case ProfileUse::Place: return BackupUse::Place;
    case ProfileUse::Motion: return BackupUse::Motion;
    case ProfileUse::Order: return BackupUse::Order;
    case ProfileUse::Setting:
    case ProfileUse::State:
    case ProfileUse::ReadOnly: break; // the last: whose access isn't known
    }
    return BackupUse::Setting;
}

QString otherMeaning(const ControlTable &fromTable, const Field &from, const ControlTable &toTable, const Field &to,
                     std::int64_t raw, const RegisterLookup &lookup)
{
    if (&fromTable == &toTable)
        return {};
    const EffectiveField one = effective(from, lookup), other = effective(to, lookup);
    const bool isPulse = one.unit == Unit::Pulse && fromTable.resolution() != toTable.resolution();
    if (one.unit != other.unit || one.scale != other.scale || one.directionBit != other.directionBit || isPulse) {
        return BackupText::tr("%1 is %2 here and would be %3 there")
            .arg(raw)
            .arg(valueText(from, one, fromTable.resolution(), raw), valueText(to, other, toTable.resolution(), raw));
    }
    if (from.values.empty() && from.bits.empty())
        return {};
    if (const QString bit = unknownBit(from, to, raw); !bit.isEmpty())
        return BackupText::tr("its bit \"%1\" has no meaning there").arg(bit);
    const QString means = meaning(from, raw), wouldMean = meaning(to, raw);
    if (means.isEmpty() || wouldMean.isEmpty() || means == wouldMean)
        return {};
    return BackupText::tr("%1 is \"%2\" here and would be \"%3\" there").arg(QString::number(raw), means, wouldMean);
}

std::vector<ComparedRegister> compareBackups(const Backup &here, const Backup &there)
{
    std::vector<ComparedRegister> rows;
    std::set<int> seen;
    for (const BackupRegister &one : here.registers) {
        const BackupRegister *other = there.find(here.fieldOf(one).name);
        if (!other) {
            rows.push_back(oneSided(here, one, true));
            continue;
        }
        seen.insert(other->field);
        rows.push_back(bothSided(here, one, there, *other));
    }
    for (const BackupRegister &other : there.registers) {
        if (!seen.contains(other.field))
            rows.push_back(oneSided(there, other, false));
    }
    compareBytes(here, there, rows);
    return rows;
}

std::size_t countOf(const std::vector<ComparedRegister> &rows, ComparedRegister::State state)
{
    return static_cast<std::size_t>(std::ranges::count_if(
        rows, [&](const ComparedRegister &row) { return !row.isReading() && row.state == state; }));
}

QString wordOf(ComparedRegister::State state)
{
    constexpr std::array Words{"same", "differs", "only-here", "only-there", "other-meaning"};
    return QLatin1String(Words[static_cast<std::size_t>(state)]);
}

QString wordOf(BackupUse use)
{
    constexpr std::array Words{"setting", "calibration", "place", "motion", "order", "identity", "reading"};
    return QLatin1String(Words[static_cast<std::size_t>(use)]);
}

} // namespace dynascope
