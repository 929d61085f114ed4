// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/table/tablewriter.h"

#include "core/table/tablefile.h"
#include "core/table/units.h"

#include <QJsonArray>
#include <QJsonDocument>

#include <algorithm>

namespace dynascope {
namespace {

QByteArray quoted(const QString &text)
{
    const QByteArray list = QJsonDocument(QJsonArray{text}).toJson(QJsonDocument::Compact);
    return list.mid(1, list.size() - 2);
}

QByteArray numberText(double number)
{
    return QByteArray::number(number, 'g', 12);
}

QByteArray boundText(const Bound &bound)
{
    if (bound.number)
        return QByteArray::number(static_cast<qlonglong>(*bound.number));
    return quoted((bound.negated ? QStringLiteral("-") : QString()) + bound.reg);
}

QByteArray areaText(Area area)
{
    return area == Area::Eeprom ? "EEPROM" : area == Area::Ram ? "RAM" : "HYBRID";
}

QByteArray registerText(const Field &field)
{
    QByteArrayList members;
    members.append("\"address\": " + QByteArray::number(field.address));
    members.append("\"size\": " + QByteArray::number(field.size));
    if (field.isSigned)
        members.append("\"signed\": true");
    if (field.area != Area::Unknown)
        members.append("\"area\": \"" + areaText(field.area) + '"');
    if (field.access != Access::Unknown)
        members.append(field.isWritable() ? "\"access\": \"RW\"" : "\"access\": \"R\"");
    if (field.initial)
        members.append("\"initial\": " + QByteArray::number(static_cast<qlonglong>(*field.initial)));
    if (field.minimum.isSet() && field.maximum.isSet())
        members.append("\"range\": [" + boundText(field.minimum) + ", " + boundText(field.maximum) + ']');
    if (field.unit != Unit::None) {
        members.append("\"unit\": " + quoted(tableUnit(field.unit)));
        if (field.scale != 1.0)
            members.append("\"scale\": " + numberText(field.scale));
    }
    if (!field.doubt.isEmpty())
        members.append("\"doubt\": " + quoted(field.doubt));
    return quoted(field.name) + ": { " + members.join(", ") + " }";
}

} // namespace

QByteArray tableFileOf(const WrittenModel &model)
{
    std::vector<Field> fields = model.fields;
    std::stable_sort(fields.begin(), fields.end(),
                     [](const Field &a, const Field &b) { return a.address < b.address; });
    QByteArrayList registers;
    for (const Field &field : fields)
        registers.append("    " + registerText(field));
    QByteArrayList members;
    members.append("  \"format\": " + QByteArray::number(TableFormat));
    members.append("  \"series\": " + quoted(model.series));
    if (model.resolution > 0)
        members.append("  \"resolution\": " + QByteArray::number(model.resolution));
    if (!model.doubt.isEmpty())
        members.append("  \"doubt\": " + quoted(model.doubt));
    members.append("  \"registers\": {\n" + registers.join(",\n") + "\n  }");
    members.append("  \"models\": {\n    " + quoted(model.name) + ": { \"number\": " + QByteArray::number(model.number)
                   + " }\n  }");
    return "{\n" + members.join(",\n") + "\n}\n";
}

} // namespace dynascope
