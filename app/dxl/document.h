// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QByteArray>
#include <QStringList>

#include <vector>

namespace dynascope::dxl {

/// One JSON object whose keys stay in the order they were added (QJsonObject sorts them), physical values written as
/// decimals: 180.0.
class Document
{
public:
    Document &add(const char *key, const QString &text);
    Document &add(const char *key, qint64 number);
    Document &add(const char *key, double number);
    Document &addFlag(const char *key, bool value);
    Document &add(const char *key, const Document &object);
    Document &add(const char *key, const std::vector<Document> &objects);
    Document &add(const char *key, const QStringList &texts);

    QByteArray toJson() const { return '{' + m_members + '}'; }

private:
    Document &addRaw(const char *key, const QByteArray &json);

    QByteArray m_members;
};

} // namespace dynascope::dxl
