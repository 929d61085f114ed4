// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/record/mcapreader.h"

#include <algorithm>

#include <zstd.h>

namespace dynascope::mcap {
namespace {

constexpr std::uint64_t FooterSize = RecordHead + 8 + 8 + 4;
constexpr std::uint64_t ChunkHead = 8 + 8 + 8 + 4 + 4; ///< up to the name of the compression
constexpr std::size_t MostMetadata = 100'000;

} // namespace

Result<std::unique_ptr<Reader>> Reader::open(std::unique_ptr<QIODevice> file, const QString &name)
{
    std::unique_ptr<Reader> reader(new Reader(std::move(file), name));
    const std::optional<Bytes> begin = reader->bytesAt(0, Magic.size());
    if (!begin || !std::equal(Magic.begin(), Magic.end(), begin->begin()))
        return failure(ErrorKind::BadFile, QStringLiteral("%1: this is no MCAP file").arg(name));
    reader->m_isWhole = reader->readSummary();
    if (!reader->m_isWhole) {
        reader->m_chunks.clear();
        reader->m_channels.clear();
        reader->m_metadata.clear();
        reader->m_messages = 0;
        reader->scan();
    }
    return reader;
}

Reader::Reader(std::unique_ptr<QIODevice> file, QString name)
    : m_file(std::move(file))
    , m_name(std::move(name))
    , m_size(static_cast<std::uint64_t>(std::max<qint64>(0, m_file->size())))
{
}

std::optional<Bytes> Reader::bytesAt(std::uint64_t offset, std::uint64_t count)
{
    if (offset > m_size || count > m_size - offset || !m_file->seek(static_cast<qint64>(offset)))
        return std::nullopt;
    Bytes bytes(static_cast<std::size_t>(count));
    const qint64 read = m_file->read(reinterpret_cast<char *>(bytes.data()), static_cast<qint64>(count));
    if (read != static_cast<qint64>(count))
        return std::nullopt;
    return bytes;
}

tl::unexpected<Error> Reader::damaged(const QString &what) const
{
    return failure(ErrorKind::BadFile,
                   QStringLiteral("%1: %2").arg(m_name, what.isEmpty() ? QStringLiteral("a part of it is damaged") : what));
}

bool Reader::readSummary()
{
    if (m_size < 2 * Magic.size() + FooterSize)
        return false;
    const std::uint64_t footerAt = m_size - Magic.size() - FooterSize;
    const std::optional<Bytes> end = bytesAt(footerAt, m_size - footerAt);
    if (!end || !std::equal(Magic.begin(), Magic.end(), end->end() - qsizetype(Magic.size())))
        return false;
    Cursor cursor(*end);
    const auto footer = nextRecord(cursor);
    if (!footer || footer->opcode != FooterRecord)
        return false;
    Cursor content(footer->content);
    const auto start = content.number<std::uint64_t>();
    const auto offsetsStart = content.number<std::uint64_t>();
    const auto crc = content.number<std::uint32_t>();
    if (!content.ok() || start < Magic.size() || start > footerAt || footerAt - start > LargestSummary)
        return false;
    auto summary = bytesAt(start, footerAt - start + FooterSize - 4);
    if (!summary || (crc != 0 && crc32(*summary) != crc))
        return false;
    const std::uint64_t length = (offsetsStart >= start && offsetsStart <= footerAt ? offsetsStart : footerAt) - start;
    return takeSummary(ByteView(*summary).first(static_cast<std::size_t>(length)));
}

bool Reader::takeSummary(ByteView summary)
{
    Cursor cursor(summary);
    while (const auto record = nextRecord(cursor)) {
        Cursor content(record->content);
        if (record->opcode == ChannelRecord) {
            takeChannel(record->content);
        } else if (record->opcode == StatisticsRecord) {
            m_messages = content.number<std::uint64_t>();
        } else if (record->opcode == MetadataIndexRecord) {
            const auto offset = content.number<std::uint64_t>();
            const auto length = content.number<std::uint64_t>();
            if (!content.ok() || length < RecordHead || !takeMetadata(offset, length))
                return false;
        } else if (record->opcode == ChunkIndexRecord) {
            Chunk chunk;
            chunk.begin = content.number<std::uint64_t>();
            chunk.end = content.number<std::uint64_t>();
            chunk.offset = content.number<std::uint64_t>();
            chunk.length = content.number<std::uint64_t>();
            if (!content.ok() || chunk.offset > m_size || chunk.length > m_size - chunk.offset)
                return false;
            m_chunks.push_back(chunk);
        }
    }
    return cursor.ok();
}

void Reader::scan()
{
    std::uint64_t at = Magic.size();
    while (const std::optional<Bytes> head = bytesAt(at, RecordHead)) {
        Cursor cursor(*head);
        const auto opcode = cursor.number<std::uint8_t>();
        const auto length = cursor.number<std::uint64_t>();
        at += RecordHead;
        // What is cut off ends the file; behind DataEnd there is nothing but what was looked for in vain.
        if (length > m_size - at || opcode == 0 || opcode == DataEndRecord || !takeScanned(opcode, at, length))
            break;
        at += length;
    }
}

/// `offset` and `length` are those of the record's content. False where it can't be.
bool Reader::takeScanned(std::uint8_t opcode, std::uint64_t offset, std::uint64_t length)
{
    switch (opcode) {
    case ChannelRecord: {
        const std::optional<Bytes> content = length <= LargestRecord ? bytesAt(offset, length) : std::nullopt;
        if (content)
            takeChannel(*content);
        return content.has_value();
    }
    case MetadataRecord: return takeMetadata(offset - RecordHead, length + RecordHead);
    case ChunkRecord: takeChunkHead(offset, length); return true;
    case MessageIndexRecord:
        if (const auto head = bytesAt(offset, std::min<std::uint64_t>(length, 6)); head && !m_chunks.empty()) {
            Cursor cursor(ByteView(*head).subspan(std::min<std::size_t>(2, head->size())));
            const std::uint64_t messages = std::min<std::uint64_t>(cursor.number<std::uint32_t>(), length) / 16;
            m_chunks.back().messages += messages;
            m_messages += messages;
        }
        return true;
    default: return true;
    }
}

void Reader::takeChunkHead(std::uint64_t offset, std::uint64_t length)
{
    const auto head = bytesAt(offset, std::min<std::uint64_t>(length, 16));
    if (!head)
        return;
    Cursor cursor(*head);
    Chunk chunk;
    chunk.begin = cursor.number<std::uint64_t>();
    chunk.end = cursor.number<std::uint64_t>();
    chunk.offset = offset - RecordHead;
    chunk.length = length + RecordHead;
    if (cursor.ok())
        m_chunks.push_back(chunk);
}

/// Of the whole record.
bool Reader::takeMetadata(std::uint64_t offset, std::uint64_t length)
{
    if (length > LargestRecord || m_metadata.size() >= MostMetadata)
        return false;
    const std::optional<Bytes> bytes = bytesAt(offset, length);
    if (!bytes)
        return false;
    Cursor cursor(*bytes);
    const auto record = nextRecord(cursor);
    if (!record || record->opcode != MetadataRecord)
        return false;
    Cursor content(record->content);
    Metadata metadata;
    metadata.name = content.text();
    metadata.texts = content.texts();
    if (content.ok())
        m_metadata.push_back(std::move(metadata));
    return content.ok();
}

void Reader::takeChannel(ByteView content)
{
    if (auto channel = channelFrom(content))
        m_channels[channel->id] = std::move(*channel);
}

Result<std::vector<Message>> Reader::read(std::size_t index)
{
    if (const auto unpacked = unpack(m_chunks[index]); !unpacked)
        return tl::unexpected(unpacked.error());
    return messagesIn(m_unpacked);
}

/// Into m_unpacked.
Result<void> Reader::unpack(const Chunk &chunk)
{
    const auto bytes = chunk.length <= LargestChunk ? bytesAt(chunk.offset, chunk.length) : std::nullopt;
    Cursor file(bytes ? ByteView(*bytes) : ByteView());
    const auto record = nextRecord(file);
    if (!record || record->opcode != ChunkRecord || record->content.size() < ChunkHead)
        return damaged();
    Cursor content(record->content.subspan(16));
    const auto size = content.number<std::uint64_t>();
    const auto crc = content.number<std::uint32_t>();
    const QString compression = content.text();
    const ByteView packed = content.bytes(content.number<std::uint64_t>());
    if (!content.ok() || size > LargestChunk)
        return damaged();
    if (compression.isEmpty()) {
        m_unpacked.assign(packed.begin(), packed.end());
    } else if (compression == u"zstd") {
        m_unpacked.resize(static_cast<std::size_t>(size));
        const std::size_t done = ZSTD_decompress(m_unpacked.data(), m_unpacked.size(), packed.data(), packed.size());
        if (ZSTD_isError(done) != 0 || done != size)
            return damaged();
    } else {
        return damaged(QStringLiteral("it is compressed by %1, of which this program reads zstd alone").arg(compression));
    }
    return crc == 0 || crc32(m_unpacked) == crc ? Result<void>() : damaged();
}

Result<std::vector<Message>> Reader::messagesIn(ByteView bytes)
{
    std::vector<Message> messages;
    Cursor records(bytes);
    while (const auto record = nextRecord(records)) {
        if (record->opcode == ChannelRecord)
            takeChannel(record->content); // other writers put them here
        if (record->opcode != MessageRecord)
            continue;
        Cursor content(record->content);
        Message message;
        message.channel = content.number<std::uint16_t>();
        message.sequence = content.number<std::uint32_t>();
        message.logTime = content.number<std::uint64_t>();
        message.publishTime = content.number<std::uint64_t>();
        message.data = content.rest();
        if (content.ok())
            messages.push_back(message);
    }
    if (!records.ok())
        return damaged();
    return messages;
}

} // namespace dynascope::mcap
