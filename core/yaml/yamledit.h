// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/yaml/yamltree.h"

#include <QByteArrayList>

/// Changes in the text of a YAML file that leave all of the rest as it was written. Pure.
namespace dynascope {

/// A scalar in the style it stood in; a plain one that would be read as something else gets single quotes. `inFlow`:
/// between brackets.
QByteArray yamlScalar(const QString &text, YamlNode::Style style = YamlNode::Style::Plain, bool inFlow = false);

/// One past the last byte of a node, with its closing bracket. Of no Spread scalar.
qsizetype yamlEnd(const QByteArray &yaml, const YamlNode &node);

/// Collects changes, whose places are those in the text as it is, and makes all of them at once.
class YamlEdits
{
public:
    explicit YamlEdits(const QByteArray &yaml);

    void replace(const YamlNode &scalar, const QString &text, bool inFlow);
    void insert(qsizetype at, const QByteArray &text);
    /// Whole lines behind the line that `at` is in, each indented by so many spaces.
    void insertLines(qsizetype at, int indentation, const QByteArrayList &lines);
    void remove(qsizetype begin, qsizetype end);
    bool isEmpty() const { return m_edits.empty(); }
    QByteArray result() const;

private:
    struct Edit {
        qsizetype begin = 0, end = 0;
        QByteArray text;
    };
    const QByteArray &m_yaml;
    QByteArray m_lineEnd; ///< as the text has it
    std::vector<Edit> m_edits;
};

} // namespace dynascope
