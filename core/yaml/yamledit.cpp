// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/yaml/yamledit.h"

#include <QStringList>

#include <algorithm>

namespace dynascope {
namespace {

bool isPlainSafe(const QString &text, bool inFlow)
{
    static const QStringList taken{QStringLiteral("~"), QStringLiteral("null"), QStringLiteral("Null"),
                                   QStringLiteral("NULL")};
    if (text.isEmpty() || text != text.trimmed() || taken.contains(text))
        return false;
    const QChar first = text.front();
    const bool isSign = first == u'-' && text.size() > 1 && !text[1].isSpace();
    if (!isSign && QStringView(u"-?:,[]{}#&*!|>'\"%@`").contains(first))
        return false;
    const bool isDocument = text.startsWith(u"---") || text.startsWith(u"...");
    const bool hasKey = text.contains(u": ") || text.endsWith(u':') || text.contains(u" #") || text.contains(u'\t');
    if (isDocument || hasKey)
        return false;
    return !inFlow || std::ranges::none_of(text, [](QChar c) { return QStringView(u",[]{}:").contains(c); });
}

/// Over spaces, line ends, commas and comments, to what closes a bracket.
qsizetype behindBracket(const QByteArray &yaml, qsizetype at, char bracket)
{
    while (at < yaml.size()) {
        if (yaml[at] == bracket)
            return at + 1;
        if (yaml[at] == '#') {
            const qsizetype end = yaml.indexOf('\n', at);
            at = end < 0 ? yaml.size() : end;
        } else {
            ++at;
        }
    }
    return at;
}

} // namespace

QByteArray yamlScalar(const QString &text, YamlNode::Style style, bool inFlow)
{
    if (style == YamlNode::Style::Double) {
        QString escaped = text;
        escaped.replace(u'\\', QStringLiteral("\\\\")).replace(u'"', QStringLiteral("\\\""));
        return '"' + escaped.toUtf8() + '"';
    }
    if (style == YamlNode::Style::Plain && isPlainSafe(text, inFlow))
        return text.toUtf8();
    QString doubled = text;
    doubled.replace(u'\'', QStringLiteral("''"));
    return '\'' + doubled.toUtf8() + '\'';
}

qsizetype yamlEnd(const QByteArray &yaml, const YamlNode &node)
{
    if (node.kind == YamlNode::Kind::Null)
        return 0; // it stands nowhere, or is "~": its key is as good
    if (node.kind == YamlNode::Kind::Scalar)
        return node.end;
    qsizetype end = node.begin + (node.isFlow ? 1 : 0);
    for (const YamlNode &child : node.children)
        end = std::max(end, yamlEnd(yaml, child));
    return node.isFlow ? behindBracket(yaml, end, node.isMap() ? '}' : ']') : end;
}

YamlEdits::YamlEdits(const QByteArray &yaml) : m_yaml(yaml), m_lineEnd(yaml.contains("\r\n") ? "\r\n" : "\n") { }

void YamlEdits::replace(const YamlNode &scalar, const QString &text, bool inFlow)
{
    m_edits.push_back({scalar.begin, scalar.end, yamlScalar(text, scalar.style, inFlow)});
}

void YamlEdits::insert(qsizetype at, const QByteArray &text)
{
    m_edits.push_back({at, at, text});
}

void YamlEdits::insertLines(qsizetype at, int indentation, const QByteArrayList &lines)
{
    const qsizetype lineEnd = m_yaml.indexOf('\n', at);
    QByteArray text;
    for (const QByteArray &line : lines)
        text += QByteArray(indentation, ' ') + line + m_lineEnd;
    if (lineEnd < 0) { // the last line has no end, and gets none
        text.chop(m_lineEnd.size());
        return insert(m_yaml.size(), m_lineEnd + text);
    }
    insert(lineEnd + 1, text);
}

void YamlEdits::remove(qsizetype begin, qsizetype end)
{
    m_edits.push_back({begin, end, {}});
}

QByteArray YamlEdits::result() const
{
    std::vector<Edit> edits = m_edits;
    std::ranges::stable_sort(edits, {}, &Edit::begin);
    QByteArray result;
    qsizetype at = 0;
    for (const Edit &edit : edits) {
        result += m_yaml.mid(at, edit.begin - at) + edit.text;
        at = std::max(at, edit.end);
    }
    return result + m_yaml.mid(at);
}

} // namespace dynascope
