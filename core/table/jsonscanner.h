// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QByteArray>
#include <QStringList>

#include <vector>

namespace dynascope {

/// Walks the bytes of a JSON text without understanding more of it than strings, brackets and where it is. Whether it
/// is JSON at all is for a parser to say; this never reads beyond it and always ends.
class JsonScanner
{
public:
    enum class Token { Key, Value, Open, Close, End };

    explicit JsonScanner(QByteArrayView json) : m_json(json) { }

    Token next();
    QByteArrayView text() const { return m_text; } ///< of a key or value, strings without quotes, escapes as they stand
    bool isString() const { return m_isString; }   ///< of a value
    bool isObject() const { return m_isObject; }   ///< what opens
    bool hasEscape() const { return m_hasEscape; } ///< of a key or value
    int depth() const
    {
        return static_cast<int>(m_open.size());
    }                                   ///< of what is open: after Open with it, after Close without
    int line() const { return m_line; } ///< of the token, from 1

private:
    struct Level {
        bool isObject;
        bool expectsKey;
    };

    Token string();
    Token scalar();

    QByteArrayView m_json;
    qsizetype m_at = 0;
    int m_line = 1;
    std::vector<Level> m_open;
    QByteArrayView m_text;
    bool m_isString = false;
    bool m_isObject = false;
    bool m_hasEscape = false;
};

/// Which line each key of a JSON text stands in.
class JsonPositions
{
public:
    /// `json` outlives this; readJsonObject() has bounded it.
    explicit JsonPositions(QByteArrayView json) : m_json(json) { }

    /// Of the key that this path leads to; entries of lists are called "0", "1"...; 0 where there is none. One pass over
    /// the text, and nothing of it is kept.
    int line(const QStringList &path) const;

private:
    QByteArrayView m_json;
};

} // namespace dynascope
