// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/table/indirect.h"

#include <algorithm>

namespace dynascope {
namespace {

constexpr int LongRun = 8; ///< registers from here on are too many to read one by one

/// "Indirect Data 12" is "Indirect Data" and 12; −1 where no number ends the name.
std::pair<QStringView, int> split(QStringView name)
{
    const qsizetype space = name.lastIndexOf(u' ');
    const QStringView digits = name.sliced(space + 1);
    const bool isNumber = space > 0 && !digits.isEmpty() && digits.size() <= 5
                          && std::all_of(digits.begin(), digits.end(), [](QChar c) { return c >= u'0' && c <= u'9'; });
    return isNumber ? std::pair(name.first(space), digits.toInt()) : std::pair(name, -1);
}

int numberOf(const Field &field, QStringView kind)
{
    const auto [name, number] = split(field.name);
    return name == kind && number > 0 ? number : 0;
}

/// The register that covers this byte; nullptr where none does.
const Field *covering(const ControlTable &table, std::int64_t address)
{
    const std::span<const Field> fields = table.fields();
    const auto after = std::upper_bound(fields.begin(), fields.end(), address,
                                        [](std::int64_t wanted, const Field &field) { return wanted < field.address; });
    return after != fields.begin() && address < after[-1].end() ? &after[-1] : nullptr;
}

/// "Present Position, byte 2", "Present Position+2": the name, and the byte of it.
std::pair<QStringView, std::optional<int>> splitByte(QStringView text)
{
    for (const QStringView mark :
         {QStringView(u", byte"), QStringView(u",byte"), QStringView(u" byte"), QStringView(u"+"), QStringView(u",")}) {
        const qsizetype at = text.lastIndexOf(mark, -1, Qt::CaseInsensitive);
        if (at <= 0)
            continue;
        bool ok = false;
        const int byte = text.sliced(at + mark.size()).trimmed().toInt(&ok);
        if (ok && byte >= 0)
            return {text.first(at).trimmed(), byte};
    }
    return {text, std::nullopt};
}

} // namespace

int indirectAddressNumber(const Field &field)
{
    return numberOf(field, u"Indirect Address");
}

int indirectDataNumber(const Field &field)
{
    return numberOf(field, u"Indirect Data");
}

int indirectAddressOf(const ControlTable &table, const Field &data)
{
    const int number = indirectDataNumber(data);
    return number == 0 ? -1 : table.indexOf(QStringLiteral("Indirect Address %1").arg(number));
}

QString addressText(const ControlTable &table, std::int64_t address)
{
    const Field *field = covering(table, address);
    if (!field)
        return QString::number(address);
    return field->size == 1 ? field->name
                            : QStringLiteral("%1, byte %2").arg(field->name).arg(address - field->address);
}

Result<std::int64_t> parseAddress(const ControlTable &table, QStringView text)
{
    const QStringView plain = text.trimmed();
    bool isNumber = false;
    const bool isHex = plain.startsWith(u"0x", Qt::CaseInsensitive);
    const int number = isHex ? plain.sliced(2).toInt(&isNumber, 16) : plain.toInt(&isNumber, 10);
    if (isNumber)
        return number;
    const Field *field = table.find(plain);
    const auto [name, byte] = splitByte(plain);
    if (!field && byte)
        field = table.find(name);
    if (!field || plain.isEmpty()) {
        return failure(
            ErrorKind::InvalidArgument,
            QStringLiteral("%1 has no register \"%2\"; give one by name, or an address").arg(table.model(), plain));
    }
    const int offset = table.find(plain) ? 0 : byte.value_or(0);
    if (offset >= field->size) {
        return failure(ErrorKind::InvalidArgument,
                       field->size == 1 ? QStringLiteral("%1 has only byte 0").arg(field->name)
                                        : QStringLiteral("%1 has bytes 0 to %2").arg(field->name).arg(field->size - 1));
    }
    return field->address + offset;
}

std::vector<FieldRun> longRuns(const ControlTable &table)
{
    std::vector<FieldRun> runs;
    const std::span<const Field> fields = table.fields();
    const auto count = static_cast<int>(fields.size());
    for (int first = 0; first < count;) {
        const auto [name, number] = split(fields[static_cast<std::size_t>(first)].name);
        int last = first;
        while (number >= 0 && last + 1 < count) {
            const auto [nextName, nextNumber] = split(fields[static_cast<std::size_t>(last) + 1].name);
            if (nextName != name || nextNumber != number + last + 1 - first)
                break;
            ++last;
        }
        if (last - first + 1 >= LongRun)
            runs.push_back({name.toString(), first, last, number});
        first = last + 1;
    }
    return runs;
}

} // namespace dynascope
