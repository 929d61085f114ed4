// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/table/tableimporter.h"

#include "core/table/units.h"

namespace dynascope {

Result<ImportedTable> TableImporter::fromCsv(const QByteArray &text)
{
    QStringList header;
    for (const CellRow &row : rows(text, u',')) {
        if (!header.isEmpty()) {
            csvRow(row, header);
            continue;
        }
        header = row.cells.mid(0, MostColumns);
        for (const char16_t *needed : {u"address", u"size", u"name"}) {
            if (!header.contains(QStringView(needed))) {
                say(row.line,
                    QStringLiteral("the first line must name the columns: address, size, name and any of area, "
                                   "access, initial, min, max, unit, scale, signed"));
                break;
            }
        }
    }
    for (const Field &field : m_model.fields) {
        if (normalizedName(field.name) == u"modelnumber" && m_options.number < 0)
            m_options.number = static_cast<int>(field.initial.value_or(-1));
        // Nobody says here how many pulses a turn has.
        if (field.unit == Unit::Pulse && m_model.resolution == 0) {
            m_model.resolution = 4096;
            note(QStringLiteral("4096 pulses a turn are assumed; correct \"resolution\" where it is otherwise"));
        }
    }
    return finished();
}

void TableImporter::csvRow(const CellRow &row, const QStringList &header)
{
    const auto cell = [&](const char16_t *name) { return row.cells.value(header.indexOf(QStringView(name))); };
    Field field;
    field.address =
        static_cast<std::uint16_t>(number(cell(u"address"), 0, 65535, QStringLiteral("the address"), row.line));
    field.size = static_cast<std::uint8_t>(number(cell(u"size"), 1, 4, QStringLiteral("the size"), row.line));
    field.name = cell(u"name");
    const QString sign = cell(u"signed").toLower();
    field.isSigned = sign == u"1" || sign == u"yes" || sign == u"true";
    if (!field.isSigned && !sign.isEmpty() && sign != u"0" && sign != u"no" && sign != u"false")
        say(row.line, QStringLiteral("%1: \"%2\" is neither 1 nor 0, which signed must be").arg(field.name, sign));
    const QString area = cell(u"area").toUpper(), access = cell(u"access").toUpper();
    field.area = area == u"EEPROM"   ? Area::Eeprom
                 : area == u"RAM"    ? Area::Ram
                 : area == u"HYBRID" ? Area::Hybrid
                                     : Area::Unknown;
    field.access = access == u"RW" ? Access::ReadWrite : access == u"R" ? Access::Read : Access::Unknown;
    if (field.area == Area::Unknown && !area.isEmpty())
        say(row.line, QStringLiteral("%1: \"%2\" is neither EEPROM, RAM nor HYBRID").arg(field.name, area));
    if (field.access == Access::Unknown && !access.isEmpty())
        say(row.line, QStringLiteral("%1: \"%2\" is neither R nor RW").arg(field.name, access));
    constexpr std::int64_t Most = 0xFFFFFFFF;
    const QString initial = cell(u"initial").section(u';', 0, 0); // of several axes the first one's
    if (!initial.isEmpty())
        field.initial = number(initial, -Most, Most, QStringLiteral("the initial value"), row.line);
    field.minimum = bound(cell(u"min"), row.line);
    field.maximum = bound(cell(u"max"), row.line);
    if (field.minimum.isSet() != field.maximum.isSet()) {
        note(QStringLiteral("line %1: the range of %2 is left out: min and max must both be there")
                 .arg(row.line)
                 .arg(field.name));
    }
    csvUnit(row, header, field);
    add(field, row.line, false);
}

void TableImporter::csvUnit(const CellRow &row, const QStringList &header, Field &field)
{
    const auto cell = [&](const char16_t *name) { return row.cells.value(header.indexOf(QStringView(name))); };
    const QString scaleText = cell(u"scale");
    bool ok = true;
    const double scale = scaleText.isEmpty() ? 1.0 : scaleText.toDouble(&ok);
    if (!ok || !(scale >= 1e-9 && scale <= 1e9)) {
        return say(
            row.line,
            QStringLiteral("%1: the scale is \"%2\"; it must be a number from 1e-9 to 1e9").arg(field.name, scaleText));
    }
    QString unit = cell(u"unit");
    unit.remove(u'^');
    if (const std::optional<Unit> known = unitFromTable(unit)) {
        field.unit = *known;
        field.scale = scale;
    } else if (!unit.isEmpty()) {
        note(QStringLiteral("line %1: %2 stays a bare number: the unit %3 isn't known here")
                 .arg(row.line)
                 .arg(field.name, unit));
    } else if (scale != 1.0) {
        note(QStringLiteral("line %1: the scale of %2 is left out: it has no unit").arg(row.line).arg(field.name));
    }
}

Bound TableImporter::bound(const QString &text, int line)
{
    Bound bound;
    bool isNumber = false;
    const qlonglong value = text.toLongLong(&isNumber);
    if (text.isEmpty())
        return bound;
    if (isNumber)
        bound.number = value;
    else if (text.size() > 1) {
        bound.negated = text.startsWith(u'-');
        bound.reg = bound.negated ? text.mid(1) : text;
    } else
        say(line, QStringLiteral("\"%1\" is neither a number nor a register").arg(text));
    return bound;
}

} // namespace dynascope
