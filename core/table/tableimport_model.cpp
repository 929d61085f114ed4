// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/table/tableimporter.h"

#include "core/table/controltable.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dynascope {

Result<ImportedTable> TableImporter::fromModel(const QByteArray &text)
{
    QString section;
    QStringList header;
    double zero = 0, lowest = 0, lowestRadian = 0;
    for (const CellRow &row : rows(text, u'\t')) {
        const QString first = row.cells.value(0);
        if (first.startsWith(u'[')) {
            section = first.toLower();
            header.clear();
        } else if (header.isEmpty() && !section.isEmpty()) {
            header = row.cells.mid(0, MostColumns); // names the columns
        } else if (section == u"[type info]") {
            typeInfo(row, zero, lowest, lowestRadian);
        } else if (section == u"[unit info]") {
            unitInfo(row, header);
        } else if (section == u"[control table]") {
            controlRow(row);
        } else {
            say(row.line, QStringLiteral("not within [type info], [unit info] or [control table]"));
        }
    }
    const double turn = 2 * std::numbers::pi;
    if (lowestRadian < 0 && zero > lowest)
        m_model.resolution = static_cast<int>(std::min(1e8, std::round((zero - lowest) / -lowestRadian * turn)));
    applyUnits();
    m_model.doubt =
        QStringLiteral("Imported from %1, which doesn't say area, access and limits of registers.").arg(m_fileName);
    return finished();
}

void TableImporter::typeInfo(const CellRow &row, double &zero, double &lowest, double &lowestRadian)
{
    if (row.cells.size() < 2)
        return say(row.line, QStringLiteral("needs name and value, with a tab between"));
    const QString name = row.cells.value(0);
    const double value = row.cells.value(1).toDouble();
    if (name == u"value_of_zero_radian_position")
        zero = value;
    else if (name == u"value_of_min_radian_position")
        lowest = value;
    else if (name == u"min_radian")
        lowestRadian = value;
}

void TableImporter::unitInfo(const CellRow &row, const QStringList &header)
{
    const auto cell = [&](const char16_t *name) { return row.cells.value(header.indexOf(QStringView(name))); };
    if (row.cells.size() < 3)
        return say(row.line, QStringLiteral("needs name, value and unit, with tabs between"));
    UnitRow unit;
    unit.line = row.line;
    bool ok = false;
    unit.value = cell(u"value").toDouble(&ok);
    unit.unit = cell(u"unit");
    const QString sign = cell(u"Sign Type").toLower();
    unit.isSigned = sign == u"signed";
    if (!unit.isSigned && !sign.isEmpty() && sign != u"unsigned")
        return say(row.line, QStringLiteral("the sign type is \"%1\"; it must be signed or unsigned").arg(sign));
    if (!ok || !std::isfinite(unit.value))
        return say(row.line, QStringLiteral("\"%1\" is no number").arg(cell(u"value")));
    const double offset = cell(u"Offset").toDouble();
    if (offset != 0)
        note(QStringLiteral("line %1: the offset of %2 is left out").arg(row.line).arg(row.cells.value(0)));
    m_units.insert(row.cells.value(0), unit);
}

void TableImporter::controlRow(const CellRow &row)
{
    if (row.cells.size() < 3)
        return say(row.line, QStringLiteral("needs address, size and name, with tabs between"));
    Field field;
    field.address = static_cast<std::uint16_t>(number(row.cells[0], 0, 65535, QStringLiteral("the address"), row.line));
    field.size = static_cast<std::uint8_t>(number(row.cells[1], 1, 4, QStringLiteral("the size"), row.line));
    field.name = row.cells[2];
    field.area = Area::Unknown;
    field.access = Access::Unknown;
    add(field, row.line, true);
}

void TableImporter::applyUnits()
{
    for (auto it = m_units.constBegin(); it != m_units.constEnd(); ++it) {
        const auto field = std::find_if(m_model.fields.begin(), m_model.fields.end(),
                                        [&](const Field &candidate) { return candidate.name == it.key(); });
        if (field == m_model.fields.end() && m_aliases.contains(it.key())) {
            note(QStringLiteral("line %1: the unit of %2 is left out, as the register is: see line %3")
                     .arg(it->line)
                     .arg(it.key())
                     .arg(m_aliases[it.key()]));
            continue;
        }
        if (field == m_model.fields.end()) {
            note(QStringLiteral("line %1: the unit of %2 is left out: no such register follows")
                     .arg(it->line)
                     .arg(it.key()));
            continue;
        }
        field->isSigned = it->isSigned;
        takeUnit(*field, it->value, it->unit, it->line);
    }
    for (Field &field : m_model.fields) {
        // Files of X have no row for it: [type info] says what their positions are.
        const QString name = normalizedName(field.name);
        if (m_model.resolution > 0 && field.size == 4 && !m_units.contains(field.name)
            && (name == u"goalposition" || name == u"presentposition")) {
            field.isSigned = true;
            field.unit = Unit::Pulse;
        }
        if (field.unit == Unit::Pulse && m_model.resolution <= 0) {
            field.unit = Unit::None;
            field.scale = 1;
        }
    }
}

void TableImporter::takeUnit(Field &field, double value, const QString &unit, int line)
{
    constexpr double RevPerMin = 60 / (2 * std::numbers::pi);
    const QString plain = unit.toLower();
    if (!(value > 0)) {
        return note(
            QStringLiteral("line %1: %2 stays a bare number: its scale isn't above 0").arg(line).arg(field.name));
    }
    if (plain == u"rad") {
        // Radians for a step are steps for a turn.
        const int steps = static_cast<int>(std::min(1e8, std::round(2 * std::numbers::pi / value)));
        if (m_model.resolution == 0)
            m_model.resolution = steps;
        // A table has one resolution. Values are rounded: what is nearly the same is the same.
        if (std::abs(steps - m_model.resolution) > m_model.resolution / 200.0) {
            return note(QStringLiteral("line %1: %2 stays a bare number: it has %3 steps a turn, the others %4")
                            .arg(line)
                            .arg(field.name)
                            .arg(steps)
                            .arg(m_model.resolution));
        }
        field.unit = Unit::Pulse;
        return;
    }
    field.scale = value;
    if (plain == u"rad/s") {
        field.unit = Unit::RevPerMin;
        field.scale = QString::number(value * RevPerMin, 'g', 6).toDouble();
    } else if (plain == u"s") {
        field.unit = Unit::Millisecond;
        field.scale = value * 1000;
    } else if (plain == u"v") {
        field.unit = Unit::Volt;
    } else if (plain == u"a" || plain == u"ma") {
        field.unit = plain == u"a" ? Unit::Ampere : Unit::MilliAmpere;
    } else if (plain == u"%") {
        field.unit = Unit::Percent;
    } else if (plain != u"raw" && !plain.isEmpty()) {
        note(QStringLiteral("line %1: %2 stays a bare number: the unit %3 isn't known here")
                 .arg(line)
                 .arg(field.name, unit));
    }
    if (field.unit == Unit::None || !(field.scale >= 1e-9 && field.scale <= 1e9)) {
        field.unit = Unit::None;
        field.scale = 1;
    }
}

} // namespace dynascope
