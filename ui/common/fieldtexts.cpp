// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/common/fieldtexts.h"

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
        parts << QStringLiteral("<b>%1</b>&nbsp;%2").arg(value.value).arg(value.text.toHtmlEscaped());
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
    if (effective.unit != Unit::None || (single && !meaning(field, *from).isEmpty())) {
        const auto said = [&](std::int64_t value) {
            const QString words = valueText(field, effective, resolution, value, units);
            return meaning(field, value).isEmpty() ? QString(words).replace(u'-', QChar(0x2212)) : words;
        };
        const QString low = said(*from), high = said(*to);
        text += single ? QStringLiteral(" (%1)").arg(low) : QStringLiteral(" (%1 … %2)").arg(low, high);
    }
    return text;
}

QString accessText(const Field &field)
{
    if (field.mayBeTried())
        return FieldTexts::tr("access not known");
    return field.isWritable() ? FieldTexts::tr("read and write") : FieldTexts::tr("read only");
}

} // namespace dynascope
