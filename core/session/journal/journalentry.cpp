// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/journal/journalentry.h"

#include "core/protocol/protocol_values.h"

#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>

#include <algorithm>
#include <array>
#include <cmath>

namespace dynascope {
namespace {

constexpr int Format = 1;
constexpr qsizetype LongestText = 1024;
constexpr qsizetype MostChanges = 128;
constexpr std::size_t LongestSpan = 2048; ///< bytes
constexpr int HighestId = 253;

constexpr std::array Kinds{"write", "reboot", "reset", "clear", "backup", "restore", "packet"};
constexpr std::array Authors{"window", "dxl", "profile", "undo", "stop", "packing"};
constexpr std::array States{"begun", "done", "unconfirmed", "failed"};

tl::unexpected<Error> damaged(const QString &what)
{
    return failure(ErrorKind::BadFile, what);
}

/// Up to 4 bytes as a number, more as hexadecimal pairs.
QJsonValue valueOf(const Bytes &bytes, bool isSigned)
{
    if (bytes.size() <= 4)
        return bytesText(bytes, isSigned).toLongLong();
    return bytesText(bytes, isSigned);
}

std::optional<int> numberOf(const QJsonObject &object, QLatin1String key, int largest)
{
    const double number = object.value(key).toDouble(0); // 0 where it is missing
    if (!(number >= 0 && number <= largest) || std::floor(number) != number)
        return std::nullopt;
    return static_cast<int>(number);
}

QString textOf(const QJsonObject &object, QLatin1String key)
{
    return object.value(key).toString().left(LongestText);
}

template <typename Enum, std::size_t Count>
std::optional<Enum> wordIn(const std::array<const char *, Count> &words, const QString &word)
{
    const auto found = std::ranges::find_if(words, [&](const char *each) { return word == QLatin1String(each); });
    if (found == words.end())
        return std::nullopt;
    return static_cast<Enum>(found - words.begin());
}

/// Nothing where the value doesn't fit `size` bytes.
std::optional<Bytes> bytesOf(const QJsonValue &value, std::size_t size)
{
    if (value.isUndefined() || value.isNull())
        return Bytes{};
    Bytes bytes;
    if (size <= 4) {
        const double number = value.toDouble(std::nan(""));
        const double end = std::ldexp(1.0, static_cast<int>(8 * size));
        if (!(number >= -end / 2 && number < end) || std::floor(number) != number)
            return std::nullopt;
        appendLittleEndian(bytes, static_cast<std::uint32_t>(static_cast<std::int64_t>(number)),
                           static_cast<int>(size));
        return bytes;
    }
    const QByteArray digits = value.toString().toLatin1();
    const QByteArray raw = QByteArray::fromHex(digits);
    if (raw.size() != static_cast<qsizetype>(size) || digits.size() != 2 * raw.size())
        return std::nullopt;
    bytes.assign(raw.begin(), raw.end());
    return bytes;
}

QJsonObject toObject(const RegisterChange &change)
{
    QJsonObject object;
    if (!change.name.isEmpty())
        object.insert(QLatin1String("register"), change.name.left(LongestText));
    object.insert(QLatin1String("address"), change.address);
    object.insert(QLatin1String("size"), static_cast<int>(lengthOf(change)));
    if (change.isSigned)
        object.insert(QLatin1String("signed"), true);
    const auto add = [&](QLatin1String key, const Bytes &bytes) {
        if (!bytes.empty())
            object.insert(key, valueOf(bytes, change.isSigned));
    };
    add(QLatin1String("old"), change.before);
    add(QLatin1String("new"), change.after);
    add(QLatin1String("read"), change.shown);
    return object;
}

std::optional<RegisterChange> changeOf(const QJsonObject &object)
{
    RegisterChange change;
    change.name = textOf(object, QLatin1String("register"));
    const auto address = numberOf(object, QLatin1String("address"), 65535);
    const auto size = numberOf(object, QLatin1String("size"), LongestSpan);
    if (!address || !size || *size == 0)
        return std::nullopt;
    change.address = static_cast<std::uint16_t>(*address);
    change.isSigned = object.value(QLatin1String("signed")).toBool();
    const auto bytes = [&](const char *key) {
        return bytesOf(object.value(QLatin1String(key)), static_cast<std::size_t>(*size));
    };
    const auto before = bytes("old"), after = bytes("new"), shown = bytes("read");
    if (!before || !after || (before->empty() && after->empty()) || !shown)
        return std::nullopt;
    change.before = *before;
    change.after = *after;
    change.shown = *shown;
    return change;
}

QJsonObject toObject(const JournalDevice &device)
{
    QJsonObject object{{QLatin1String("line"), device.line.left(LongestText)},
                       {QLatin1String("model"), device.model.left(LongestText)},
                       {QLatin1String("number"), device.modelNumber},
                       {QLatin1String("firmware"), device.firmware},
                       {QLatin1String("id"), device.id},
                       {QLatin1String("baud"), device.baudRate}};
    if (!device.adapter.isEmpty())
        object.insert(QLatin1String("adapter"), device.adapter.left(LongestText));
    return object;
}

std::optional<JournalDevice> deviceOf(const QJsonObject &object)
{
    JournalDevice device;
    device.line = textOf(object, QLatin1String("line"));
    device.adapter = textOf(object, QLatin1String("adapter"));
    device.model = textOf(object, QLatin1String("model"));
    const auto number = numberOf(object, QLatin1String("number"), 65535);
    const auto firmware = numberOf(object, QLatin1String("firmware"), 255);
    const auto id = numberOf(object, QLatin1String("id"), 254); // a packet may go to everybody
    const auto baud = numberOf(object, QLatin1String("baud"), HighestBaudRate);
    if (!number || !firmware || !id || !baud)
        return std::nullopt;
    device.modelNumber = *number;
    device.firmware = *firmware;
    device.id = *id;
    device.baudRate = *baud;
    return device;
}

Result<void> takeWords(const QJsonObject &object, JournalEntry &entry)
{
    const auto kind = wordIn<JournalKind>(Kinds, textOf(object, QLatin1String("what")));
    const auto author = wordIn<JournalAuthor>(Authors, textOf(object, QLatin1String("by")));
    const auto state = wordIn<JournalState>(States, textOf(object, QLatin1String("state")));
    if (!kind || !author || !state)
        return damaged(QStringLiteral("an entry says none of the known words"));
    entry.kind = *kind;
    entry.by = *author;
    entry.state = *state;
    entry.at = QDateTime::fromString(textOf(object, QLatin1String("at")), Qt::ISODateWithMs);
    if (!entry.at.isValid())
        return damaged(QStringLiteral("an entry has no time"));
    entry.run = textOf(object, QLatin1String("run"));
    entry.note = textOf(object, QLatin1String("note"));
    entry.ahead = textOf(object, QLatin1String("ahead"));
    return {};
}

Result<void> takeChanges(const QJsonObject &object, JournalEntry &entry)
{
    const QJsonArray changes = object.value(QLatin1String("changes")).toArray();
    if (changes.size() > MostChanges)
        return damaged(QStringLiteral("an entry changes too many registers"));
    for (const QJsonValue &each : changes) {
        const auto change = changeOf(each.toObject());
        if (!change)
            return damaged(QStringLiteral("a register of an entry makes no sense"));
        entry.changes.push_back(*change);
        if (entry.changes.front().after.empty()) // of side effects alone it may be unknown
            return damaged(QStringLiteral("a write says not what was written"));
    }
    if (entry.kind == JournalKind::Write && entry.changes.empty())
        return damaged(QStringLiteral("a write changes no register"));
    return {};
}

} // namespace

std::size_t lengthOf(const RegisterChange &change)
{
    return std::max(change.before.size(), change.after.size());
}

QString registerText(const RegisterChange &change)
{
    if (!change.name.isEmpty())
        return change.name;
    return QStringLiteral("%1:%2").arg(change.address).arg(lengthOf(change));
}

QString bytesText(const Bytes &bytes, bool isSigned)
{
    if (bytes.empty())
        return QStringLiteral("?");
    if (bytes.size() > 4) {
        const auto *data = reinterpret_cast<const char *>(bytes.data());
        return QString::fromLatin1(QByteArray(data, static_cast<qsizetype>(bytes.size())).toHex());
    }
    const int size = static_cast<int>(bytes.size());
    auto value = static_cast<std::int64_t>(littleEndian(bytes, size));
    if (isSigned && (value >> (8 * size - 1)) != 0)
        value -= std::int64_t(1) << (8 * size);
    return QString::number(value);
}

QString deviceText(const JournalDevice &device)
{
    return QStringLiteral("%1 #%2").arg(device.model).arg(device.id);
}

QString wordOf(JournalKind kind)
{
    return QLatin1String(Kinds[static_cast<std::size_t>(kind)]);
}

QString wordOf(JournalAuthor author)
{
    return QLatin1String(Authors[static_cast<std::size_t>(author)]);
}

QString wordOf(JournalState state)
{
    return QLatin1String(States[static_cast<std::size_t>(state)]);
}

QByteArray toJson(const JournalEntry &entry)
{
    QJsonObject object{{QLatin1String("v"), Format},
                       {QLatin1String("n"), entry.number},
                       {QLatin1String("run"), entry.run},
                       {QLatin1String("at"), entry.at.toUTC().toString(Qt::ISODateWithMs)},
                       {QLatin1String("what"), wordOf(entry.kind)},
                       {QLatin1String("by"), wordOf(entry.by)},
                       {QLatin1String("state"), wordOf(entry.state)},
                       {QLatin1String("device"), toObject(entry.device)}};
    QJsonArray changes;
    for (const RegisterChange &change : entry.changes)
        changes.append(toObject(change));
    if (!changes.isEmpty())
        object.insert(QLatin1String("changes"), changes);
    if (entry.movedTo) {
        object.insert(QLatin1String("moved"), QJsonObject{{QLatin1String("id"), entry.movedTo->id},
                                                          {QLatin1String("baud"), entry.movedTo->baudRate}});
    }
    if (!entry.note.isEmpty())
        object.insert(QLatin1String("note"), entry.note.left(LongestText));
    if (entry.undoes > 0)
        object.insert(QLatin1String("undoes"), entry.undoes);
    if (entry.redoes > 0)
        object.insert(QLatin1String("redoes"), entry.redoes);
    if (!entry.ahead.isEmpty())
        object.insert(QLatin1String("ahead"), entry.ahead.left(LongestText));
    return QJsonDocument(object).toJson(QJsonDocument::Compact);
}

Result<JournalEntry> journalEntryFromJson(const QByteArray &line)
{
    if (line.size() > LongestJournalLine)
        return damaged(QStringLiteral("a line is too long"));
    const QJsonDocument document = QJsonDocument::fromJson(line);
    const QJsonObject object = document.object();
    if (!document.isObject() || object.value(QLatin1String("v")).toInt() != Format)
        return damaged(QStringLiteral("a line is no entry of this format"));
    JournalEntry entry;
    const auto number = numberOf(object, QLatin1String("n"), LargestJournalNumber);
    const auto undoes = numberOf(object, QLatin1String("undoes"), LargestJournalNumber);
    const auto redoes = numberOf(object, QLatin1String("redoes"), LargestJournalNumber);
    const auto device = deviceOf(object.value(QLatin1String("device")).toObject());
    if (!number || *number == 0 || !undoes || !redoes || !device)
        return damaged(QStringLiteral("a number of an entry is out of bounds"));
    entry.number = *number;
    entry.undoes = *undoes;
    entry.redoes = *redoes;
    entry.device = *device;
    if (const auto words = takeWords(object, entry); !words)
        return tl::unexpected(words.error());
    if (const auto changes = takeChanges(object, entry); !changes)
        return tl::unexpected(changes.error());
    if (object.contains(QLatin1String("moved"))) {
        const QJsonObject moved = object.value(QLatin1String("moved")).toObject();
        const auto id = numberOf(moved, QLatin1String("id"), HighestId);
        const auto baud = numberOf(moved, QLatin1String("baud"), HighestBaudRate);
        if (!id || !baud)
            return damaged(QStringLiteral("an entry moves a device to no place"));
        entry.movedTo = JournalPlace{*id, *baud};
    }
    return entry;
}

} // namespace dynascope
