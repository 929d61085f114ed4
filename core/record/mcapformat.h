// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bytes.h"

#include <QString>

#include <array>
#include <bit>
#include <map>
#include <optional>

/// The container format MCAP (https://mcap.dev/spec), as far as it is needed: numbers low byte first, records of an
/// opcode, a length of 8 bytes, and that many bytes.
namespace dynascope::mcap {

constexpr std::array<std::uint8_t, 8> Magic{0x89, 'M', 'C', 'A', 'P', '0', '\r', '\n'};
constexpr std::size_t RecordHead = 9; ///< opcode and length

enum Opcode : std::uint8_t {
    HeaderRecord = 0x01,
    FooterRecord = 0x02,
    SchemaRecord = 0x03,
    ChannelRecord = 0x04,
    MessageRecord = 0x05,
    ChunkRecord = 0x06,
    MessageIndexRecord = 0x07,
    ChunkIndexRecord = 0x08,
    StatisticsRecord = 0x0B,
    MetadataRecord = 0x0C,
    MetadataIndexRecord = 0x0D,
    SummaryOffsetRecord = 0x0E,
    DataEndRecord = 0x0F,
};

using Texts = std::map<QString, QString>;

struct Channel {
    std::uint16_t id = 0;
    std::uint16_t schema = 0;
    QString topic;
    Texts metadata;
};

/// Builds what stands in a record.
class Builder
{
public:
    template <typename T>
    Builder &number(T value)
    {
        for (std::size_t i = 0; i < sizeof(T); ++i)
            m_bytes.push_back(static_cast<std::uint8_t>(static_cast<std::uint64_t>(value) >> (8 * i)));
        return *this;
    }
    Builder &text(const QString &text);
    Builder &texts(const Texts &texts);
    Builder &bytes(ByteView bytes)
    {
        m_bytes.insert(m_bytes.end(), bytes.begin(), bytes.end());
        return *this;
    }
    const Bytes &content() const { return m_bytes; }

private:
    Bytes m_bytes;
};

void appendRecord(Bytes &to, Opcode opcode, const Builder &content);

/// Reads what stands in a record. Beyond its end everything is nothing, and ok() false.
class Cursor
{
public:
    explicit Cursor(ByteView bytes) : m_rest(bytes) { }

    template <typename T>
    T number()
    {
        std::uint64_t value = 0;
        const ByteView taken = bytes(sizeof(T));
        for (std::size_t i = 0; i < taken.size(); ++i)
            value |= std::uint64_t(taken[i]) << (8 * i);
        return static_cast<T>(value);
    }
    ByteView bytes(std::uint64_t count)
    {
        if (count > m_rest.size()) {
            m_ok = false;
            m_rest = {};
            return {};
        }
        const ByteView taken = m_rest.first(static_cast<std::size_t>(count));
        m_rest = m_rest.subspan(taken.size());
        return taken;
    }
    QString text();
    Texts texts();
    ByteView rest() { return bytes(m_rest.size()); }
    bool isAtEnd() const { return m_rest.empty(); }
    bool ok() const { return m_ok; }

private:
    ByteView m_rest;
    bool m_ok = true;
};

struct Record {
    std::uint8_t opcode = 0;
    ByteView content;
};
/// The next whole record; nothing at the end, and where it is cut off (ok() is false then).
std::optional<Record> nextRecord(Cursor &cursor);

Builder channelContent(const Channel &channel);
std::optional<Channel> channelFrom(ByteView content);

std::uint32_t crc32(ByteView bytes); ///< as zip has it

} // namespace dynascope::mcap
