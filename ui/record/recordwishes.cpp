// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/record/recordwishes.h"

#include <QDir>
#include <QSettings>
#include <QStandardPaths>

#include <algorithm>

namespace dynascope {
namespace {

const QString FormatKey = QStringLiteral("record/format");
const QString FolderKey = QStringLiteral("record/folder");
const QString MinutesKey = QStringLiteral("record/splitMinutes");
const QString MegabytesKey = QStringLiteral("record/splitMegabytes");
const QString NoteKey = QStringLiteral("record/note");
const QString HostKey = QStringLiteral("stream/host");
const QString PortKey = QStringLiteral("stream/port");

} // namespace

RecordWishes RecordWishes::saved()
{
    const QSettings settings;
    RecordWishes wishes;
    if (settings.value(FormatKey).toString() == QStringLiteral("csv"))
        wishes.format = QStringLiteral("csv");
    wishes.folder = settings.value(FolderKey).toString();
    if (wishes.folder.isEmpty())
        wishes.folder = usualFolder();
    wishes.splitMinutes = std::max(0, settings.value(MinutesKey).toInt());
    wishes.splitMegabytes = std::max(0, settings.value(MegabytesKey).toInt());
    wishes.note = settings.value(NoteKey).toString();
    return wishes;
}

void RecordWishes::save() const
{
    QSettings settings;
    settings.setValue(FormatKey, format);
    settings.setValue(FolderKey, folder);
    settings.setValue(MinutesKey, splitMinutes);
    settings.setValue(MegabytesKey, splitMegabytes);
    settings.setValue(NoteKey, note);
}

QString RecordWishes::usualFolder()
{
    const QString documents = QStandardPaths::writableLocation(QStandardPaths::DocumentsLocation);
    return QDir(documents.isEmpty() ? QDir::homePath() : documents).filePath(QStringLiteral("Dynascope"));
}

StreamWishes StreamWishes::saved()
{
    const QSettings settings;
    StreamWishes wishes;
    const QString host = settings.value(HostKey).toString();
    const int port = settings.value(PortKey).toInt();
    if (!host.isEmpty())
        wishes.host = host;
    if (port > 0 && port <= 0xFFFF)
        wishes.port = port;
    return wishes;
}

void StreamWishes::save() const
{
    QSettings settings;
    settings.setValue(HostKey, host);
    settings.setValue(PortKey, port);
}

QString StreamWishes::place() const
{
    return (host.contains(u':') ? QStringLiteral("[%1]:%2") : QStringLiteral("%1:%2")).arg(host).arg(port);
}

bool StreamWishes::isThisMachine() const
{
    return host == QStringLiteral("localhost") || host == QStringLiteral("::1") || host.startsWith(QStringLiteral("127."));
}

} // namespace dynascope
