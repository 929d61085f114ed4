// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/table/jsonguard.h"

#include "core/table/jsonscanner.h"

#include <QJsonDocument>

#include <set>

namespace dynascope {
namespace {

constexpr qsizetype LongestKey = 128; ///< bytes

/// What is wrong before a parser sees it, with its line; empty where nothing is. Bad syntax is left for the parser.
QString wrongStructure(const QByteArray &json)
{
    std::vector<std::set<QByteArray>> keys; ///< of what is open
    JsonScanner scanner(json);
    const auto here = [&](const QString &what) { return QStringLiteral("line %1: %2").arg(scanner.line()).arg(what); };
    for (auto token = scanner.next(); token != JsonScanner::Token::End; token = scanner.next()) {
        if (scanner.depth() > MaximumTableFileDepth)
            return here(QStringLiteral("nested more than %1 deep").arg(MaximumTableFileDepth));
        keys.resize(static_cast<std::size_t>(scanner.depth()));
        if (token != JsonScanner::Token::Key)
            continue;
        if (scanner.text().size() > LongestKey)
            return here(QStringLiteral("a key longer than %1 bytes").arg(LongestKey));
        if (scanner.hasEscape())
            return here(QStringLiteral("a key with an escape in it"));
        if (!keys.back().insert(scanner.text().toByteArray()).second)
            return here(QStringLiteral("\"%1\" stands twice").arg(QString::fromUtf8(scanner.text())));
    }
    return {};
}

} // namespace

tl::unexpected<Error> badFile(const QString &name, const QString &text)
{
    return failure(ErrorKind::BadFile, QStringLiteral("%1: %2").arg(name, text));
}

Result<QJsonObject> readJsonObject(const QByteArray &json, const QString &name)
{
    if (json.size() > MaximumTableFileSize)
        return badFile(name, QStringLiteral("larger than %1 bytes").arg(MaximumTableFileSize));
    const QString wrong = wrongStructure(json);
    if (!wrong.isEmpty())
        return badFile(name, wrong);
    QJsonParseError error;
    const QJsonDocument document = QJsonDocument::fromJson(json, &error);
    if (error.error != QJsonParseError::NoError) {
        const auto line = json.first(qBound(qsizetype(0), qsizetype(error.offset), json.size())).count('\n') + 1;
        return badFile(name, QStringLiteral("line %1: not JSON (%2)").arg(line).arg(error.errorString()));
    }
    if (!document.isObject())
        return badFile(name, QStringLiteral("not a JSON object"));
    return document.object();
}

} // namespace dynascope
