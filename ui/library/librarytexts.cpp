// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/library/librarytexts.h"

#include "core/table/motorturn.h"
#include "ui/common/fieldtexts.h"
#include "ui/common/texts.h"
#include "ui/common/theme.h"
#include "ui/library/firmwarechanges.h"

#include <QCoreApplication>

namespace dynascope {
namespace {

const QString Dot = QStringLiteral(" &nbsp;·&nbsp; ");

class LibraryTexts
{
    Q_DECLARE_TR_FUNCTIONS(LibraryTexts)
};

QString paragraph(const QString &html)
{
    return QStringLiteral("<p style=\"margin:0 0 6px 0\">%1</p>").arg(html);
}

QString tinted(const QColor &color, const QString &html)
{
    return QStringLiteral("<span style=\"color:%1\">%2</span>").arg(color.name(), html);
}

QString boundText(const Bound &bound)
{
    if (bound.number)
        return numberText(*bound.number);
    return bound.negated ? QChar(0x2212) + bound.reg : bound.reg;
}

QString boundsText(const Bound &minimum, const Bound &maximum)
{
    if (!minimum.isSet() && !maximum.isSet())
        return {};
    return QStringLiteral("%1 … %2").arg(boundText(minimum), boundText(maximum));
}

QString stepText(Unit unit, double scale)
{
    const QString symbol = unitSymbol(unit, AngleUnit::Pulses);
    const QString name = unit == Unit::Degree ? QStringLiteral("°") : symbol;
    return scale == 1.0 ? name : QStringLiteral("%1 %2").arg(scale).arg(name);
}

/// As a device fresh from the factory has its other registers.
EffectiveField atFactory(const Field &field, const ControlTable &table)
{
    return effective(field, [&table](QStringView name) {
        const Field *other = table.find(name);
        return other ? other->initial : std::nullopt;
    });
}

/// "Operating Mode is Velocity control", "Drive Mode has Time-based profile".
QString conditionText(const Alternate &alternate, const ControlTable &table)
{
    const Field *decides = table.find(alternate.reg);
    QStringList names;
    for (const std::int64_t value : alternate.values) {
        const QString name = decides ? meaning(*decides, value) : QString();
        names << (name.isEmpty() ? numberText(value) : name).toHtmlEscaped();
    }
    const QString reg = alternate.reg.toHtmlEscaped();
    if (decides && decides->values.empty() && !decides->bits.empty())
        return LibraryTexts::tr("%1 has %2").arg(reg, names.join(LibraryTexts::tr(" or ")));
    return LibraryTexts::tr("%1 is %2").arg(reg, names.join(LibraryTexts::tr(" or ")));
}

QString alternateText(const Alternate &alternate, const Field &field, const ControlTable &table)
{
    QStringList parts;
    if (const QString bounds = boundsText(alternate.minimum, alternate.maximum); !bounds.isEmpty())
        parts << LibraryTexts::tr("range %1").arg(bounds.toHtmlEscaped());
    if (alternate.unit != field.unit || alternate.scale != field.scale)
        parts << LibraryTexts::tr("in %1").arg(stepText(alternate.unit, alternate.scale).toHtmlEscaped());
    if (alternate.directionBit != field.directionBit && alternate.directionBit >= 0)
        parts << LibraryTexts::tr("bit %1 is the direction").arg(alternate.directionBit);
    return LibraryTexts::tr("While %1: %2.").arg(conditionText(alternate, table), parts.join(QStringLiteral(", ")));
}

QStringList numberLines(const Field &field, const ControlTable &table, const UnitPreferences &units)
{
    const EffectiveField fresh = atFactory(field, table);
    QStringList facts;
    const QString range = withUnits(field, fresh, table.resolution(), units, fresh.minimum, fresh.maximum);
    const bool byName = !field.minimum.reg.isEmpty() || !field.maximum.reg.isEmpty();
    if (byName) {
        QString text = LibraryTexts::tr("Range %1").arg(boundsText(field).toHtmlEscaped());
        if (!range.isEmpty())
            text += LibraryTexts::tr(", from the factory %1").arg(range.toHtmlEscaped());
        facts << text;
    } else if (!range.isEmpty() && field.values.empty()) {
        facts << LibraryTexts::tr("Range %1").arg(range.toHtmlEscaped());
    }
    if (field.initial) {
        facts << LibraryTexts::tr("Default %1")
                     .arg(withUnits(field, fresh, table.resolution(), units, field.initial, field.initial)
                              .toHtmlEscaped());
    }
    if (field.unit != Unit::None) {
        QString step = field.scale == 1.0 ? QStringLiteral("1 ") + stepText(field) : stepText(field);
        const Physical one = physical(fresh, table.resolution(), 1, units);
        const bool turns =
            field.unit == Unit::Pulse || field.unit == Unit::PulsePerSec || field.unit == Unit::PulsePerMs;
        if (turns && !units.raw && units.angle != AngleUnit::Pulses)
            step += QStringLiteral(", %1 %2").arg(one.value, 0, 'g', 4).arg(one.unit);
        facts << LibraryTexts::tr("One step is %1").arg(step.toHtmlEscaped());
    }
    if (field.torqueConstant > 0)
        facts << LibraryTexts::tr("%1 Nm as torque").arg(field.torqueConstant, 0, 'g', 4);
    if (field.directionBit >= 0)
        facts << LibraryTexts::tr("Bit %1 is the direction").arg(field.directionBit);
    if (field.gearRatio.isSet()) {
        facts << LibraryTexts::tr("Turns follow %1 and %2")
                     .arg(field.gearRatio.numerator.toHtmlEscaped(), field.gearRatio.denominator.toHtmlEscaped());
    }
    return facts;
}

QString sinceText(const QString &what, int firmware)
{
    if (firmware < 0)
        return LibraryTexts::tr("no %1").arg(what);
    return firmware == 0 ? what : LibraryTexts::tr("%1 from firmware %2").arg(what).arg(firmware);
}

QString modesText(const ControlTable &table)
{
    const Field *mode = table.find(Known::OperatingMode);
    if (!mode)
        mode = table.find(u"Control Mode");
    QStringList names;
    for (const EnumValue &value : mode ? mode->values : std::vector<EnumValue>())
        names << value.text.toHtmlEscaped();
    return names.join(QStringLiteral(", "));
}

QString baudRatesText(const ControlTable &table)
{
    QStringList rates;
    for (const BaudCode &code : table.description().baudCodes)
        rates << baudText(code.rate);
    return rates.join(QStringLiteral(", "));
}

} // namespace

QString numberText(std::int64_t number)
{
    return withMinus(QString::number(number));
}

QString sizeText(const Field &field)
{
    const QString size = field.size == 1 ? LibraryTexts::tr("1 byte") : LibraryTexts::tr("%1 bytes").arg(field.size);
    return field.isSigned ? LibraryTexts::tr("%1, signed").arg(size) : size;
}

QString boundsText(const Field &field)
{
    return boundsText(field.minimum, field.maximum);
}

QString stepText(const Field &field)
{
    return field.unit == Unit::None ? QString() : stepText(field.unit, field.scale);
}

QString addressText(int address)
{
    return QStringLiteral("%1 (0x%2)").arg(address).arg(QString::number(address, 16).toUpper());
}

QString modelFacts(const Catalog::ModelInfo &info, const ControlTable &table, const QString &folder,
                   const QPalette &palette)
{
    const ControlTable::Description &model = table.description();
    QStringList first, lines;
    if (!model.manualPage.isEmpty())
        first << LibraryTexts::tr("<a href=\"%1\">Manual</a>").arg(model.manualPage.toHtmlEscaped());
    if (!info.alsoCalled.isEmpty())
        first << LibraryTexts::tr("Also called %1").arg(info.alsoCalled.join(QStringLiteral(", ")).toHtmlEscaped());
    if (!model.addressesOnly) {
        if (const auto motor = motorTurn(table)) {
            first << LibraryTexts::tr("%1 pulses per motor turn, gear ratio %2")
                         .arg(grouped(static_cast<quint64>(motor->pulses)))
                         .arg(motor->gearRatio);
        } else if (model.resolution > 0)
            first << LibraryTexts::tr("%1 steps a turn").arg(grouped(static_cast<quint64>(model.resolution)));
        if (model.axes > 1)
            first << LibraryTexts::tr("%1 axes, each with an ID").arg(model.axes);
        first << sinceText(LibraryTexts::tr("fast reads"), model.fastReadsFrom)
              << sinceText(LibraryTexts::tr("backup"), model.backupFrom)
              << sinceText(LibraryTexts::tr("Clear"), model.clearFrom);
    }
    if (model.modbusNumber >= 0)
        first << LibraryTexts::tr("model number %1 in Modbus mode").arg(model.modbusNumber);
    first << (info.isBuiltIn
                  ? LibraryTexts::tr("comes with the program, %1.json").arg(info.file.toHtmlEscaped())
                  : LibraryTexts::tr("your own, %1.json in %2").arg(info.file.toHtmlEscaped(), folder.toHtmlEscaped()));
    lines << first.join(QStringLiteral("; ")); // it wraps: no dot shall be left hanging
    if (const QString modes = modesText(table); !modes.isEmpty())
        lines << LibraryTexts::tr("Modes: %1").arg(modes);
    if (const QString rates = baudRatesText(table); !rates.isEmpty())
        lines << LibraryTexts::tr("Baud rates: %1").arg(rates);
    if (!model.doubt.isEmpty())
        lines << tinted(colors(palette).warning, LibraryTexts::tr("Doubtful: %1").arg(model.doubt.toHtmlEscaped()));
    return lines.join(QStringLiteral("<br>"));
}

QString registerPage(const Field &field, const ControlTable &table, const std::vector<ControlTablePtr> &all,
                     const UnitPreferences &units, const QPalette &palette)
{
    const ThemeColors &theme = colors(palette);
    QString page = paragraph(
        QStringLiteral("<b>%1</b> &nbsp; %2")
            .arg(field.name.toHtmlEscaped(), tinted(theme.dimmed, LibraryTexts::tr("address %1 · %2 · %3 · %4")
                                                                      .arg(addressText(field.address), sizeText(field),
                                                                           areaText(field.area), accessText(field)))));
    const auto add = [&page](const QString &html) {
        if (!html.isEmpty())
            page += paragraph(html);
    };
    add(field.help.toHtmlEscaped());
    add(numberLines(field, table, units).join(Dot));
    add(meaningsText(field));
    for (const Alternate &alternate : field.alternates)
        add(alternateText(alternate, field, table));
    if (!field.resets.isEmpty())
        add(LibraryTexts::tr("A write here also resets %1.")
                .arg(field.resets.join(QStringLiteral(", ")).toHtmlEscaped()));
    if (field.needsTorqueOff())
        add(LibraryTexts::tr("It can be written only while torque is off."));
    for (const QString &sentence : firmwareChanges(field, table, all))
        add(tinted(theme.accent, sentence.toHtmlEscaped()));
    if (!field.doubt.isEmpty())
        add(tinted(theme.warning, LibraryTexts::tr("Doubtful: %1").arg(field.doubt.toHtmlEscaped())));
    return page;
}

} // namespace dynascope
