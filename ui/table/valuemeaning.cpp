// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/table/valuemeaning.h"

#include "core/table/indirect.h"

namespace dynascope {

QString ValueMeaning::text(std::int64_t raw) const
{
    if (!physical)
        return QString::number(raw);
    const QString name = said(raw);
    // Several values may have one name (Disabled); hexadecimal is never taken for anything but raw.
    const Result<std::int64_t> back = value(name);
    const bool isAnothers = back && *back != raw;
    return isAnothers ? QStringLiteral("0x%1").arg(raw, 0, 16) : name;
}

QString ValueMeaning::said(std::int64_t raw) const
{
    if (pointsInto)
        return addressText(*pointsInto, raw);
    return valueText(field, effective, resolution, raw, units);
}

Result<std::int64_t> ValueMeaning::value(const QString &typed) const
{
    if (pointsInto) {
        const Result<std::int64_t> address = parseAddress(*pointsInto, typed);
        const Result<void> allowed = address ? checkRange(field, effective, *address) : Result<void>();
        return allowed ? address : tl::unexpected(allowed.error());
    }
    QString plain = typed.trimmed();
    plain.replace(QChar(0x2212), u'-'); // the minus that the cells show
    bool isBare = false;
    plain.toDouble(&isBare);
    if (isBare && physical)
        plain += unitSymbol(effective, units);
    return parseValue(field, effective, resolution, plain, units);
}

} // namespace dynascope
