// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/profile/profilesave.h"
#include "core/yaml/yamltree.h"

#include <QCoreApplication>
#include <QFile>
#include <QFileInfo>
#include <QSaveFile>

namespace dynascope {
namespace {

QString tr(const char *text)
{
    return QCoreApplication::translate("Profile", text);
}

} // namespace

Result<QByteArray> profileText(const QString &path)
{
    QFile file(path);
    if (QFileInfo(path).isDir())
        return failure(ErrorKind::BadFile, tr("%1 is a folder").arg(path));
    if (!file.open(QIODevice::ReadOnly))
        return failure(file.exists() ? ErrorKind::BadFile : ErrorKind::NotFound,
                       tr("%1: %2").arg(path, file.errorString()));
    return file.read(MaximumYamlSize + 1); // one byte too many is enough to refuse it
}

Result<Profile> loadProfile(const QString &path, const Catalog &catalog)
{
    const auto text = profileText(path);
    return text ? profileFromYaml(*text, path, catalog) : tl::unexpected(text.error());
}

Result<void> writeProfile(const QString &path, const QByteArray &text)
{
    QSaveFile file(path);
    if (!file.open(QIODevice::WriteOnly) || file.write(text) != text.size() || !file.commit())
        return failure(ErrorKind::BadFile, tr("%1 can't be written: %2").arg(path, file.errorString()));
    return {};
}

} // namespace dynascope
