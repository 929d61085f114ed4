// SPDX-License-Identifier: GPL-3.0-or-later
// What the library knows of one model: `dxl models show`.
#include "app/dxl/modelscommand.h"

#include "app/dxl/showvalue.h"
#include "core/table/motorturn.h"
#include "core/table/units.h"

namespace dynascope::dxl {

namespace {

QString boundText(const Bound &bound)
{
    if (bound.number)
        return QString::number(*bound.number);
    return (bound.negated ? QStringLiteral("-") : QString()) + bound.reg;
}

QString rangeText(const Field &field)
{
    if (!field.minimum.isSet() && !field.maximum.isSet())
        return {};
    return QStringLiteral("%1 to %2").arg(boundText(field.minimum), boundText(field.maximum));
}

QString unitText(const Field &field)
{
    if (field.unit == Unit::None)
        return {};
    return field.scale == 1.0 ? tableUnit(field.unit)
                              : QStringLiteral("%1 %2").arg(field.scale).arg(tableUnit(field.unit));
}

std::vector<Document> valueDocuments(const std::vector<EnumValue> &values)
{
    std::vector<Document> all;
    for (const EnumValue &value : values) {
        Document one;
        one.add("value", qint64(value.value)).add("text", value.text);
        all.push_back(one);
    }
    return all;
}

void addNames(Document &document, const Field &field)
{
    if (!field.values.empty())
        document.add("values", valueDocuments(field.values));
    if (!field.special.empty())
        document.add("special", valueDocuments(field.special));
    std::vector<Document> bits;
    for (const BitField &bit : field.bits) {
        Document one;
        one.add("name", bit.name).add("first", qint64(bit.first)).add("count", qint64(bit.count));
        if (!bit.values.empty())
            one.add("values", valueDocuments(bit.values));
        bits.push_back(one);
    }
    if (!bits.empty())
        document.add("bits", bits);
    if (field.gearRatio.isSet()) {
        document.add("gear_numerator", field.gearRatio.numerator)
            .add("gear_denominator", field.gearRatio.denominator);
    }
}

/// What the register becomes while another one has certain values.
std::vector<Document> alternateDocuments(const Field &field)
{
    std::vector<Document> all;
    for (const Alternate &alternate : field.alternates) {
        Document one;
        one.add("register", alternate.reg);
        constexpr std::uint32_t WholeRegister = 0xFFFFFFFF;
        if (alternate.mask != WholeRegister)
            one.add("mask", qint64(alternate.mask));
        std::vector<Document> values;
        for (const std::int64_t value : alternate.values) {
            Document each;
            values.push_back(each.add("value", qint64(value)));
        }
        one.add("values", values);
        if (alternate.minimum.isSet())
            one.add("minimum", boundText(alternate.minimum));
        if (alternate.maximum.isSet())
            one.add("maximum", boundText(alternate.maximum));
        if (alternate.unit != Unit::None)
            one.add("unit", tableUnit(alternate.unit)).add("scale", alternate.scale);
        if (alternate.directionBit >= 0)
            one.add("direction_bit", qint64(alternate.directionBit));
        all.push_back(one);
    }
    return all;
}

QString valuesText(const std::vector<EnumValue> &values)
{
    QStringList texts;
    for (const EnumValue &value : values)
        texts.append(QStringLiteral("%1 %2").arg(value.value).arg(value.text));
    return texts.join(QStringLiteral(", "));
}

/// The names of values and bits, on one line; empty where there are none.
QString namesText(const Field &field)
{
    QStringList parts;
    for (const std::vector<EnumValue> &values : {field.values, field.special}) {
        if (!values.empty())
            parts.append(valuesText(values));
    }
    for (const BitField &bit : field.bits) {
        const int last = bit.first + bit.count - 1;
        QString text = bit.count == 1 ? QStringLiteral("bit %1 %2").arg(bit.first).arg(bit.name)
                                      : QStringLiteral("bits %1-%2 %3").arg(bit.first).arg(last).arg(bit.name);
        if (!bit.values.empty())
            text += QStringLiteral(" (%1)").arg(valuesText(bit.values));
        parts.append(text);
    }
    if (field.gearRatio.isSet())
        parts.append(QStringLiteral("geared: %1 / %2").arg(field.gearRatio.denominator, field.gearRatio.numerator));
    return parts.join(QStringLiteral("; "));
}

Document registerDocument(const Field &field)
{
    Document document;
    document.add("name", field.name)
        .add("address", qint64(field.address))
        .add("size", qint64(field.size))
        .addFlag("signed", field.isSigned)
        .add("area", areaName(field.area))
        .add("access", accessName(field.access));
    if (field.initial)
        document.add("initial", qint64(*field.initial));
    if (field.minimum.isSet())
        document.add("minimum", boundText(field.minimum));
    if (field.maximum.isSet())
        document.add("maximum", boundText(field.maximum));
    if (field.unit != Unit::None)
        document.add("unit", tableUnit(field.unit)).add("scale", field.scale);
    if (field.directionBit >= 0)
        document.add("direction_bit", qint64(field.directionBit));
    if (!field.alternates.empty())
        document.add("alternates", alternateDocuments(field));
    addNames(document, field);
    if (!field.help.isEmpty())
        document.add("help", field.help);
    if (!field.doubt.isEmpty())
        document.add("doubt", field.doubt);
    return document;
}

QString registerLine(const Field &field)
{
    QString line = QStringLiteral("%1 %2 %3 %4 %5")
                       .arg(field.address, 5)
                       .arg((field.isSigned ? QStringLiteral("-") : QString()) + QString::number(field.size), 2)
                       .arg(areaName(field.area), -6)
                       .arg(accessName(field.access), -2)
                       .arg(field.name, -32);
    QStringList more;
    if (field.initial)
        more.append(QStringLiteral("= %1").arg(*field.initial));
    if (const QString range = rangeText(field); !range.isEmpty())
        more.append(range);
    if (const QString unit = unitText(field); !unit.isEmpty())
        more.append(unit);
    if (!field.doubt.isEmpty())
        more.append(QStringLiteral("(doubtful: %1)").arg(field.doubt));
    line += more.join(QStringLiteral(", "));
    while (line.endsWith(u' '))
        line.chop(1);
    if (const QString names = namesText(field); !names.isEmpty())
        line += QStringLiteral("\n%1 %2").arg(QString(), 18).arg(names);
    return line;
}

QString sinceText(const QString &what, int firmware)
{
    return firmware < 0 ? QStringLiteral("no %1").arg(what)
           : firmware == 0 ? what
                           : QStringLiteral("%1 from firmware %2").arg(what).arg(firmware);
}

/// What the whole device can do: "Fast reads from firmware 45, …".
QString abilitiesText(const ControlTable &table)
{
    const ControlTable::Description &model = table.description();
    QString text = QStringList{sinceText(QStringLiteral("fast reads"), model.fastReadsFrom),
                               sinceText(QStringLiteral("backup"), model.backupFrom),
                               sinceText(QStringLiteral("clear"), model.clearFrom)}
                       .join(QStringLiteral(", "));
    text[0] = text[0].toUpper();
    if (model.axes > 1)
        text += QStringLiteral(", %1 devices in one housing").arg(model.axes);
    if (const auto motor = motorTurn(table))
        text += QStringLiteral(", %1 pulses per motor turn, gear ratio %2").arg(motor->pulses).arg(motor->gearRatio);
    else if (model.resolution > 0)
        text += QStringLiteral(", %1 steps per turn").arg(model.resolution);
    return text + u'.';
}

void addAbilities(Document &document, const ControlTable::Description &model)
{
    if (model.addressesOnly)
        return;
    const auto since = [&](const char *key, int firmware) {
        if (firmware >= 0)
            document.add(key, qint64(firmware));
    };
    since("fast_reads_from", model.fastReadsFrom);
    since("backup_from", model.backupFrom);
    since("clear_from", model.clearFrom);
    document.addFlag("clears_errors", model.clearsErrors).add("axes", qint64(model.axes));
    std::vector<Document> rates;
    for (const BaudCode &code : model.baudCodes) {
        Document rate;
        rate.add("code", qint64(code.code)).add("rate", qint64(code.rate));
        rates.push_back(rate);
    }
    document.add("baud_rates", rates);
}

/// The models whose names begin like that: "XL330-M077", "XL330-M288" of "XL330".
QStringList nearest(const Catalog &catalog, const QString &text)
{
    constexpr qsizetype Most = 8, LeastLetters = 2;
    for (QString start = normalizedName(text); start.size() >= LeastLetters; start.chop(1)) {
        QStringList names;
        for (const Catalog::ModelInfo &info : catalog.models()) {
            for (const QString &name : QStringList(info.model) + info.alsoCalled) {
                if (normalizedName(name).startsWith(start))
                    names.append(name);
            }
        }
        if (!names.isEmpty())
            return names.size() > Most ? names.first(Most) + QStringList(QStringLiteral("…")) : names;
    }
    return {};
}

/// The table that MODEL[/FIRMWARE] names; the model by name or number.
Result<std::pair<ControlTablePtr, int>> named(const Catalog &catalog, const QString &text)
{
    const qsizetype slash = text.lastIndexOf(u'/');
    const QString model = slash < 0 ? text : text.left(slash);
    bool isNumber = false;
    const int number = model.toInt(&isNumber);
    const Catalog::ModelInfo *info = isNumber ? catalog.model(number) : catalog.model(QStringView(model));
    if (!info) {
        const QStringList near = isNumber ? QStringList() : nearest(catalog, model);
        const QString these =
            near.isEmpty() ? QString() : QStringLiteral("; nearest: ") + near.join(QStringLiteral(", "));
        return failure(ErrorKind::NotFound,
                       QStringLiteral("no model is called %1%2; dxl models lists them all").arg(model, these));
    }
    bool ok = true;
    const int firmware = slash < 0 ? info->newestFirmware : text.mid(slash + 1).toInt(&ok);
    if (!ok || firmware > 255 || (slash >= 0 && firmware < 0))
        return failure(ErrorKind::InvalidArgument, QStringLiteral("the firmware is a number from 0 to 255"));
    return std::pair(catalog.find(info->modelNumber, firmware), firmware);
}

QStringList remarks(const ControlTable &table, int firmware)
{
    const ControlTable::Description &model = table.description();
    QStringList lines;
    if (table.isNewerThanKnown(firmware)) {
        lines.append(QStringLiteral("Firmware %1 is newer than the newest known, %2: its table may differ.")
                         .arg(firmware)
                         .arg(model.newestFirmware));
    }
    if (!model.addressesOnly)
        lines.append(abilitiesText(table));
    if (!model.alsoCalled.isEmpty())
        lines.append(QStringLiteral("Also called %1.").arg(model.alsoCalled.join(QStringLiteral(", "))));
    if (!model.doubt.isEmpty())
        lines.append(QStringLiteral("Doubtful: %1").arg(model.doubt));
    if (!model.manualPage.isEmpty())
        lines.append(model.manualPage);
    return lines;
}

} // namespace

ExitCode showModel(const Catalog &catalog, const QString &text, Output &output)
{
    const auto found = named(catalog, text);
    if (!found)
        return output.refuse(found.error());
    const ControlTable &table = *found->first;
    const ControlTable::Description &model = table.description();
    QStringList lines{QStringLiteral("%1, model number %2, series %3, firmware %4 to %5")
                          .arg(model.model)
                          .arg(model.modelNumber)
                          .arg(model.series)
                          .arg(model.firmwareFrom)
                          .arg(model.firmwareTo)};
    lines += remarks(table, found->second);
    Document document;
    document.add("model", model.model)
        .add("number", qint64(model.modelNumber))
        .add("series", model.series)
        .add("firmware_from", qint64(model.firmwareFrom))
        .add("firmware_to", qint64(model.firmwareTo))
        .addFlag("newer_than_known", table.isNewerThanKnown(found->second))
        .addFlag("addresses_only", model.addressesOnly)
        .add("resolution", qint64(model.resolution));
    if (const auto motor = motorTurn(table))
        document.add("pulses_per_motor_turn", qint64(motor->pulses)).add("gear_ratio", motor->gearRatio);
    addAbilities(document, model);
    if (!model.doubt.isEmpty())
        document.add("doubt", model.doubt);
    std::vector<Document> registers;
    for (const Field &field : table.fields()) {
        lines.append(registerLine(field));
        registers.push_back(registerDocument(field));
    }
    document.add("registers", registers);
    output.result(lines.join(u'\n'), document);
    return ExitCode::Done;
}

} // namespace dynascope::dxl
