// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/common/fieldtexts.h"

#include "ui/common/texts.h"

#include <QCoreApplication>

namespace dynascope {

namespace {

/// The context of what is translated here.
class FieldTexts
{
    Q_DECLARE_TR_FUNCTIONS(FieldTexts)
};

} // namespace

QString areaText(Area area)
{
    switch (area) {
    case Area::Eeprom: return FieldTexts::tr("EEPROM");
    case Area::Hybrid: return FieldTexts::tr("Hybrid");
    case Area::Unknown: return FieldTexts::tr("area not known");
    case Area::Ram: break;
    }
    return FieldTexts::tr("RAM");
}

QString factsText(const Field &field)
{
    const QString size = field.size == 1 ? FieldTexts::tr("1 byte") : FieldTexts::tr("%1 bytes").arg(field.size);
    return FieldTexts::tr("address %1 · %2 · %3 · %4")
        .arg(QString::number(field.address), size, areaText(field.area), accessText(field));
}

QString meaningsText(const Field &field)
{
    QStringList parts;
    for (const EnumValue &value : field.values)
        parts << QStringLiteral("<b>%1</b>&nbsp;%2").arg(value.value).arg(withBaudTexts(value.text).toHtmlEscaped());
    for (const EnumValue &value : field.special)
        parts << QStringLiteral("<b>%1</b>&nbsp;%2").arg(withMinus(QString::number(value.value)), value.text.toHtmlEscaped());
    for (const BitField &bits : field.bits) {
        QString name = bits.count == 1 ? FieldTexts::tr("bit %1").arg(bits.first)
                                       : FieldTexts::tr("bits %1–%2").arg(bits.first).arg(bits.first + bits.count - 1);
        QString text = bits.name.toHtmlEscaped();
        QStringList values;
        for (const EnumValue &value : bits.values)
            values << QStringLiteral("%1 = %2").arg(value.value).arg(value.text.toHtmlEscaped());
        if (!values.isEmpty())
            text += QStringLiteral(": ") + values.join(QStringLiteral(", "));
        parts << QStringLiteral("<b>%1</b>&nbsp;%2").arg(name, text);
    }
    return parts.join(QStringLiteral(" &nbsp;·&nbsp; "));
}

/// "0 … 4095 (0.00 ° … 359.91 °)"
QString withUnits(const Field &field, const EffectiveField &effective, int resolution, const UnitPreferences &units,
                  const std::optional<std::int64_t> &from, const std::optional<std::int64_t> &to)
{
    if (!from || !to)
        return {};
    const bool single = *from == *to;
    const auto raw = [](std::int64_t value) { return QString::number(value).replace(u'-', QChar(0x2212)); };
    QString text = single ? raw(*from) : raw(*from) + QStringLiteral(" … ") + raw(*to);
    if (single && !meaning(field, *from).isEmpty())
        return text + QStringLiteral(" (%1)").arg(withBaudTexts(meaning(field, *from)));
    if (effective.unit == Unit::None || units.raw)
        return text;
    const auto [low, high] = physicalRange(effective, resolution, *from, *to, units);
    const auto said = [](const Physical &value) {
        return withMinus(QString::number(value.value, 'f', value.decimals)) + u' ' + value.unit;
    };
    return text + (single ? QStringLiteral(" (%1)").arg(said(low))
                          : QStringLiteral(" (%1 … %2)").arg(said(low), said(high)));
}

QString accessText(const Field &field)
{
    if (field.mayBeTried())
        return FieldTexts::tr("access not known");
    return field.isWritable() ? FieldTexts::tr("read and write") : FieldTexts::tr("read only");
}

} // namespace dynascope
