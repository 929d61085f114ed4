// SPDX-License-Identifier: GPL-3.0-or-later
// Do the registers of a table fit together?
#include "core/table/tablebuilder.h"

#include <algorithm>

namespace dynascope {

void TableBuilder::checkTogether(const std::vector<Field> &fields)
{
    if (fields.empty())
        return say({}, QStringLiteral("no registers at firmware %1").arg(m_context.firmware));
    for (std::size_t i = 1; i < fields.size(); ++i) {
        if (fields[i].address < fields[i - 1].end()) {
            return sayOf(fields[i],
                         QStringLiteral("overlaps %1 at address %2").arg(fields[i - 1].name).arg(fields[i].address),
                         &fields[i - 1]);
        }
    }
    checkNames(fields);
}

void TableBuilder::checkNames(const std::vector<Field> &fields)
{
    QStringList names;
    std::vector<std::pair<QString, QString>> plain;
    for (const Field &field : fields) {
        names.append(field.name);
        plain.emplace_back(normalizedName(field.name), field.name);
    }
    std::sort(plain.begin(), plain.end());
    for (std::size_t i = 1; i < plain.size(); ++i) {
        if (plain[i].first == plain[i - 1].first)
            return say({RegistersKey, plain[i].second},
                       QStringLiteral("%1 and %2 are one name").arg(plain[i - 1].second, plain[i].second));
    }
    for (const Field &field : fields) {
        checkBound(field, field.minimum, names, {});
        checkBound(field, field.maximum, names, {});
        for (std::size_t i = 0; i < field.alternates.size(); ++i) {
            const QStringList path{QStringLiteral("alternates"), QString::number(i)};
            checkBound(field, field.alternates[i].minimum, names, path);
            checkBound(field, field.alternates[i].maximum, names, path);
        }
        checkResets(field);
    }
}

/// What is defined but not in this model is no mistake; what nobody knows is.
void TableBuilder::checkResets(const Field &field)
{
    if (field.resets.isEmpty())
        return;
    const QJsonObject definitions = m_settings.value(u"definitions").toObject();
    for (const QString &reset : field.resets) {
        if (!m_context.registers.contains(reset) && !definitions.contains(reset))
            say({RegistersKey, field.name, QStringLiteral("resets")},
                QStringLiteral("%1: resets %2, which is no register").arg(field.name, reset));
    }
}

void TableBuilder::checkBound(const Field &field, const Bound &bound, const QStringList &names, const QStringList &path)
{
    if (!bound.reg.isEmpty() && (bound.reg == field.name || !names.contains(bound.reg)))
        say(QStringList{RegistersKey, field.name} + path + QStringList{QStringLiteral("range")},
            QStringLiteral("%1: limited by %2, which is no other register").arg(field.name, bound.reg));
}

} // namespace dynascope
