// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/yaml/yamltree.h"

#include <QString>

#include <utility>
#include <vector>

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
    bool areNone() const { return m_faults.empty(); }
    Result<void> asResult() const; ///< BadFile: a line each, from top to bottom

private:
    QString m_file;
    struct Fault {
        std::pair<int, int> at; ///< line, column
        QString what;
    };
    std::vector<Fault> m_faults;
    int m_more = 0;
};

} // namespace dynascope
