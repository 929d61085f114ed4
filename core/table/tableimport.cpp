// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/table/tableimport.h"

#include "core/table/catalog.h"
#include "core/table/cellrows.h"
#include "core/table/jsonguard.h"
#include "core/table/tablewriter.h"
#include "core/table/units.h"

#include <QHash>
#include <QMap>
#include <QSet>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dynascope {
namespace {

constexpr qsizetype MostColumns = 64; ///< further ones are nobody's: a name is looked up in each row
constexpr std::size_t MostRows = 2000;
constexpr qsizetype LongestName = 80;

/// Collects what is found and refuses what can't be, with the line.
class Importer
{
public:
    Importer(QString fileName, ImportOptions options) : m_fileName(std::move(fileName)), m_options(std::move(options))
    {
    }

    Result<ImportedTable> fromModel(const QByteArray &text);
    Result<ImportedTable> fromCsv(const QByteArray &text);

private:
    std::vector<CellRow> rows(const QByteArray &text, QChar separator);
    void typeInfo(const CellRow &row, double &zero, double &lowest, double &lowestRadian) const;
    void unitInfo(const CellRow &row, const QStringList &header);
    void takeUnit(Field &field, double value, const QString &unit, int line);
    void controlRow(const CellRow &row);
    void csvRow(const CellRow &row, const QStringList &header);
    Bound bound(const QString &text, int line);
    std::int64_t number(const QString &text, std::int64_t low, std::int64_t high, const QString &what, int line);
    void add(const Field &field, int line, bool aliasesAllowed);
    void applyUnits();
    Result<ImportedTable> finished();
    void note(const QString &text) { m_notes.append(text); }
    void say(int line, const QString &what);
    QString modelName() const;

    struct UnitRow {
        int line = 0;
        double value = 1;
        QString unit;
        bool isSigned = false;
    };

    QString m_fileName;
    ImportOptions m_options;
    WrittenModel m_model;
    QMap<QString, UnitRow> m_units; ///< by register
    QSet<QString> m_names;          ///< normalized
    QHash<int, QString> m_owners;   ///< registers by the addresses of their bytes
    QStringList m_notes;
    QString m_wrong;
};

std::vector<CellRow> Importer::rows(const QByteArray &text, QChar separator)
{
    if (text.size() > MaximumTableFileSize)
        say(0, QStringLiteral("larger than %1 bytes").arg(MaximumTableFileSize));
    if (!m_wrong.isEmpty())
        return {};
    std::vector<CellRow> all = cellRows(text, separator, MostRows + 1);
    if (all.size() > MostRows) {
        say(all.back().line, QStringLiteral("more than %1 lines").arg(MostRows));
        all.clear();
    }
    return all;
}

// --- ".model" -------------------------------------------------------------------------------------------------------

Result<ImportedTable> Importer::fromModel(const QByteArray &text)
{
    QString section;
    QStringList header;
    double zero = 0, lowest = 0, lowestRadian = 0;
    for (const CellRow &row : rows(text, u'\t')) {
        const QString first = row.cells.value(0);
        if (first.startsWith(u'[')) {
            section = first.toLower();
            header.clear();
        } else if (header.isEmpty()) {
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

void Importer::typeInfo(const CellRow &row, double &zero, double &lowest, double &lowestRadian) const
{
    const QString name = row.cells.value(0);
    const double value = row.cells.value(1).toDouble();
    if (name == u"value_of_zero_radian_position")
        zero = value;
    else if (name == u"value_of_min_radian_position")
        lowest = value;
    else if (name == u"min_radian")
        lowestRadian = value;
}

void Importer::unitInfo(const CellRow &row, const QStringList &header)
{
    const auto cell = [&](const char16_t *name) { return row.cells.value(header.indexOf(QStringView(name))); };
    UnitRow unit;
    unit.line = row.line;
    bool ok = false;
    unit.value = cell(u"value").toDouble(&ok);
    unit.unit = cell(u"unit");
    unit.isSigned = cell(u"Sign Type").startsWith(u"signed", Qt::CaseInsensitive);
    if (!ok || !std::isfinite(unit.value))
        return say(row.line, QStringLiteral("\"%1\" is no number").arg(cell(u"value")));
    const double offset = cell(u"Offset").toDouble();
    if (offset != 0)
        note(QStringLiteral("line %1: the offset of %2 is left out").arg(row.line).arg(row.cells.value(0)));
    m_units.insert(row.cells.value(0), unit);
}

void Importer::controlRow(const CellRow &row)
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

void Importer::applyUnits()
{
    for (auto it = m_units.constBegin(); it != m_units.constEnd(); ++it) {
        const auto field = std::find_if(m_model.fields.begin(), m_model.fields.end(),
                                        [&](const Field &candidate) { return candidate.name == it.key(); });
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
        if (field.unit == Unit::Pulse && m_model.resolution <= 0) {
            field.unit = Unit::None;
            field.scale = 1;
        }
    }
}

void Importer::takeUnit(Field &field, double value, const QString &unit, int line)
{
    constexpr double RevPerMin = 60 / (2 * std::numbers::pi);
    const QString plain = unit.toLower();
    if (plain == u"rad" && value > 0) {
        // Radians for a step are steps for a turn.
        if (m_model.resolution == 0)
            m_model.resolution = static_cast<int>(std::min(1e8, std::round(2 * std::numbers::pi / value)));
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

// --- CSV ------------------------------------------------------------------------------------------------------------

Result<ImportedTable> Importer::fromCsv(const QByteArray &text)
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

void Importer::csvRow(const CellRow &row, const QStringList &header)
{
    const auto cell = [&](const char16_t *name) { return row.cells.value(header.indexOf(QStringView(name))); };
    Field field;
    field.address =
        static_cast<std::uint16_t>(number(cell(u"address"), 0, 65535, QStringLiteral("the address"), row.line));
    field.size = static_cast<std::uint8_t>(number(cell(u"size"), 1, 4, QStringLiteral("the size"), row.line));
    field.name = cell(u"name");
    field.isSigned = cell(u"signed") == u"1";
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
    QString unit = cell(u"unit");
    unit.remove(u'^');
    if (const std::optional<Unit> known = unitFromTable(unit)) {
        field.unit = *known;
        bool ok = false;
        const double scale = cell(u"scale").toDouble(&ok);
        field.scale = ok ? scale : 1.0;
    } else if (!unit.isEmpty()) {
        note(QStringLiteral("line %1: %2 stays a bare number: the unit %3 isn't known here")
                 .arg(row.line)
                 .arg(field.name, unit));
    }
    add(field, row.line, false);
}

Bound Importer::bound(const QString &text, int line)
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

// --- Both -----------------------------------------------------------------------------------------------------------

std::int64_t Importer::number(const QString &text, std::int64_t low, std::int64_t high, const QString &what, int line)
{
    bool ok = false;
    const qlonglong value = text.toLongLong(&ok);
    if (ok && value >= low && value <= high)
        return value;
    say(line, QStringLiteral("%1 is \"%2\"; it must be a number from %3 to %4").arg(what, text).arg(low).arg(high));
    return low;
}

void Importer::add(const Field &field, int line, bool aliasesAllowed)
{
    // Quotes and what is no character could not be written as a key that anybody may read again.
    const bool printable = std::all_of(field.name.begin(), field.name.end(),
                                       [](QChar c) { return c.isPrint() && c != u'"' && c != u'\\' && c != u'#'; });
    if (normalizedName(field.name).isEmpty() || field.name.size() > LongestName || !printable)
        return say(line, QStringLiteral("\"%1\" is not a name for a register").arg(field.name.left(LongestName)));
    if (field.size == 3)
        return say(line, QStringLiteral("%1: the size must be 1, 2 or 4").arg(field.name));
    // Drivers give one register several names.
    for (int address = field.address; address < field.end(); ++address) {
        const QString owner = m_owners.value(address);
        if (owner.isEmpty())
            continue;
        if (aliasesAllowed)
            return note(
                QStringLiteral("line %1: %2 is left out: it lies where %3 is").arg(line).arg(field.name, owner));
        return say(line, QStringLiteral("%1: overlaps %2").arg(field.name, owner));
    }
    if (m_names.contains(normalizedName(field.name)))
        return say(line, QStringLiteral("%1: stands twice").arg(field.name));
    m_names.insert(normalizedName(field.name));
    for (int address = field.address; address < field.end(); ++address)
        m_owners.insert(address, field.name);
    m_model.fields.push_back(field);
}

QString Importer::modelName() const
{
    if (!m_options.name.isEmpty())
        return m_options.name;
    QString name = m_fileName.mid(m_fileName.lastIndexOf(u'/') + 1).section(u'.', 0, 0).toUpper();
    return name.replace(u'_', u'-').left(40);
}

Result<ImportedTable> Importer::finished()
{
    m_model.name = modelName();
    m_model.number = m_options.number;
    m_model.series = QStringLiteral("Own");
    const bool named = std::all_of(m_model.name.begin(), m_model.name.end(),
                                   [](QChar c) { return c.isPrint() && c != u'"' && c != u'\\'; });
    if (m_wrong.isEmpty() && m_model.fields.empty())
        say(0, QStringLiteral("there is no register in it"));
    if (m_wrong.isEmpty() && (m_model.number < 0 || m_model.number > 65535))
        say(0, QStringLiteral("the number of the model isn't in it: give --number"));
    if (m_wrong.isEmpty() && !named)
        say(0, QStringLiteral("\"%1\" is not a name for a model: give --name").arg(m_model.name));
    if (!m_wrong.isEmpty())
        return failure(ErrorKind::BadFile, m_wrong);
    ImportedTable table{tableFileOf(m_model), m_notes};
    // What doesn't fit together is said by who says it of every file.
    Catalog alone;
    const Result<void> added = alone.add(table.json, m_fileName);
    if (!added)
        return failure(ErrorKind::BadFile, added.error().text + QStringLiteral(" (line of what was made of it)"));
    return table;
}

void Importer::say(int line, const QString &what)
{
    const QString place = line > 0 ? QStringLiteral("line %1: ").arg(line) : QString();
    if (m_wrong.isEmpty())
        m_wrong = QStringLiteral("%1: %2%3").arg(m_fileName, place, what);
}

} // namespace

Result<ImportedTable> importModelFile(const QByteArray &text, const QString &fileName, const ImportOptions &options)
{
    return Importer(fileName, options).fromModel(text);
}

Result<ImportedTable> importCsv(const QByteArray &text, const QString &fileName, const ImportOptions &options)
{
    return Importer(fileName, options).fromCsv(text);
}

Result<ImportedTable> importTable(const QByteArray &text, const QString &fileName, const ImportOptions &options)
{
    const bool sections = text.left(200).trimmed().startsWith('[');
    return sections ? importModelFile(text, fileName, options) : importCsv(text, fileName, options);
}

} // namespace dynascope
