// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/table/jsonscanner.h"

namespace dynascope {
namespace {

constexpr QChar Joint(u'\n'); // no key has one: jsonguard refuses keys with escapes

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

JsonPositions::JsonPositions(QByteArrayView json)
{
    struct Level {
        QString path;
        bool isObject;
        int count = 0; ///< entries of a list so far
    };
    std::vector<Level> open;
    QString path; ///< of the value to come
    JsonScanner scanner(json);
    for (auto token = scanner.next(); token != JsonScanner::Token::End; token = scanner.next()) {
        if (token == JsonScanner::Token::Close) {
            open.pop_back();
            continue;
        }
        if (token == JsonScanner::Token::Key && !open.empty()) {
            path = open.back().path + Joint + QString::fromUtf8(scanner.text());
            m_lines.insert(path, scanner.line());
            continue;
        }
        if (!open.empty() && !open.back().isObject) {
            path = open.back().path + Joint + QString::number(open.back().count++);
            m_lines.insert(path, scanner.line());
        }
        if (token == JsonScanner::Token::Open)
            open.push_back({path, scanner.isObject()});
    }
}

int JsonPositions::line(const QStringList &path) const
{
    QString joined;
    for (const QString &key : path)
        joined += Joint + key;
    return m_lines.value(joined, 0);
}

} // namespace dynascope
