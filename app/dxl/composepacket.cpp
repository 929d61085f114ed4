// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/dxl/composepacket.h"

#include "app/dxl/arguments.h"
#include "core/protocol/crc16.h"
#include "core/protocol/packet.h"
#include "core/protocol/requests.h"

#include <algorithm>
#include <array>
#include <optional>

namespace dynascope::dxl {

namespace {

constexpr std::size_t CrcSize = 2;
constexpr int LargestWord = 0xFFFF;

/// Takes words one by one; the first that is wrong ends it, and the reason is kept.
class Words
{
public:
    explicit Words(const QStringList &words) : m_words(words) { }

    bool atEnd() const { return m_next >= m_words.size(); }
    const std::optional<Error> &error() const { return m_error; }

    QString word(const QString &what)
    {
        if (!atEnd())
            return m_words[m_next++];
        refuse(QStringLiteral("%1 is missing").arg(what));
        return {};
    }
    int number(const QString &what, int largest) { return read(word(what), what, largest); }
    std::uint8_t id() { return read(word(QStringLiteral("the ID")), QStringLiteral("an ID"), BroadcastId); }
    std::uint16_t address() { return number(QStringLiteral("the address"), LargestWord); }
    std::uint16_t length() { return number(QStringLiteral("the length"), LargestWord); }

    int read(const QString &text, const QString &what, int largest)
    {
        const bool hexadecimal = text.startsWith(u"0x", Qt::CaseInsensitive);
        bool ok = false;
        const int value = hexadecimal ? text.mid(2).toInt(&ok, 16) : text.toInt(&ok);
        if (ok && value >= 0 && value <= largest)
            return value;
        refuse(QStringLiteral("\"%1\" is not %2, 0 to %3").arg(text, what).arg(largest));
        return 0;
    }
    Bytes bytes(const QStringList &texts)
    {
        Bytes all;
        for (const QString &text : texts)
            all.push_back(static_cast<std::uint8_t>(read(text, QStringLiteral("a byte"), 0xFF)));
        return all;
    }
    QStringList rest() { return m_words.mid(std::exchange(m_next, m_words.size())); }

    /// One of these words; its index.
    std::size_t choice(std::initializer_list<QString> words)
    {
        const QString given = word(QStringList(words).join(QStringLiteral(", ")));
        const auto found = std::ranges::find(words, given);
        if (found == words.end())
            refuse(QStringLiteral("\"%1\" is none of %2").arg(given, QStringList(words).join(QStringLiteral(", "))));
        return found == words.end() ? 0 : static_cast<std::size_t>(found - words.begin());
    }
    void refuse(const QString &why)
    {
        if (!m_error)
            m_error = Error{ErrorKind::InvalidArgument, why};
    }

private:
    const QStringList &m_words;
    qsizetype m_next = 0;
    std::optional<Error> m_error;
};

/// "ID:ADDRESS" and what follows behind `separator`: a length, or bytes.
struct Item {
    QStringList place;
    QString value;
};
Item itemOf(const QString &word, QChar separator)
{
    const qsizetype at = word.lastIndexOf(separator);
    return {word.left(std::max<qsizetype>(0, at)).split(u':'), word.mid(at + 1)};
}

std::vector<SpanData> writesOf(Words &words, bool bulk)
{
    std::vector<SpanData> writes;
    const std::uint16_t common = bulk ? 0 : words.address();
    for (const QString &word : words.rest()) {
        const Item item = itemOf(word, u'=');
        if (item.place.size() != (bulk ? 2 : 1))
            words.refuse(
                QStringLiteral("\"%1\" is not %2")
                    .arg(word, bulk ? QStringLiteral("ID:ADDRESS=BYTE,BYTE...") : QStringLiteral("ID=BYTE,BYTE...")));
        const auto id = words.read(item.place.value(0), QStringLiteral("an ID"), BroadcastId);
        const auto address = bulk ? words.read(item.place.value(1), QStringLiteral("an address"), LargestWord) : common;
        writes.push_back(
            {static_cast<std::uint8_t>(id), static_cast<std::uint16_t>(address), words.bytes(item.value.split(u','))});
        if (!bulk && writes.back().data.size() != writes.front().data.size())
            words.refuse(QStringLiteral("a Sync Write has as many bytes for each device"));
    }
    if (writes.empty())
        words.refuse(QStringLiteral("nobody is named"));
    return writes;
}

std::vector<Span> spansOf(Words &words)
{
    std::vector<Span> spans;
    for (const QString &word : words.rest()) {
        const QStringList parts = word.split(u':');
        if (parts.size() != 3)
            words.refuse(QStringLiteral("\"%1\" is not ID:ADDRESS:LENGTH").arg(word));
        spans.push_back(
            {static_cast<std::uint8_t>(words.read(parts.value(0), QStringLiteral("an ID"), BroadcastId)),
             static_cast<std::uint16_t>(words.read(parts.value(1), QStringLiteral("an address"), LargestWord)),
             static_cast<std::uint16_t>(words.read(parts.value(2), QStringLiteral("a length"), LargestWord))});
    }
    if (spans.empty())
        words.refuse(QStringLiteral("nobody is named"));
    return spans;
}

InstructionPacket syncRead(Words &words, bool fast)
{
    const std::uint16_t address = words.address();
    const std::uint16_t length = words.length();
    std::vector<std::uint8_t> ids;
    for (const QString &word : words.rest())
        ids.push_back(static_cast<std::uint8_t>(words.read(word, QStringLiteral("an ID"), BroadcastId)));
    if (ids.empty())
        words.refuse(QStringLiteral("nobody is named"));
    return syncReadRequest(address, length, ids, fast).packet;
}

SpanData writeOf(Words &words)
{
    const std::uint8_t id = words.id();
    const std::uint16_t address = words.address();
    Bytes bytes = words.bytes(words.rest());
    if (bytes.empty())
        words.refuse(QStringLiteral("there is no byte to write"));
    return {id, address, std::move(bytes)};
}

InstructionPacket resetOf(Words &words)
{
    constexpr std::array options{ResetOption::All, ResetOption::AllButId, ResetOption::AllButIdAndBaud};
    const std::uint8_t id = words.id();
    const std::size_t choice =
        words.choice({QStringLiteral("all"), QStringLiteral("all-but-id"), QStringLiteral("all-but-id-and-baud")});
    return factoryResetRequest(id, options[choice]).packet;
}

InstructionPacket clearOf(Words &words)
{
    const std::uint8_t id = words.id();
    const bool error = words.choice({QStringLiteral("position"), QStringLiteral("error")}) == 1;
    return clearRequest(id, error ? ClearOption::Error : ClearOption::Position).packet;
}

InstructionPacket backupOf(Words &words)
{
    const std::uint8_t id = words.id();
    const bool restore = words.choice({QStringLiteral("store"), QStringLiteral("restore")}) == 1;
    return backupRequest(id, restore ? BackupOption::Restore : BackupOption::Store).packet;
}

InstructionPacket readOf(Words &words)
{
    const std::uint8_t id = words.id();
    const std::uint16_t address = words.address();
    return readRequest({id, address, words.length()}).packet;
}

struct Composer {
    const char16_t *name;
    InstructionPacket (*compose)(Words &);
};

constexpr std::array Composers{
    Composer{u"ping", [](Words &words) { return pingRequest(words.id()).packet; }},
    Composer{u"read", readOf},
    Composer{u"write", [](Words &words) { return writeRequest(writeOf(words)).packet; }},
    Composer{u"reg-write", [](Words &words) { return regWriteRequest(writeOf(words)).packet; }},
    Composer{u"action", [](Words &words) { return actionRequest(words.id()).packet; }},
    Composer{u"reboot", [](Words &words) { return rebootRequest(words.id()).packet; }},
    Composer{u"reset", resetOf},
    Composer{u"clear", clearOf},
    Composer{u"backup", backupOf},
    Composer{u"sync-read", [](Words &words) { return syncRead(words, false); }},
    Composer{u"fast-sync-read", [](Words &words) { return syncRead(words, true); }},
    Composer{u"bulk-read", [](Words &words) { return bulkReadRequest(spansOf(words), false).packet; }},
    Composer{u"fast-bulk-read", [](Words &words) { return bulkReadRequest(spansOf(words), true).packet; }},
    Composer{u"sync-write",
             [](Words &words) {
                 const std::vector<SpanData> writes = writesOf(words, false);
                 return words.error() ? InstructionPacket() : syncWriteRequest(writes).packet;
             }},
    Composer{u"bulk-write", [](Words &words) { return bulkWriteRequest(writesOf(words, true)).packet; }},
};

QString hexText(std::uint32_t crc)
{
    return QStringLiteral("%1 %2")
        .arg(crc & 0xFF, 2, 16, QLatin1Char('0'))
        .arg(crc >> 8, 2, 16, QLatin1Char('0'))
        .toUpper();
}

} // namespace

QStringList instructionNames()
{
    QStringList names;
    for (const Composer &one : Composers)
        names << QString::fromUtf16(one.name);
    return names;
}

Result<Bytes> composePacket(const QStringList &words)
{
    const auto composer =
        std::ranges::find_if(Composers, [&](const Composer &one) { return words.value(0) == QStringView(one.name); });
    if (composer == Composers.end()) {
        return wrong(QStringLiteral("\"%1\" is no instruction that can be composed; there are %2")
                         .arg(words.value(0), instructionNames().join(QStringLiteral(", "))));
    }
    const QStringList parameters = words.mid(1);
    Words reader(parameters);
    const InstructionPacket packet = composer->compose(reader);
    if (!reader.error() && !reader.atEnd())
        reader.refuse(QStringLiteral("\"%1\" is too much").arg(reader.rest().join(u' ')));
    if (reader.error())
        return wrong(QStringLiteral("packet %1: %2").arg(words.first(), reader.error()->text));
    Bytes bytes = encode(packet);
    if (bytes.size() > MaximumPacketSize)
        return wrong(QStringLiteral("the packet would have %1 bytes; devices take %2 at most")
                         .arg(bytes.size())
                         .arg(MaximumPacketSize));
    return bytes;
}

Result<Bytes> packetFromHex(const QString &text, bool raw)
{
    QString digits = text;
    digits.remove(QStringLiteral("0x"), Qt::CaseInsensitive);
    for (const QChar separator : {u' ', u':', u',', u'\t', u'\n'})
        digits.remove(separator);
    const QByteArray bytes = QByteArray::fromHex(digits.toLatin1());
    if (bytes.isEmpty() || digits.size() != 2 * bytes.size())
        return wrong(QStringLiteral("--hex: \"%1\" are not pairs of hexadecimal digits").arg(text));
    Bytes packet(bytes.begin(), bytes.end());
    if (packet.size() > MaximumPacketSize)
        return wrong(
            QStringLiteral("--hex: %1 bytes; devices take %2 at most").arg(packet.size()).arg(MaximumPacketSize));
    if (raw)
        return packet;
    constexpr std::array<std::uint8_t, 4> Header{0xFF, 0xFF, 0xFD, 0x00};
    if (packet.size() <= HeaderSize || !std::equal(Header.begin(), Header.end(), packet.begin()))
        return wrong(QStringLiteral("--hex: a packet begins with FF FF FD 00, ID and length; --raw sends it as it is"));
    const std::size_t announced = HeaderSize + littleEndian(ByteView(packet).subspan(LengthAt), 2);
    if (announced == packet.size() + CrcSize) {
        appendLittleEndian(packet, crc16(packet), CrcSize);
        return packet;
    }
    if (announced != packet.size()) {
        return wrong(
            QStringLiteral("--hex: its length field makes it %1 bytes with CRC, there are %2; --raw sends it as "
                           "it is")
                .arg(announced)
                .arg(packet.size()));
    }
    const std::uint16_t right = crc16(ByteView(packet).first(packet.size() - CrcSize));
    if (littleEndian(ByteView(packet).last(CrcSize), CrcSize) != right)
        return wrong(QStringLiteral("--hex: its CRC should be %1; --raw sends it as it is").arg(hexText(right)));
    return packet;
}

} // namespace dynascope::dxl
