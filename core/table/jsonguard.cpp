// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/table/jsonguard.h"

#include <QJsonDocument>

#include <set>
#include <vector>

namespace dynascope {
namespace {

/// Walks the bytes of a JSON text without understanding more of it than strings and brackets.
class Scan
{
public:
    explicit Scan(const QByteArray &json) : m_json(json) { }

    /// What is wrong, with its line; empty where nothing is. Bad syntax is left for the parser to find.
    QString run()
    {
        for (; m_at < m_json.size(); ++m_at) {
            const char c = m_json[m_at];
            if (c == '\n')
                ++m_line;
            else if (c == '{' || c == '[')
                m_open.push_back({c == '{', c == '{', {}});
            else if ((c == '}' || c == ']') && !m_open.empty())
                m_open.pop_back();
            else if (c == ',' && !m_open.empty())
                m_open.back().expectsKey = m_open.back().isObject;
            else if (c == '"')
                string();
            if (static_cast<int>(m_open.size()) > MaximumTableFileDepth)
                return here(QStringLiteral("nested more than %1 deep").arg(MaximumTableFileDepth));
            if (!m_wrong.isEmpty())
                return m_wrong;
        }
        return {};
    }

private:
    struct Level {
        bool isObject;
        bool expectsKey;
        std::set<QByteArray> keys;
    };

    void string()
    {
        const qsizetype from = ++m_at;
        bool escaped = false;
        while (m_at < m_json.size() && m_json[m_at] != '"' && m_json[m_at] != '\n') {
            if (m_json[m_at] == '\\') {
                escaped = true;
                ++m_at;
            }
            ++m_at;
        }
        if (m_at < m_json.size() && m_json[m_at] == '\n')
            --m_at; // a string left open: the parser will say so; keep counting lines
        if (m_open.empty() || !m_open.back().expectsKey)
            return;
        Level &level = m_open.back();
        level.expectsKey = false;
        const QByteArray key = m_json.mid(from, m_at - from);
        if (escaped)
            m_wrong = here(QStringLiteral("a key with an escape in it"));
        else if (!level.keys.insert(key).second)
            m_wrong = here(QStringLiteral("\"%1\" stands twice").arg(QString::fromUtf8(key)));
    }

    QString here(const QString &what) const { return QStringLiteral("line %1: %2").arg(m_line).arg(what); }

    const QByteArray &m_json;
    qsizetype m_at = 0;
    int m_line = 1;
    std::vector<Level> m_open;
    QString m_wrong;
};

tl::unexpected<Error> bad(const QString &name, const QString &text)
{
    return failure(ErrorKind::BadFile, QStringLiteral("%1: %2").arg(name, text));
}

} // namespace

Result<QJsonObject> readJsonObject(const QByteArray &json, const QString &name)
{
    if (json.size() > MaximumTableFileSize)
        return bad(name, QStringLiteral("larger than %1 bytes").arg(MaximumTableFileSize));
    const QString wrong = Scan(json).run();
    if (!wrong.isEmpty())
        return bad(name, wrong);
    QJsonParseError error;
    const QJsonDocument document = QJsonDocument::fromJson(json, &error);
    if (error.error != QJsonParseError::NoError) {
        const auto line = json.first(qBound(qsizetype(0), qsizetype(error.offset), json.size())).count('\n') + 1;
        return bad(name, QStringLiteral("line %1: not JSON (%2)").arg(line).arg(error.errorString()));
    }
    if (!document.isObject())
        return bad(name, QStringLiteral("not a JSON object"));
    return document.object();
}

} // namespace dynascope
