// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/dxl/document.h"

#include <QJsonArray>
#include <QJsonDocument>

#include <cmath>

namespace dynascope::dxl {

Document &Document::add(const char *key, const QString &text)
{
    // Qt escapes strings inside a document only; the brackets around it are cut off.
    const QByteArray quoted = QJsonDocument(QJsonArray{text}).toJson(QJsonDocument::Compact);
    return addRaw(key, quoted.mid(1, quoted.size() - 2));
}

Document &Document::add(const char *key, qint64 number)
{
    return addRaw(key, QByteArray::number(number));
}

Document &Document::add(const char *key, double number)
{
    // Ten digits tell any two register values apart and hide 22.900000000000002.
    const bool whole = std::nearbyint(number) == number && std::abs(number) < 1e15;
    return addRaw(key, whole ? QByteArray::number(number, 'f', 1) : QByteArray::number(number, 'g', 10));
}

Document &Document::addFlag(const char *key, bool value)
{
    return addRaw(key, value ? "true" : "false");
}

Document &Document::add(const char *key, const Document &object)
{
    return addRaw(key, object.toJson());
}

Document &Document::add(const char *key, const std::vector<Document> &objects)
{
    QByteArrayList all;
    for (const Document &object : objects)
        all << object.toJson();
    return addRaw(key, '[' + all.join(",\n  ") + ']');
}

Document &Document::add(const char *key, const QStringList &texts)
{
    return addRaw(key, QJsonDocument(QJsonArray::fromStringList(texts)).toJson(QJsonDocument::Compact));
}

Document &Document::addRaw(const char *key, const QByteArray &json)
{
    if (!m_members.isEmpty())
        m_members += ',';
    m_members += '"' + QByteArray(key) + "\":" + json;
    return *this;
}

} // namespace dynascope::dxl
