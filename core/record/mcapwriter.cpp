// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/record/mcapwriter.h"

#include <algorithm>

#include <zstd.h>

namespace dynascope::mcap {
namespace {

constexpr int Level = 3;

Builder metadataIndex(std::uint64_t offset, std::uint64_t length, const QString &name)
{
    Builder content;
    content.number(offset).number(length).text(name);
    return content;
}

} // namespace

Result<std::unique_ptr<Writer>> Writer::create(const QString &path, const QString &library)
{
    auto file = posix::RecordFile::create(path);
    if (!file)
        return tl::unexpected(file.error());
    Bytes begin(Magic.begin(), Magic.end());
    appendRecord(begin, HeaderRecord, Builder().text({}).text(library));
    if (const auto written = file->append(begin); !written)
        return tl::unexpected(written.error());
    return std::unique_ptr<Writer>(new Writer(std::move(*file)));
}

Writer::Writer(posix::RecordFile file)
    : m_file(std::move(file))
    , m_compressor(ZSTD_createCCtx(), ZSTD_freeCCtx)
{
    ZSTD_CCtx_setParameter(m_compressor.get(), ZSTD_c_compressionLevel, Level);
}

Writer::~Writer() = default;

std::uint16_t Writer::addSchema(const QString &name, const QString &definition)
{
    const std::uint16_t id = ++m_schemaCount; // 0 means none
    Bytes record;
    appendRecord(record, SchemaRecord,
                 Builder().number(id).text(name).text(QStringLiteral("ros2msg")).text(definition));
    m_pending.insert(m_pending.end(), record.begin(), record.end());
    m_schemas.insert(m_schemas.end(), record.begin(), record.end());
    return id;
}

std::uint16_t Writer::addChannel(std::uint16_t schema, const QString &topic, const Texts &metadata)
{
    Channel channel;
    channel.id = static_cast<std::uint16_t>(m_counts.size());
    channel.schema = schema;
    channel.topic = topic;
    channel.metadata = metadata;
    Bytes record;
    appendRecord(record, ChannelRecord, channelContent(channel));
    m_pending.insert(m_pending.end(), record.begin(), record.end());
    m_channels.insert(m_channels.end(), record.begin(), record.end());
    m_counts.push_back(0);
    m_messages.emplace_back();
    return channel.id;
}

void Writer::addMetadata(const QString &name, const Texts &texts)
{
    const std::uint64_t offset = m_pending.size();
    appendRecord(m_pending, MetadataRecord, Builder().text(name).texts(texts));
    m_pendingMetadata.push_back({offset, m_pending.size() - offset, name});
}

void Writer::addMessage(std::uint16_t channel, std::uint32_t sequence, qint64 logTime, qint64 publishTime,
                        ByteView data)
{
    const auto time = static_cast<std::uint64_t>(std::max<qint64>(0, logTime));
    m_chunkBegin = m_chunk.empty() ? time : std::min(m_chunkBegin, time);
    m_chunkEnd = m_chunk.empty() ? time : std::max(m_chunkEnd, time);
    m_messages[channel].emplace_back(time, m_chunk.size());
    ++m_counts[channel];
    constexpr std::uint64_t Fixed = 2 + 4 + 8 + 8;
    std::array<std::uint8_t, RecordHead + Fixed> head{};
    std::size_t at = 0;
    const auto put = [&](std::uint64_t value, int size) {
        for (int i = 0; i < size; ++i)
            head[at++] = static_cast<std::uint8_t>(value >> (8 * i));
    };
    put(MessageRecord, 1);
    put(Fixed + data.size(), 8);
    put(channel, 2);
    put(sequence, 4);
    put(time, 8);
    put(static_cast<std::uint64_t>(std::max<qint64>(0, publishTime)), 8);
    m_chunk.insert(m_chunk.end(), head.begin(), head.end());
    m_chunk.insert(m_chunk.end(), data.begin(), data.end());
}

Result<void> Writer::flush()
{
    if (waiting() == 0)
        return {};
    // In one piece: what can't be written whole is taken back whole.
    const auto base = static_cast<std::uint64_t>(m_file.size());
    const std::size_t chunksBefore = m_chunks.size();
    Bytes all = m_pending;
    if (!m_chunk.empty())
        appendChunk(all);
    if (const auto written = m_file.append(all); !written) {
        m_chunks.resize(chunksBefore);
        return written;
    }
    for (const MetadataIndex &one : m_pendingMetadata)
        m_metadata.push_back({base + one.offset, one.length, one.name});
    m_pendingMetadata.clear();
    m_pending.clear();
    m_chunk.clear();
    for (auto &messages : m_messages)
        messages.clear();
    return m_file.sync();
}

void Writer::appendChunk(Bytes &to)
{
    const auto base = static_cast<std::uint64_t>(m_file.size());
    Bytes packed(ZSTD_compressBound(m_chunk.size()));
    const std::size_t size =
        ZSTD_compress2(m_compressor.get(), packed.data(), packed.size(), m_chunk.data(), m_chunk.size());
    const bool isPacked = ZSTD_isError(size) == 0; // else there is no memory for its tables
    if (isPacked)
        packed.resize(size);
    const Bytes &content = isPacked ? packed : m_chunk;

    ChunkIndex chunk;
    chunk.begin = m_chunkBegin;
    chunk.end = m_chunkEnd;
    chunk.offset = base + to.size();
    chunk.compression = isPacked ? QStringLiteral("zstd") : QString();
    chunk.compressed = content.size();
    chunk.uncompressed = m_chunk.size();
    Builder record;
    record.number(chunk.begin).number(chunk.end).number(chunk.uncompressed).number(crc32(m_chunk));
    record.text(chunk.compression).number(chunk.compressed).bytes(content);
    appendRecord(to, ChunkRecord, record);
    chunk.length = base + to.size() - chunk.offset;
    appendMessageIndexes(to, base, chunk);
    m_chunks.push_back(std::move(chunk));
}

void Writer::appendMessageIndexes(Bytes &to, std::uint64_t base, ChunkIndex &chunk)
{
    const std::size_t begin = to.size();
    for (std::size_t channel = 0; channel < m_messages.size(); ++channel) {
        if (m_messages[channel].empty())
            continue;
        chunk.indexOffsets[static_cast<std::uint16_t>(channel)] = base + to.size();
        Builder content;
        content.number(static_cast<std::uint16_t>(channel))
            .number(static_cast<std::uint32_t>(16 * m_messages[channel].size()));
        for (const auto &[time, offset] : m_messages[channel])
            content.number(time).number(offset);
        appendRecord(to, MessageIndexRecord, content);
    }
    chunk.indexLength = to.size() - begin;
}

Builder Writer::statistics() const
{
    std::uint64_t messages = 0, begin = 0, end = 0;
    Builder counts;
    for (std::size_t channel = 0; channel < m_counts.size(); ++channel) {
        messages += m_counts[channel];
        counts.number(static_cast<std::uint16_t>(channel)).number(m_counts[channel]);
    }
    for (const ChunkIndex &chunk : m_chunks) {
        begin = &chunk == m_chunks.data() ? chunk.begin : std::min(begin, chunk.begin);
        end = std::max(end, chunk.end);
    }
    Builder content;
    content.number(messages).number(m_schemaCount).number(static_cast<std::uint32_t>(m_counts.size()));
    content.number(std::uint32_t(0)).number(static_cast<std::uint32_t>(m_metadata.size()));
    content.number(static_cast<std::uint32_t>(m_chunks.size())).number(begin).number(end);
    content.number(static_cast<std::uint32_t>(counts.content().size())).bytes(counts.content());
    return content;
}

/// The records of the summary section, and behind them, from `offsetsStart` on, where each kind of them stands.
Bytes Writer::summary(std::uint64_t start, std::uint64_t &offsetsStart) const
{
    Bytes all;
    Bytes offsets;
    std::size_t begin = 0;
    const auto group = [&](Opcode opcode) {
        if (all.size() > begin)
            appendRecord(offsets, SummaryOffsetRecord,
                         Builder().number(std::uint8_t(opcode)).number(std::uint64_t(start + begin)).number(
                             std::uint64_t(all.size() - begin)));
        begin = all.size();
    };
    all.insert(all.end(), m_schemas.begin(), m_schemas.end());
    group(SchemaRecord);
    all.insert(all.end(), m_channels.begin(), m_channels.end());
    group(ChannelRecord);
    appendRecord(all, StatisticsRecord, statistics());
    group(StatisticsRecord);
    for (const MetadataIndex &one : m_metadata)
        appendRecord(all, MetadataIndexRecord, metadataIndex(one.offset, one.length, one.name));
    group(MetadataIndexRecord);
    for (const ChunkIndex &chunk : m_chunks) {
        Builder content;
        content.number(chunk.begin).number(chunk.end).number(chunk.offset).number(chunk.length);
        content.number(static_cast<std::uint32_t>(10 * chunk.indexOffsets.size()));
        for (const auto &[channel, offset] : chunk.indexOffsets)
            content.number(channel).number(offset);
        content.number(chunk.indexLength).text(chunk.compression).number(chunk.compressed).number(chunk.uncompressed);
        appendRecord(all, ChunkIndexRecord, content);
    }
    group(ChunkIndexRecord);
    offsetsStart = start + all.size();
    all.insert(all.end(), offsets.begin(), offsets.end());
    return all;
}

Result<void> Writer::finish()
{
    if (const auto flushed = flush(); !flushed)
        return flushed;
    Bytes end;
    appendRecord(end, DataEndRecord, Builder().number(std::uint32_t(0))); // 0: no CRC, each chunk has its own
    const std::uint64_t start = static_cast<std::uint64_t>(m_file.size()) + end.size();
    std::uint64_t offsetsStart = 0;
    Bytes closing = summary(start, offsetsStart);
    // The footer's CRC covers the summary and the footer up to the CRC.
    Builder head;
    head.number(std::uint8_t(FooterRecord)).number(std::uint64_t(8 + 8 + 4)).number(start).number(offsetsStart);
    closing.insert(closing.end(), head.content().begin(), head.content().end());
    const Builder crc = Builder().number(crc32(closing));
    closing.insert(closing.end(), crc.content().begin(), crc.content().end());
    end.insert(end.end(), closing.begin(), closing.end());
    end.insert(end.end(), Magic.begin(), Magic.end());
    if (const auto written = m_file.append(end); !written)
        return written;
    return m_file.sync();
}

} // namespace dynascope::mcap
