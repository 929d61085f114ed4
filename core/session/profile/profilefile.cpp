// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/profile/profilesave.h"
#include "core/session/texts.h"
#include "core/yaml/yamltree.h"

#include <QFile>
#include <QFileInfo>
#include <QSaveFile>

namespace dynascope {

Result<QByteArray> profileText(const QString &path)
{
    QFile file(path);
    if (QFileInfo(path).isDir())
        return failure(ErrorKind::BadFile, ProfileText::tr("%1 is a folder").arg(path));
    if (!file.open(QIODevice::ReadOnly))
        return failure(file.exists() ? ErrorKind::BadFile : ErrorKind::NotFound,
                       ProfileText::tr("%1: %2").arg(path, file.errorString()));
    QByteArray text = file.read(MaximumYamlSize + 1); // one byte too many is enough to refuse it
    if (text.size() > MaximumYamlSize)
        return failure(ErrorKind::BadFile, ProfileText::tr("%1: larger than %2 bytes").arg(path).arg(MaximumYamlSize));
    return text;
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
        return failure(ErrorKind::BadFile, ProfileText::tr("%1 can't be written: %2").arg(path, file.errorString()));
    return {};
}

} // namespace dynascope
