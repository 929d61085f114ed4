// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/table/rawtable.h"

namespace dynascope {
namespace {

Field byteAt(int address)
{
    Field field;
    field.address = static_cast<std::uint16_t>(address);
    field.size = 1;
    field.name = QStringLiteral("Byte %1").arg(address);
    field.area = Area::Unknown;
    field.access = Access::Unknown;
    return field;
}

QString suggestion(const Field &field, const ControlTable &lower, const ControlTable &upper)
{
    const QString bytes = field.size == 1 ? QStringLiteral("1 byte") : QStringLiteral("%1 bytes").arg(field.size);
    return QStringLiteral("Only a guess: %1 and %2, the models numbered next to this one, have %3 here (%4).")
        .arg(lower.model(), upper.model(), field.name, bytes);
}

} // namespace

ControlTablePtr rawTable(int modelNumber, const QString &name, const ControlTablePtr &lower,
                         const ControlTablePtr &upper)
{
    ControlTable::Description description;
    description.modelNumber = static_cast<std::uint16_t>(modelNumber);
    description.model = name;
    description.isRaw = true;
    description.resolution = 0;
    description.doubt = QStringLiteral("Nothing is known of this model: its bytes are shown as they are, and what they "
                                       "mean and whether they may be written is unknown.");
    description.fields.reserve(RawTableSize);
    for (int address = 0; address < RawTableSize; ++address)
        description.fields.push_back(byteAt(address));
    for (const Field &field : lower &&upper ? lower->fields() : std::span<const Field>()) {
        const Field *same = upper->at(field.address);
        const bool indirect = field.name.startsWith(u"Indirect ");
        if (!same || same->name != field.name || same->size != field.size || indirect || field.address >= RawTableSize)
            continue;
        Field &byte = description.fields[field.address];
        byte.suggested = field.name;
        byte.help = suggestion(field, *lower, *upper);
    }
    return std::make_shared<const ControlTable>(std::move(description));
}

} // namespace dynascope
