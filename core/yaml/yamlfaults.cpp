// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/yaml/yamlfaults.h"

#include <QCoreApplication>
#include <QStringList>

#include <algorithm>

namespace dynascope {
namespace {

constexpr std::size_t MostFaults = 10;

} // namespace

QString cut(const QString &text)
{
    constexpr qsizetype Most = 40;
    return text.size() > Most ? text.left(Most) + u'…' : text;
}

void YamlFaults::say(int line, int column, const QString &what)
{
    if (m_faults.size() < MostFaults)
        m_faults.push_back({{line, column}, what});
    else
        ++m_more;
}

Result<void> YamlFaults::asResult() const
{
    if (m_faults.empty())
        return {};
    std::vector<Fault> sorted = m_faults; // names are looked at before values
    std::ranges::stable_sort(sorted, {}, &Fault::at);
    QStringList said;
    for (const Fault &fault : sorted)
        said << QStringLiteral("%1:%2:%3: %4").arg(m_file).arg(fault.at.first).arg(fault.at.second).arg(fault.what);
    if (m_more > 0)
        said.append(QCoreApplication::translate("Yaml", "%1: and %2 more").arg(m_file).arg(m_more));
    return failure(ErrorKind::BadFile, said.join(u'\n'));
}

} // namespace dynascope
