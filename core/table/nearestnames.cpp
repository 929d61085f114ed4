// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/table/nearestnames.h"

namespace dynascope {

QStringList namesNear(const ControlTable &table, QStringView typed)
{
    constexpr qsizetype Most = 5, LongestTyped = 64;
    const QString wanted = normalizedName(typed.left(LongestTyped));
    QStringList names;
    for (qsizetype length = wanted.size(); length >= 3 && names.isEmpty(); --length) {
        for (const Field &field : table.fields()) {
            if (names.size() < Most && normalizedName(field.name).contains(QStringView(wanted).left(length)))
                names.append(field.name);
        }
    }
    return names;
}

} // namespace dynascope
