// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/groupwrite.h"

#include <QCoreApplication>

#include <algorithm>

namespace dynascope {
namespace {

struct GroupWriteText {
    Q_DECLARE_TR_FUNCTIONS(GroupWrite)
};

tl::unexpected<Error> refusedWrite(const QString &text)
{
    return failure(ErrorKind::InvalidArgument, GroupWriteText::tr("%1; nothing was written").arg(text));
}

/// The registers of a stretch, each with how far in it begins.
QString meaningOf(const ControlTable &table, int address, int length)
{
    QStringList parts;
    for (const Field &field : table.fields()) {
        if (field.address >= address + length || field.end() <= address)
            continue;
        const int in = field.address - address;
        parts << (in == 0 ? field.name : GroupWriteText::tr("%1 at %2").arg(field.name).arg(field.address));
    }
    return parts.isEmpty() ? GroupWriteText::tr("no register") : parts.join(QStringLiteral(", "));
}

} // namespace

Result<std::vector<SpanData>> planGroupWrite(const std::vector<GroupMember> &members, QStringView registerName,
                                             std::int64_t raw)
{
    std::vector<SpanData> writes;
    for (const GroupMember &member : members) {
        const Field *field = member.table ? member.table->find(registerName) : nullptr;
        if (!field)
            return refusedWrite(GroupWriteText::tr("%1 has no register %2").arg(member.name, registerName));
        if (!field->isWritable())
            return refusedWrite(GroupWriteText::tr("%1: %2 can only be read").arg(member.name, field->name));
        const bool isAllowed =
            field->values.empty() || std::ranges::find(field->values, raw, &EnumValue::value) != field->values.end();
        if (raw < smallestRaw(*field) || raw > largestRaw(*field) || !isAllowed)
            return refusedWrite(GroupWriteText::tr("%1: %2 can't be %3").arg(member.name, field->name).arg(raw));
        writes.push_back({member.id, field->address, bytesFromRaw(*field, raw)});
    }
    return writes;
}

Result<void> checkSameMeaning(const std::vector<GroupMember> &members, int address, int length)
{
    const GroupMember *first = nullptr;
    for (const GroupMember &member : members) {
        if (!member.table || member.table->description().isRaw)
            continue;
        if (!first) {
            first = &member;
            continue;
        }
        const QString here = meaningOf(*first->table, address, length);
        const QString there = meaningOf(*member.table, address, length);
        const Field *one = first->table->at(address), *other = member.table->at(address);
        const bool isAsLong = !one || !other || one->size == other->size || one->size >= length;
        if (here != there || !isAsLong) {
            return refusedWrite(GroupWriteText::tr("%1:%2 is %3 of %4, and %5 of %6: write to each by itself")
                                    .arg(address)
                                    .arg(length)
                                    .arg(here, first->name, there, member.name));
        }
    }
    return {};
}

} // namespace dynascope
