// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/indirectfile.h"

#include "core/bus/scan.h"
#include "core/protocol/protocol_values.h"
#include "core/session/journal/journalnote.h"

#include <QCoreApplication>
#include <QCryptographicHash>
#include <QDir>
#include <QFile>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QSaveFile>
#include <QStandardPaths>

#include <cmath>
#include <optional>

namespace dynascope {
namespace {

constexpr qint64 LargestFile = 1024 * 1024;
constexpr qsizetype MostDevices = 1024, MostEntries = 512;
constexpr int LargestAddress = 0xFFFF, LargestId = 252;

struct Texts {
    Q_DECLARE_TR_FUNCTIONS(IndirectFile)
};

std::optional<int> numberOf(const QJsonValue &value, int largest)
{
    const double number = value.toDouble(-1);
    if (!(number >= 0 && number <= largest) || std::floor(number) != number)
        return std::nullopt;
    return static_cast<int>(number);
}

std::optional<SetEntries> deviceFrom(const QJsonObject &object)
{
    const auto model = numberOf(object.value(QLatin1String("model")), LargestAddress);
    const auto id = numberOf(object.value(QLatin1String("id")), LargestId);
    const auto baud = numberOf(object.value(QLatin1String("baud")), HighestBaudRate);
    const QJsonArray entries = object.value(QLatin1String("entries")).toArray();
    if (!model || !id || !baud || entries.size() > MostEntries)
        return std::nullopt;
    SetEntries device{*model, *id, *baud, {}};
    for (const QJsonValue &each : entries) {
        const QJsonArray three = each.toArray();
        const auto address = numberOf(three.at(0), LargestAddress);
        const auto before = numberOf(three.at(1), LargestAddress);
        const auto to = numberOf(three.at(2), LargestAddress);
        if (!address || !before || !to)
            return std::nullopt;
        device.entries.push_back({*address, *before, *to});
    }
    return device;
}

QJsonObject toJson(const SetEntries &device)
{
    QJsonArray entries;
    for (const SetEntries::Entry &entry : device.entries)
        entries.append(QJsonArray{entry.address, entry.before, entry.to});
    return {{QLatin1String("model"), device.modelNumber},
            {QLatin1String("id"), device.id},
            {QLatin1String("baud"), device.baudRate},
            {QLatin1String("entries"), entries}};
}

} // namespace

IndirectFile::IndirectFile(const QString &folder, const QString &line)
{
    if (folder.isEmpty() || line == QLatin1String("sim"))
        return;
    const JournalDevice here = journalDevice(Found{}, {}, line);
    const QByteArray name = (here.adapter.isEmpty() ? here.line : here.adapter).toUtf8();
    const QByteArray hash = QCryptographicHash::hash(name, QCryptographicHash::Sha1).toHex().left(16);
    m_path = QStringLiteral("%1/indirect-%2.json").arg(folder, QString::fromLatin1(hash));
}

QString IndirectFile::usualFolder()
{
    const QString data = QStandardPaths::writableLocation(QStandardPaths::GenericDataLocation);
    return data.isEmpty() ? QString() : data + QStringLiteral("/dynascope/indirect");
}

Result<std::vector<SetEntries>> IndirectFile::load() const
{
    std::vector<SetEntries> devices;
    QFile file(m_path);
    if (m_path.isEmpty() || !file.open(QIODevice::ReadOnly))
        return devices;
    const auto damaged = [this] {
        return failure(ErrorKind::BadFile, Texts::tr("%1 is damaged: which Indirect Addresses were set isn't known")
                                               .arg(m_path));
    };
    const QByteArray text = file.read(LargestFile + 1);
    if (text.size() > LargestFile)
        return damaged();
    const QJsonValue listed = QJsonDocument::fromJson(text).object().value(QLatin1String("devices"));
    if (!listed.isArray() || listed.toArray().size() > MostDevices)
        return damaged();
    for (const QJsonValue &each : listed.toArray()) {
        const auto device = deviceFrom(each.toObject());
        if (!device)
            return damaged();
        devices.push_back(*device);
    }
    return devices;
}

Result<void> IndirectFile::save(const std::vector<SetEntries> &devices) const
{
    if (m_path.isEmpty())
        return {};
    if (devices.empty()) {
        QFile::remove(m_path);
        return {};
    }
    QJsonArray list;
    for (const SetEntries &device : devices)
        list.append(toJson(device));
    const QByteArray json = QJsonDocument(QJsonObject{{QLatin1String("devices"), list}}).toJson();
    QDir().mkpath(QFileInfo(m_path).path());
    QSaveFile file(m_path);
    if (!file.open(QIODevice::WriteOnly) || file.write(json) != json.size() || !file.commit()) {
        return failure(ErrorKind::BadFile,
                       Texts::tr("what the Indirect Addresses held can't be kept in %1 (%2), and without it none is set")
                           .arg(m_path, file.errorString()));
    }
    return {};
}

} // namespace dynascope
