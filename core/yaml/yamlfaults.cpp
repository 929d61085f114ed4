// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/yaml/yamlfaults.h"

#include <QCoreApplication>

namespace dynascope {
namespace {

constexpr int MostFaults = 10;

} // namespace

QString cut(const QString &text)
{
    constexpr qsizetype Most = 40;
    return text.size() > Most ? text.left(Most) + u'…' : text;
}

void YamlFaults::say(int line, int column, const QString &what)
{
    if (m_faults.size() < MostFaults)
        m_faults.append(QStringLiteral("%1:%2:%3: %4").arg(m_file).arg(line).arg(column).arg(what));
    else
        ++m_more;
}

Result<void> YamlFaults::asResult() const
{
    if (m_faults.isEmpty())
        return {};
    QStringList said = m_faults;
    if (m_more > 0)
        said.append(QCoreApplication::translate("Yaml", "%1: and %2 more").arg(m_file).arg(m_more));
    return failure(ErrorKind::BadFile, said.join(u'\n'));
}

} // namespace dynascope
