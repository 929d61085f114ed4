// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/yaml/yamltree.h"

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include <QUtf8StringView>

#include <algorithm>
#include <sstream>

namespace dynascope {
namespace {

constexpr int MostNodes = 20'000;

constexpr QByteArrayView ByteOrderMark("\xEF\xBB\xBF");

/// One past a scalar in quotes that begins at `begin`; the parser has found its end already.
qsizetype endOfQuoted(QByteArrayView yaml, qsizetype begin)
{
    const char quote = yaml[begin];
    for (qsizetype at = begin + 1; at < yaml.size(); ++at) {
        if (quote == '"' && yaml[at] == '\\') {
            ++at; // escaped, whatever it is
        } else if (yaml[at] == quote) {
            const bool isDoubled = quote == '\'' && at + 1 < yaml.size() && yaml[at + 1] == quote;
            if (!isDoubled)
                return at + 1;
            ++at;
        }
    }
    return yaml.size();
}

/// Builds the tree, and ends the parser by an exception of its own kind where a bound is passed.
class Builder final : public YAML::EventHandler
{
public:
    explicit Builder(const QByteArray &yaml) : m_yaml(yaml), m_offset(yaml.startsWith(ByteOrderMark) ? 3 : 0) { }
    YamlNode takeRoot() { return std::move(m_root); }

    void OnDocumentStart(const YAML::Mark &) override { }
    void OnDocumentEnd() override { }
    void OnNull(const YAML::Mark &mark, YAML::anchor_t anchor) override { add(mark, {}, anchor, {}); }
    void OnAlias(const YAML::Mark &mark, YAML::anchor_t) override { refuse(mark, "aliases are not taken"); }
    void OnScalar(const YAML::Mark &mark, const std::string &tag, YAML::anchor_t anchor,
                  const std::string &value) override
    {
        YamlNode node;
        node.kind = YamlNode::Kind::Scalar;
        node.text = QString::fromStdString(value);
        setEnd(node, mark, value);
        add(mark, tag == "!" ? std::string() : tag, anchor, std::move(node)); // "!": it stood in quotes
    }
    void OnSequenceStart(const YAML::Mark &mark, const std::string &tag, YAML::anchor_t anchor,
                         YAML::EmitterStyle::value style) override
    {
        open(mark, tag, anchor, YamlNode::Kind::List, style == YAML::EmitterStyle::Flow);
    }
    void OnSequenceEnd() override { close(); }
    void OnMapStart(const YAML::Mark &mark, const std::string &tag, YAML::anchor_t anchor,
                    YAML::EmitterStyle::value style) override
    {
        open(mark, tag, anchor, YamlNode::Kind::Map, style == YAML::EmitterStyle::Flow);
    }
    void OnMapEnd() override { close(); }

private:
    [[noreturn]] static void refuse(const YAML::Mark &mark, const char *why)
    {
        throw YAML::ParserException(mark, why);
    }

    void check(const YAML::Mark &mark, const std::string &tag, YAML::anchor_t anchor)
    {
        if (anchor != 0)
            refuse(mark, "anchors are not taken");
        if (!tag.empty() && tag != "?")
            refuse(mark, "tags are not taken");
        if (++m_nodes > MostNodes)
            refuse(mark, "too many values");
    }

    qsizetype placeOf(const YAML::Mark &mark) const { return std::max(0, mark.pos) + m_offset; }

    void setEnd(YamlNode &node, const YAML::Mark &mark, const std::string &value)
    {
        const qsizetype begin = placeOf(mark);
        if (begin >= m_yaml.size())
            return refuse(mark, "ends in its middle");
        const char first = m_yaml[begin];
        if (first == '\'' || first == '"') {
            node.style = first == '"' ? YamlNode::Style::Double : YamlNode::Style::Single;
            node.end = endOfQuoted(m_yaml, begin);
            return;
        }
        const auto size = static_cast<qsizetype>(value.size());
        const bool isOneLine = QByteArrayView(m_yaml).sliced(begin).startsWith(QByteArrayView(value.data(), size));
        node.style = isOneLine ? YamlNode::Style::Plain : YamlNode::Style::Spread;
        node.end = isOneLine ? begin + size : begin;
    }

    void open(const YAML::Mark &mark, const std::string &tag, YAML::anchor_t anchor, YamlNode::Kind kind, bool isFlow)
    {
        check(mark, tag, anchor);
        if (static_cast<int>(m_open.size()) >= MaximumYamlDepth)
            refuse(mark, "nested too deep");
        YamlNode node;
        node.kind = kind;
        node.isFlow = isFlow;
        setPlace(node, mark);
        checkKey(mark, node);
        m_open.push_back(std::move(node));
    }

    void close()
    {
        YamlNode node = std::move(m_open.back());
        m_open.pop_back();
        put(std::move(node));
    }

    void add(const YAML::Mark &mark, const std::string &tag, YAML::anchor_t anchor, YamlNode node)
    {
        check(mark, tag, anchor);
        setPlace(node, mark);
        checkKey(mark, node);
        put(std::move(node));
    }

    void setPlace(YamlNode &node, const YAML::Mark &mark) const
    {
        node.line = mark.line + 1;
        node.column = mark.column + 1;
        node.begin = placeOf(mark);
    }

    void checkKey(const YAML::Mark &mark, const YamlNode &node)
    {
        if (m_open.empty() || !m_open.back().isMap() || m_open.back().children.size() % 2 != 0)
            return;
        if (node.kind != YamlNode::Kind::Scalar)
            refuse(mark, "a key is a plain word");
        if (m_open.back().find(node.text))
            refuse(mark, "this key stands twice");
    }

    void put(YamlNode node)
    {
        if (m_open.empty())
            m_root = std::move(node);
        else
            m_open.back().children.push_back(std::move(node));
    }

    const QByteArray &m_yaml;
    qsizetype m_offset; ///< the parser doesn't count a byte order mark
    YamlNode m_root;
    std::vector<YamlNode> m_open;
    int m_nodes = 0;
};

} // namespace

const YamlNode *YamlNode::find(QStringView key) const
{
    for (std::size_t i = 0; kind == Kind::Map && i + 1 < children.size(); i += 2) {
        if (children[i].text == key)
            return &children[i + 1];
    }
    // While it is being read the last key has no value yet.
    const bool pending = kind == Kind::Map && children.size() % 2 != 0 && children.back().text == key;
    return pending ? &children.back() : nullptr;
}

tl::unexpected<Error> yamlFailure(const QString &name, const YamlNode &where, const QString &text)
{
    return failure(ErrorKind::BadFile,
                   QStringLiteral("%1:%2:%3: %4").arg(name).arg(where.line).arg(where.column).arg(text));
}

Result<YamlNode> readYaml(const QByteArray &yaml, const QString &name)
{
    if (yaml.size() > MaximumYamlSize)
        return failure(ErrorKind::BadFile, QStringLiteral("%1: larger than %2 bytes").arg(name).arg(MaximumYamlSize));
    if (yaml.contains('\0') || !QUtf8StringView(yaml).isValidUtf8())
        return failure(ErrorKind::BadFile, QStringLiteral("%1: not a text").arg(name));
    try {
        std::istringstream stream(yaml.toStdString());
        YAML::Parser parser(stream);
        Builder builder(yaml), more(yaml);
        if (!parser.HandleNextDocument(builder))
            return failure(ErrorKind::BadFile, QStringLiteral("%1: empty").arg(name));
        if (parser.HandleNextDocument(more))
            return failure(ErrorKind::BadFile, QStringLiteral("%1: more than one document").arg(name));
        return builder.takeRoot();
    } catch (const YAML::Exception &error) {
        YamlNode where;
        where.line = std::max(0, error.mark.line) + 1;
        where.column = std::max(0, error.mark.column) + 1;
        return yamlFailure(name, where, QString::fromStdString(error.msg));
    }
}

} // namespace dynascope
