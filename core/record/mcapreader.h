// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/record/mcapformat.h"
#include "core/result.h"

#include <QIODevice>

#include <memory>
#include <vector>

namespace dynascope::mcap {

struct Message {
    std::uint16_t channel = 0;
    std::uint32_t sequence = 0;
    std::uint64_t logTime = 0, publishTime = 0; ///< ns since 1970
    ByteView data;
};

/// An MCAP file with what its index says; without an index, or with one that can't be, what a look through the records
/// finds up to where the file is cut off. The file may be hostile: everything is bounded before it is believed. One
/// thread.
class Reader
{
public:
    struct Chunk {
        std::uint64_t begin = 0, end = 0; ///< times of its first and last message, ns since 1970
        std::uint64_t offset = 0, length = 0; ///< of its record in the file
        std::uint64_t messages = 0; ///< only without the file's own index, else 0
    };
    struct Metadata {
        QString name;
        Texts texts;
    };

    /// `file` is open for reading and can seek; `name` is what messages call it. BadFile.
    static Result<std::unique_ptr<Reader>> open(std::unique_ptr<QIODevice> file, const QString &name);

    const std::vector<Chunk> &chunks() const { return m_chunks; } ///< as they stand in the file
    const std::map<std::uint16_t, Channel> &channels() const { return m_channels; }
    const std::vector<Metadata> &metadata() const { return m_metadata; }
    std::uint64_t messages() const { return m_messages; }
    bool isWhole() const { return m_isWhole; } ///< it was closed as it should be

    /// The messages of one chunk in their order; their data lives until the next call. BadFile: damaged, or in a
    /// compression of somebody else's.
    Result<std::vector<Message>> read(std::size_t chunk);

    static constexpr std::uint64_t LargestChunk = 64 << 20;    ///< bytes, not compressed
    static constexpr std::uint64_t LargestSummary = 256 << 20; ///< bytes
    static constexpr std::uint64_t LargestRecord = 16 << 20;   ///< bytes: schemas, channels, metadata

private:
    Reader(std::unique_ptr<QIODevice> file, QString name);
    bool readSummary();
    bool takeSummary(ByteView summary);
    void scan();
    bool takeScanned(std::uint8_t opcode, std::uint64_t offset, std::uint64_t length);
    void takeChunkHead(std::uint64_t offset, std::uint64_t length);
    bool takeMetadata(std::uint64_t offset, std::uint64_t length);
    void takeChannel(ByteView content);
    std::optional<Bytes> bytesAt(std::uint64_t offset, std::uint64_t count);
    Result<void> unpack(const Chunk &chunk);
    Result<std::vector<Message>> messagesIn(ByteView records);
    tl::unexpected<Error> damaged(const QString &what = {}) const;

    std::unique_ptr<QIODevice> m_file;
    QString m_name;
    std::uint64_t m_size;
    std::vector<Chunk> m_chunks;
    std::map<std::uint16_t, Channel> m_channels;
    std::vector<Metadata> m_metadata;
    std::uint64_t m_messages = 0;
    bool m_isWhole = false;
    Bytes m_unpacked; ///< the chunk that was read last
};

} // namespace dynascope::mcap
