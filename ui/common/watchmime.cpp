// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/common/watchmime.h"

#include <QDataStream>
#include <QIODevice>

namespace dynascope {

namespace {

constexpr quint32 Magic = 0x44594E57; // "DYNW"
constexpr quint32 MostWatches = 10'000;

} // namespace

std::unique_ptr<QMimeData> watchesToMime(const std::vector<Watch> &watches)
{
    QByteArray bytes;
    QDataStream stream(&bytes, QIODevice::WriteOnly);
    stream.setVersion(QDataStream::Qt_6_0);
    stream << Magic << static_cast<quint32>(watches.size());
    for (const Watch &watch : watches)
        stream << watch.device << static_cast<qint32>(watch.field);
    auto mime = std::make_unique<QMimeData>();
    mime->setData(QString::fromLatin1(WatchMimeType), bytes);
    return mime;
}

std::vector<Watch> watchesFromMime(const QMimeData *mime)
{
    if (!mime || !mime->hasFormat(QString::fromLatin1(WatchMimeType)))
        return {};
    const QByteArray bytes = mime->data(QString::fromLatin1(WatchMimeType));
    QDataStream stream(bytes);
    stream.setVersion(QDataStream::Qt_6_0);
    quint32 magic = 0;
    quint32 count = 0;
    stream >> magic >> count;
    if (stream.status() != QDataStream::Ok || magic != Magic || count > MostWatches)
        return {};
    std::vector<Watch> watches;
    for (quint32 i = 0; i < count; ++i) {
        quint32 device = 0;
        qint32 field = 0;
        stream >> device >> field;
        if (stream.status() != QDataStream::Ok || field < 0)
            return {};
        watches.push_back({device, field});
    }
    return stream.atEnd() ? watches : std::vector<Watch>{};
}

} // namespace dynascope
