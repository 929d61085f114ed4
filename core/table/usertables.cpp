// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/table/usertables.h"

#include "core/table/jsonguard.h"
#include "core/table/tableoutline.h"

#include <QDir>
#include <QFile>
#include <QStandardPaths>

#include <algorithm>

namespace dynascope {
namespace {

constexpr qsizetype MostFiles = 200;

struct Waiting {
    QString name; ///< without folder
    QByteArray json;
    QString extends;
};

QString stem(const QString &name)
{
    return name.chopped(5); // ".json"
}

} // namespace

QString userTablesFolder()
{
    const QString named = qEnvironmentVariable("DYNASCOPE_TABLES");
    if (!named.isEmpty())
        return named;
    return QStandardPaths::writableLocation(QStandardPaths::GenericDataLocation)
           + QStringLiteral("/dynascope/controltables");
}

Result<QByteArray> readTableFile(const QString &path)
{
    QFile file(path);
    if (!file.open(QIODevice::ReadOnly))
        return failure(ErrorKind::NotFound, QStringLiteral("%1: %2").arg(path, file.errorString()));
    // A device file has no size: one byte more than allowed is enough to know.
    QByteArray bytes = file.read(MaximumTableFileSize + 1);
    if (bytes.size() > MaximumTableFileSize) {
        return failure(ErrorKind::BadFile,
                       QStringLiteral("%1: larger than %2 bytes").arg(path).arg(MaximumTableFileSize));
    }
    return bytes;
}

UserTables addUserTables(Catalog &catalog, const QString &folder, const QString &except)
{
    UserTables result;
    QStringList names = QDir(folder).entryList({QStringLiteral("*.json")}, QDir::Files | QDir::Readable, QDir::Name);
    if (names.size() > MostFiles) {
        result.refused.push_back(
            {{ErrorKind::BadFile,
              QStringLiteral("%1: more than %2 files; only the first are read").arg(folder).arg(MostFiles), 0},
             names.at(MostFiles)});
        names = names.first(MostFiles);
    }
    std::vector<Waiting> waiting;
    const Result<QByteArray> left = except.isEmpty() ? Result<QByteArray>(QByteArray()) : readTableFile(except);
    for (const QString &name : names) {
        Result<QByteArray> json = readTableFile(folder + u'/' + name);
        if (json && left && !left->isEmpty() && *json == *left)
            continue;
        if (json)
            waiting.push_back({name, *json, outlineOf(*json).extends});
        else
            result.refused.push_back({json.error(), name});
    }
    while (!waiting.empty()) {
        // Next is one that extends none of those still to come; in a circle, any: adding it says what is missing.
        auto next = std::find_if(waiting.begin(), waiting.end(), [&](const Waiting &file) {
            return std::none_of(waiting.begin(), waiting.end(), [&](const Waiting &other) {
                return stem(other.name) == file.extends && &other != &file;
            });
        });
        if (next == waiting.end())
            next = waiting.begin();
        const Result<void> added = catalog.add(next->json, folder + u'/' + next->name);
        if (added)
            result.added.append(next->name);
        else
            result.refused.push_back({added.error(), next->name});
        waiting.erase(next);
    }
    return result;
}

} // namespace dynascope
