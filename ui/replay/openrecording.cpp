// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/replay/openrecording.h"

#include "ui/common/filedialogs.h"
#include "ui/record/recordwishes.h"

#include <QCoreApplication>
#include <QMimeData>
#include <QUrl>

namespace dynascope {

void askForRecording(QWidget *parent, std::function<void(const QString &path)> open)
{
    askWhatToOpen(parent, QCoreApplication::translate("ReplayWindow", "Open a recording"), {QStringLiteral("mcap")}, std::move(open),
                  RecordWishes::saved().folder);
}

QStringList recordingsOf(const QMimeData &dragged)
{
    QStringList paths;
    for (const QUrl &url : dragged.urls()) {
        if (url.isLocalFile() && url.fileName().endsWith(QStringLiteral(".mcap"), Qt::CaseInsensitive))
            paths << url.toLocalFile();
    }
    return paths;
}

} // namespace dynascope
