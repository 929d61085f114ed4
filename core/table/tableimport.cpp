// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/table/tableimport.h"

#include "core/table/catalog.h"
#include "core/table/jsonguard.h"
#include "core/table/tableimporter.h"

#include <algorithm>

namespace dynascope {

namespace {

constexpr std::size_t MostRows = 2000;
constexpr qsizetype LongestName = 80;

} // namespace

std::vector<CellRow> TableImporter::rows(const QByteArray &text, QChar separator)
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
    // Remarks of people; no register's row begins so.
    all.erase(
        std::remove_if(all.begin(), all.end(), [](const CellRow &row) { return row.cells.value(0).startsWith(u'#'); }),
        all.end());
    return all;
}

std::int64_t TableImporter::number(const QString &text, std::int64_t low, std::int64_t high, const QString &what,
                                   int line)
{
    bool ok = false;
    const qlonglong value = text.toLongLong(&ok);
    if (ok && value >= low && value <= high)
        return value;
    say(line, QStringLiteral("%1 is \"%2\"; it must be a number from %3 to %4").arg(what, text).arg(low).arg(high));
    return low;
}

void TableImporter::add(const Field &field, int line, bool aliasesAllowed)
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
        if (aliasesAllowed) {
            m_aliases.insert(field.name, line);
            return note(
                QStringLiteral("line %1: %2 is left out: it lies where %3 is").arg(line).arg(field.name, owner));
        }
        return say(line, QStringLiteral("%1: overlaps %2").arg(field.name, owner));
    }
    if (m_names.contains(normalizedName(field.name)))
        return say(line, QStringLiteral("%1: stands twice").arg(field.name));
    m_names.insert(normalizedName(field.name));
    m_lines.insert(field.name, line);
    for (int address = field.address; address < field.end(); ++address)
        m_owners.insert(address, field.name);
    m_model.fields.push_back(field);
}

QString TableImporter::modelName() const
{
    if (!m_options.name.isEmpty())
        return m_options.name;
    QString name = m_fileName.mid(m_fileName.lastIndexOf(u'/') + 1).section(u'.', 0, 0).toUpper();
    return name.replace(u'_', u'-').left(40);
}

Result<ImportedTable> TableImporter::finished()
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
        return failure(ErrorKind::BadFile, inItsOwnLine(added.error().text, table.json));
    return table;
}

/// What is said of a line of the table that was made, said of the line it was made of.
QString TableImporter::inItsOwnLine(const QString &error, const QByteArray &json) const
{
    const QString before = m_fileName + QStringLiteral(": line ");
    if (!error.startsWith(before))
        return error;
    const QString rest = error.sliced(before.size());
    const qsizetype digits = rest.indexOf(u':');
    const QByteArray made = json.split('\n').value(rest.left(digits).toInt() - 1).trimmed();
    for (auto it = m_lines.constBegin(); it != m_lines.constEnd(); ++it) {
        if (made.startsWith('"' + it.key().toUtf8() + "\":"))
            return before + QString::number(it.value()) + rest.mid(digits);
    }
    return error + QStringLiteral(" (line of what was made of it)");
}

void TableImporter::say(int line, const QString &what)
{
    const QString place = line > 0 ? QStringLiteral("line %1: ").arg(line) : QString();
    if (m_wrong.isEmpty())
        m_wrong = QStringLiteral("%1: %2%3").arg(m_fileName, place, what);
}

Result<ImportedTable> importModelFile(const QByteArray &text, const QString &fileName, const ImportOptions &options)
{
    return TableImporter(fileName, options).fromModel(text);
}

Result<ImportedTable> importCsv(const QByteArray &text, const QString &fileName, const ImportOptions &options)
{
    return TableImporter(fileName, options).fromCsv(text);
}

Result<ImportedTable> importTable(const QByteArray &text, const QString &fileName, const ImportOptions &options)
{
    const QByteArray mark = "\xEF\xBB\xBF"; // some editors put it in front of UTF-8
    const QByteArray bare = text.startsWith(mark) ? text.mid(mark.size()) : text;
    const bool sections =
        fileName.endsWith(QStringLiteral(".model"), Qt::CaseInsensitive) || bare.left(200).trimmed().startsWith('[');
    return sections ? importModelFile(bare, fileName, options) : importCsv(bare, fileName, options);
}

} // namespace dynascope
