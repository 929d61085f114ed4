// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/record/mcapformat.h"

namespace dynascope::mcap {
namespace {

const QString Encoding = QStringLiteral("cdr");

/// Four bytes at a time: table k is that of a byte with k zero bytes behind it.
using CrcTables = std::array<std::array<std::uint32_t, 256>, 4>;

constexpr CrcTables makeTables()
{
    CrcTables tables{};
    for (std::uint32_t byte = 0; byte < 256; ++byte) {
        std::uint32_t value = byte;
        for (int bit = 0; bit < 8; ++bit)
            value = (value & 1) != 0 ? (value >> 1) ^ 0xEDB88320U : value >> 1;
        tables[0][byte] = value;
    }
    for (std::size_t k = 1; k < tables.size(); ++k) {
        for (std::size_t byte = 0; byte < 256; ++byte)
            tables[k][byte] = (tables[k - 1][byte] >> 8) ^ tables[0][tables[k - 1][byte] & 0xFF];
    }
    return tables;
}
constexpr CrcTables Tables = makeTables();

} // namespace

Builder &Builder::text(const QString &text)
{
    const QByteArray utf8 = text.toUtf8();
    number(static_cast<std::uint32_t>(utf8.size()));
    m_bytes.insert(m_bytes.end(), utf8.begin(), utf8.end());
    return *this;
}

Builder &Builder::texts(const Texts &texts)
{
    Builder inner;
    for (const auto &[key, value] : texts)
        inner.text(key).text(value);
    return number(static_cast<std::uint32_t>(inner.content().size())).bytes(inner.content());
}

void appendRecord(Bytes &to, Opcode opcode, const Builder &content)
{
    Builder head;
    head.number(static_cast<std::uint8_t>(opcode)).number(static_cast<std::uint64_t>(content.content().size()));
    to.insert(to.end(), head.content().begin(), head.content().end());
    to.insert(to.end(), content.content().begin(), content.content().end());
}

QString Cursor::text()
{
    const ByteView taken = bytes(number<std::uint32_t>());
    return QString::fromUtf8(reinterpret_cast<const char *>(taken.data()), static_cast<qsizetype>(taken.size()));
}

Texts Cursor::texts()
{
    Cursor inner(bytes(number<std::uint32_t>()));
    Texts result;
    while (inner.ok() && !inner.isAtEnd()) {
        QString key = inner.text();
        result[std::move(key)] = inner.text();
    }
    m_ok = m_ok && inner.ok();
    return result;
}

std::optional<Record> nextRecord(Cursor &cursor)
{
    if (cursor.isAtEnd())
        return std::nullopt;
    const auto opcode = cursor.number<std::uint8_t>();
    const ByteView content = cursor.bytes(cursor.number<std::uint64_t>());
    if (!cursor.ok())
        return std::nullopt;
    return Record{opcode, content};
}

Builder channelContent(const Channel &channel)
{
    Builder content;
    content.number(channel.id).number(channel.schema).text(channel.topic).text(Encoding).texts(channel.metadata);
    return content;
}

std::optional<Channel> channelFrom(ByteView content)
{
    Cursor cursor(content);
    Channel channel;
    channel.id = cursor.number<std::uint16_t>();
    channel.schema = cursor.number<std::uint16_t>();
    channel.topic = cursor.text();
    const QString encoding = cursor.text();
    channel.metadata = cursor.texts();
    if (!cursor.ok() || encoding != Encoding)
        return std::nullopt;
    return channel;
}

std::uint32_t crc32(ByteView bytes)
{
    std::uint32_t crc = 0xFFFFFFFFU;
    std::size_t i = 0;
    for (; i + 4 <= bytes.size(); i += 4) {
        crc ^= littleEndian(bytes.subspan(i), 4);
        crc = Tables[3][crc & 0xFF] ^ Tables[2][(crc >> 8) & 0xFF] ^ Tables[1][(crc >> 16) & 0xFF] ^ Tables[0][crc >> 24];
    }
    for (; i < bytes.size(); ++i)
        crc = (crc >> 8) ^ Tables[0][(crc ^ bytes[i]) & 0xFF];
    return ~crc;
}

} // namespace dynascope::mcap
