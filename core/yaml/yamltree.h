// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/result.h"

#include <QByteArray>

#include <vector>

namespace dynascope {

/// One value of a YAML text, and where it stands.
struct YamlNode {
    enum class Kind { Null, Scalar, List, Map };
    enum class Style {
        Plain,
        Single, ///< 'quoted'
        Double, ///< "quoted"
        Spread, ///< over several lines: a block (| or >), or a plain word that goes on in the next line
    };
    Kind kind = Kind::Null;
    QString text{};                   ///< of a scalar
    std::vector<YamlNode> children{}; ///< of a list; of a map: key, value, key, value...
    int line = 1, column = 1;
    qsizetype begin = 0;              ///< bytes from the beginning of the text; of a scalar with its quotes
    qsizetype end = 0;                ///< of a scalar, one past its last byte; unless it is Spread
    Style style = Style::Plain;       ///< of a scalar
    bool isFlow = false;              ///< a list or map in brackets

    const YamlNode *find(QStringView key) const; ///< of a map; nullptr where there is none
    bool isMap() const { return kind == Kind::Map; }
    bool isList() const { return kind == Kind::List; }
};

constexpr qsizetype MaximumYamlSize = 256 * 1024; ///< bytes
constexpr int MaximumYamlDepth = 12;

/// A YAML text of one document, read with distrust: size, depth and count are bounded, anchors, aliases and tags refused,
/// and so is the same key twice. Messages say name:line:column and what is wrong.
Result<YamlNode> readYaml(const QByteArray &yaml, const QString &name);

/// "name:line:column: text"
tl::unexpected<Error> yamlFailure(const QString &name, const YamlNode &where, const QString &text);

} // namespace dynascope
