// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/result.h"

#include <optional>

/// How the lines of a control channel are read and refused.
namespace dynascope::sim {

inline tl::unexpected<Error> wrong(const QString &text)
{
    return failure(ErrorKind::InvalidArgument, text);
}

/// A number, its unit written behind it or not.
inline std::optional<double> numberOf(QStringView text, QStringView unit, double low, double high)
{
    bool ok = false;
    const bool withUnit = !unit.isEmpty() && text.endsWith(unit, Qt::CaseInsensitive);
    const double number = (withUnit ? text.chopped(unit.size()) : text).toDouble(&ok);
    return ok && number >= low && number <= high ? std::optional(number) : std::nullopt;
}

inline tl::unexpected<Error> noNumber(QStringView text, QStringView unit, double low, double high)
{
    return wrong(QStringLiteral("\"%1\" is no number from %2 to %3 %4")
                     .arg(text.toString()).arg(low).arg(high).arg(unit.toString()));
}

} // namespace dynascope::sim
