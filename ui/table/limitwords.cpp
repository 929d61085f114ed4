// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/table/limitwords.h"

#include "ui/common/texts.h"

#include <QCoreApplication>

namespace dynascope {
namespace {

struct LimitWords {
    Q_DECLARE_TR_FUNCTIONS(LimitWords)
};

bool isAny(const Field &field, const EffectiveField &effective)
{
    return field.size == 4 && effective.minimum == smallestRaw(field) && effective.maximum == largestRaw(field);
}

QString numberText(const Physical &value)
{
    return withMinus(QString::number(value.value, 'f', value.decimals));
}

/// `text`, and the raw one behind it where that is another.
QString withRaw(const QString &text, const QString &raw)
{
    return text == raw ? text : LimitWords::tr("%1 (raw %2)").arg(text, raw);
}

QString rawDefault(const Field &field)
{
    return field.initial ? withMinus(QString::number(*field.initial)) : QString();
}

} // namespace

QString rangeText(const Field &field, const EffectiveField &effective)
{
    if (!effective.minimum && !effective.maximum)
        return {};
    if (isAny(field, effective))
        return LimitWords::tr("any");
    const auto text = [](const std::optional<std::int64_t> &bound, const QString &from) {
        return bound ? withMinus(QString::number(*bound)) : from.isEmpty() ? QString() : QStringLiteral("?");
    };
    return QStringLiteral("%1 … %2").arg(text(effective.minimum, effective.minimumFrom),
                                         text(effective.maximum, effective.maximumFrom));
}

QString rangeText(const Field &field, const EffectiveField &effective, int resolution, const UnitPreferences &units)
{
    const QString raw = rangeText(field, effective);
    const bool hasNames = !field.values.empty() || !field.bits.empty();
    if (raw.isEmpty() || hasNames || isAny(field, effective) || effective.unit == Unit::None || units.raw)
        return raw;
    const QString unit = unitSymbol(effective, units);
    if (effective.minimum && effective.maximum) {
        const auto [low, high] = physicalRange(effective, resolution, *effective.minimum, *effective.maximum, units);
        if (low.value < 0 && low.value == -high.value) // half as long: both ends are to be seen in a narrow column
            return QStringLiteral("±%1 %2").arg(numberText(high), unit);
        return QStringLiteral("%1 … %2 %3").arg(numberText(low), numberText(high), unit);
    }
    const auto text = [&](const std::optional<std::int64_t> &bound, const QString &from) {
        return bound          ? numberText(physical(effective, resolution, *bound, units))
            : from.isEmpty() ? QString()
                             : QStringLiteral("?");
    };
    return QStringLiteral("%1 … %2 %3").arg(text(effective.minimum, effective.minimumFrom),
                                            text(effective.maximum, effective.maximumFrom), unit);
}

QString rangeSource(const EffectiveField &effective)
{
    QStringList names;
    for (const QString &name : {effective.minimumFrom, effective.maximumFrom}) {
        if (!name.isEmpty() && !names.contains(name))
            names << name;
    }
    if (names.isEmpty())
        return {};
    return names.size() == 1 ? LimitWords::tr("set by %1").arg(names.front())
                             : LimitWords::tr("set by %1 and %2").arg(names.front(), names.back());
}

QString rangeToolTip(const Field &field, const EffectiveField &effective, int resolution, const UnitPreferences &units)
{
    const QString range =
        withRaw(rangeText(field, effective, resolution, units), rangeText(field, effective));
    const QString source = rangeSource(effective);
    return source.isEmpty() || range.isEmpty() ? range : QStringLiteral("%1, %2").arg(range, source);
}

QString defaultText(const Field &field, const EffectiveField &effective, int resolution, const UnitPreferences &units)
{
    // Names are too much for a column, and the unit stands at the value already.
    if (!field.initial || units.raw || !field.bits.empty() || !meaning(field, *field.initial).isEmpty())
        return rawDefault(field);
    QString text = withMinus(valueText(field, effective, resolution, *field.initial, units));
    if (const QString symbol = unitSymbol(effective, units); !symbol.isEmpty() && text.endsWith(symbol))
        text.chop(symbol.size());
    return text.trimmed();
}

QString defaultToolTip(const Field &field, const EffectiveField &effective, int resolution,
                       const UnitPreferences &units)
{
    if (!field.initial)
        return {};
    const QString named = withBaudTexts(meaning(field, *field.initial));
    const QString whole = units.raw ? rawDefault(field)
                                    : withMinus(valueText(field, effective, resolution, *field.initial, units));
    return withRaw(named.isEmpty() ? whole : named, rawDefault(field));
}

} // namespace dynascope
