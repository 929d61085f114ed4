// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/table/jsonscanner.h"

namespace dynascope {
namespace {

bool endsScalar(char c)
{
    return c == ',' || c == '}' || c == ']' || c == ':' || c == '"' || c == '{' || c == '[' || c == '\n' || c == ' '
           || c == '\t' || c == '\r';
}

} // namespace

JsonScanner::Token JsonScanner::next()
{
    for (; m_at < m_json.size(); ++m_at) {
        const char c = m_json[m_at];
        switch (c) {
        case '\n': ++m_line; break;
        case ' ':
        case '\t':
        case '\r':
        case ':': break;
        case ',':
            if (!m_open.empty())
                m_open.back().expectsKey = m_open.back().isObject;
            break;
        case '{':
        case '[':
            m_isObject = c == '{';
            m_open.push_back({m_isObject, m_isObject});
            ++m_at;
            return Token::Open;
        case '}':
        case ']':
            ++m_at;
            if (m_open.empty())
                break;
            m_open.pop_back();
            return Token::Close;
        case '"': return string();
        default: return scalar();
        }
    }
    return Token::End;
}

JsonScanner::Token JsonScanner::string()
{
    const qsizetype from = ++m_at;
    m_hasEscape = false;
    while (m_at < m_json.size() && m_json[m_at] != '"' && m_json[m_at] != '\n') {
        if (m_json[m_at] == '\\') {
            m_hasEscape = true;
            if (m_at + 1 < m_json.size() && m_json[m_at + 1] != '\n')
                ++m_at;
        }
        ++m_at;
    }
    m_text = m_json.sliced(from, m_at - from);
    m_isString = true;
    if (m_at < m_json.size() && m_json[m_at] == '"')
        ++m_at; // else it was left open: the parser will say so; lines are counted on
    const bool isKey = !m_open.empty() && m_open.back().expectsKey;
    if (isKey)
        m_open.back().expectsKey = false;
    return isKey ? Token::Key : Token::Value;
}

JsonScanner::Token JsonScanner::scalar()
{
    const qsizetype from = m_at++;
    while (m_at < m_json.size() && !endsScalar(m_json[m_at]))
        ++m_at;
    m_text = m_json.sliced(from, m_at - from);
    m_isString = false;
    m_hasEscape = false;
    return Token::Value;
}

int JsonPositions::line(const QStringList &path) const
{
    struct Level {
        bool isObject;
        bool isOnPath; ///< so are all around it
        int count = 0; ///< entries of a list so far
    };
    std::vector<Level> open;
    bool isOnPath = true; ///< the value to come
    JsonScanner scanner(m_json);
    for (auto token = scanner.next(); token != JsonScanner::Token::End; token = scanner.next()) {
        if (token == JsonScanner::Token::Close) {
            open.pop_back();
            continue;
        }
        const auto depth = static_cast<qsizetype>(open.size());
        if (depth > 0 && (token == JsonScanner::Token::Key || !open.back().isObject)) {
            isOnPath = open.back().isOnPath && depth <= path.size();
            if (token == JsonScanner::Token::Key)
                isOnPath = isOnPath && QString::fromUtf8(scanner.text()) == path[depth - 1];
            else // every entry counts
                isOnPath = QString::number(open.back().count++) == path.value(depth - 1) && isOnPath;
            if (isOnPath && depth == path.size())
                return scanner.line();
        }
        if (token == JsonScanner::Token::Open)
            open.push_back({scanner.isObject(), isOnPath});
    }
    return 0;
}

} // namespace dynascope
