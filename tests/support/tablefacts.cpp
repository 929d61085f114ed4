// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/tablefacts.h"

#include "core/table/units.h"

#include <QFile>

namespace dynascope::test {
namespace {

QString boundText(const Bound &bound)
{
    if (bound.number)
        return QString::number(*bound.number);
    return (bound.negated ? QStringLiteral("-") : QString()) + bound.reg;
}

QString areaText(Area area)
{
    switch (area) {
    case Area::Eeprom: return QStringLiteral("EEPROM");
    case Area::Ram: return QStringLiteral("RAM");
    case Area::Hybrid: return QStringLiteral("HYBRID");
    case Area::Unknown: break;
    }
    return {};
}

/// "56..58" is from 56 on in as many equal steps as there are registers.
QString stepped(const QString &text, int index, int count)
{
    const QStringList ends = text.split(QStringLiteral(".."));
    if (ends.size() != 2 || count < 2)
        return text;
    const int from = ends[0].toInt(), step = (ends[1].toInt() - from) / (count - 1);
    return QString::number(from + index * step);
}

} // namespace

std::vector<FactRow> factRows(const QString &name)
{
    QFile file(QStringLiteral(DYNASCOPE_SOURCE_DIR "/tests/data/tables/%1.csv").arg(name));
    if (!file.open(QIODevice::ReadOnly))
        qFatal("no facts: %s", qPrintable(name));
    const QStringList lines = QString::fromUtf8(file.readAll()).split(u'\n', Qt::SkipEmptyParts);
    const QStringList columns = lines.value(0).split(u',');
    std::vector<FactRow> rows;
    for (const QString &line : lines.mid(1)) {
        const QStringList cells = line.split(u',');
        FactRow row;
        for (qsizetype i = 0; i < columns.size(); ++i) // the last column is a sentence, perhaps with commas
            row[columns[i]] = i + 1 == columns.size() ? cells.mid(i).join(u',') : cells.value(i);
        rows.push_back(row);
    }
    return rows;
}

std::vector<FactRow> registerRows(const QString &name)
{
    std::vector<FactRow> rows;
    for (const FactRow &row : factRows(name)) {
        const QString text = row[QStringLiteral("name")];
        const QString numbers = text.mid(text.lastIndexOf(u' ') + 1);
        const QStringList ends = numbers.split(QStringLiteral(".."));
        if (ends.size() != 2) {
            rows.push_back(row);
            continue;
        }
        const int first = ends[0].toInt(), count = ends[1].toInt() - first + 1;
        for (int i = 0; i < count; ++i) {
            FactRow one = row;
            one[QStringLiteral("name")] = text.chopped(numbers.size()) + QString::number(first + i);
            for (const QString &column : {QStringLiteral("address"), QStringLiteral("initial")})
                one[column] = stepped(row[column], i, count);
            rows.push_back(one);
        }
    }
    return rows;
}

FactRow factsOf(const Field &field)
{
    FactRow row;
    row[QStringLiteral("address")] = QString::number(field.address);
    row[QStringLiteral("size")] = QString::number(field.size);
    row[QStringLiteral("name")] = field.name;
    row[QStringLiteral("area")] = areaText(field.area);
    row[QStringLiteral("access")] = field.isWritable()   ? QStringLiteral("RW")
                                    : field.mayBeTried() ? QString()
                                                         : QStringLiteral("R");
    row[QStringLiteral("initial")] = field.initial ? QString::number(*field.initial) : QString();
    row[QStringLiteral("min")] = boundText(field.minimum);
    row[QStringLiteral("max")] = boundText(field.maximum);
    row[QStringLiteral("unit")] = tableUnit(field.unit);
    row[QStringLiteral("scale")] = field.unit == Unit::None ? QString() : QString::number(field.scale, 'g', 12);
    row[QStringLiteral("signed")] = QString::number(field.isSigned ? 1 : 0);
    return row;
}

} // namespace dynascope::test
