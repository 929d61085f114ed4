// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/record/jsonsample.h"

#include "core/record/recordedvalue.h"

#include <QJsonDocument>
#include <QJsonObject>
#include <QJsonValue>

namespace dynascope {
namespace {

/// With its quotes.
QByteArray quoted(const QString &text)
{
    const QByteArray object = QJsonDocument(QJsonObject{{text, 0}}).toJson(QJsonDocument::Compact); // {"text":0}
    return object.mid(1, object.size() - 4);
}

} // namespace

QByteArrayList jsonSamples(const RecordedBatch &batch, const RecordingHeader &header, qsizetype limit)
{
    // By hand: QJsonValue writes 17 digits, where a register has four.
    const qint64 time = header.unixTime(batch.begin);
    const QByteArray begin = "{\"timestamp\":" + QByteArray::number(static_cast<double>(time) * 1e-9, 'f', 6);
    QByteArrayList all;
    QByteArray object = begin;
    std::map<quint32, QByteArray> devices; // a device may answer several times in a cycle
    for (const RecordedReply &reply : batch.replies) {
        const RecordedDevice *device = header.device(reply.device);
        if (!device)
            continue;
        for (const RecordedField &field : device->fields) {
            const auto raw = recordedRaw(field, reply.address, reply.data);
            if (!raw)
                continue;
            QByteArray &members = devices[reply.device];
            members += members.isEmpty() ? "" : ",";
            members += quoted(field.name) + ':' + physicalText(field, *raw);
        }
    }
    for (const auto &[key, members] : devices) {
        const QByteArray part = ',' + quoted(header.device(key)->label) + ":{" + members + '}';
        if (object.size() > begin.size() && object.size() + part.size() + 1 > limit)
            all << std::exchange(object, begin) + '}';
        object += part;
    }
    if (object.size() > begin.size())
        all << object + '}';
    return all;
}

} // namespace dynascope
