// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/yaml/yamltree.h"

#include <QStringList>

namespace dynascope {

/// "42" or, of the more that nobody wants to read, "42…"
QString cut(const QString &text);

/// What is wrong with a file, each with line and column; the first few of them, and how many more there are.
class YamlFaults
{
public:
    explicit YamlFaults(const QString &file) : m_file(file) {}

    void say(int line, int column, const QString &what);
    void say(const YamlNode &where, const QString &what) { say(where.line, where.column, what); }
    bool areNone() const { return m_faults.isEmpty(); }
    Result<void> asResult() const; ///< BadFile: a line each

private:
    QString m_file;
    QStringList m_faults;
    int m_more = 0;
};

} // namespace dynascope
