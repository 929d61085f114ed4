// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/record/mcapformat.h"
#include "core/record/recordfile_posix.h"

#include <memory>
#include <vector>

struct ZSTD_CCtx_s;

namespace dynascope::mcap {

/// Writes one MCAP file: messages gather in a chunk, which flush() compresses and brings to the disk, so that a program
/// that dies loses what came since. finish() adds the index, without which a reader looks through the chunks. One
/// thread.
class Writer
{
public:
    static constexpr std::size_t ChunkSize = 1 << 20; ///< bytes, not compressed; then it is time for flush()

    /// BadFile, as RecordFile::create().
    static Result<std::unique_ptr<Writer>> create(const QString &path, const QString &library);
    ~Writer();

    std::uint16_t addSchema(const QString &name, const QString &definition); ///< as a ROS 2 message file
    /// Of messages as ROS 2 serialises them (CDR).
    std::uint16_t addChannel(std::uint16_t schema, const QString &topic, const Texts &metadata);
    void addMetadata(const QString &name, const Texts &texts);
    /// Times in ns since 1970.
    void addMessage(std::uint16_t channel, std::uint32_t sequence, qint64 logTime, qint64 publishTime, ByteView data);

    const QString &path() const { return m_file.path(); }
    qint64 bytes() const { return m_file.size(); } ///< of the file
    std::size_t waiting() const { return m_chunk.size() + m_pending.size(); } ///< bytes that flush() would write
    /// On an error the file ends with the last flush() that went well.
    Result<void> flush();
    Result<void> finish(); ///< nothing may be added behind it

private:
    struct ChunkIndex {
        std::uint64_t begin = 0, end = 0; ///< times
        std::uint64_t offset = 0, length = 0;
        std::map<std::uint16_t, std::uint64_t> indexOffsets; ///< by channel
        std::uint64_t indexLength = 0;
        QString compression;
        std::uint64_t compressed = 0, uncompressed = 0;
    };
    struct MetadataIndex {
        std::uint64_t offset = 0, length = 0;
        QString name;
    };

    explicit Writer(posix::RecordFile file);
    void appendChunk(Bytes &to);
    void appendMessageIndexes(Bytes &to, std::uint64_t base, ChunkIndex &chunk);
    Bytes summary(std::uint64_t start, std::uint64_t &offsetsStart) const;
    Builder statistics() const;

    posix::RecordFile m_file;
    std::unique_ptr<ZSTD_CCtx_s, std::size_t (*)(ZSTD_CCtx_s *)> m_compressor;
    Bytes m_pending; ///< records that stand before the next chunk
    std::vector<MetadataIndex> m_pendingMetadata; ///< offsets from the begin of m_pending
    Bytes m_chunk;
    std::uint64_t m_chunkBegin = 0, m_chunkEnd = 0;
    std::vector<std::vector<std::pair<std::uint64_t, std::uint64_t>>> m_messages; ///< by channel: time, offset in m_chunk

    Bytes m_schemas, m_channels; ///< as records, once more for the summary
    std::vector<MetadataIndex> m_metadata;
    std::vector<ChunkIndex> m_chunks;
    std::vector<std::uint64_t> m_counts; ///< by channel: messages
    std::uint16_t m_schemaCount = 0;
};

} // namespace dynascope::mcap
