// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/history/foldedhistory.h"

#include <array>

namespace dynascope {

namespace {

constexpr std::size_t MostGaps = 16; ///< of one chunk

} // namespace

void FoldedHistory::Blocks::includeFine(Extremes &result, std::size_t begin, std::size_t end) const
{
    fine.include(result, begin, end);
}

void FoldedHistory::Blocks::includeCoarse(Extremes &result, std::size_t begin, std::size_t end) const
{
    coarse.include(result, begin, end);
}

void FoldedHistory::charge(Chunk &chunk, HistoryMemory *memory)
{
    std::size_t bytes = sizeof(Chunk) + chunk.gaps * sizeof(Gap);
    Detail detail = Detail::Whole;
    if (const Blocks *blocks = chunk.blocks.get()) {
        detail = blocks->size == FineSize ? Detail::Fine : Detail::Coarse;
        bytes += sizeof(Blocks) + blocks->starts.heapBytes() + blocks->fine.heapBytes() + blocks->coarse.heapBytes()
            + 5 * HistoryMemory::Overhead;
    }
    chunk.charge = MemoryCharge(memory, detail, bytes);
}

void FoldedHistory::add(PackedChunk chunk, HistoryMemory *memory)
{
    std::array<LineTime, ChunkSize / FineSize> starts{};
    for (std::size_t i = 0; i < starts.size(); ++i)
        starts[i] = chunk.at(i * FineSize);
    Chunk folded{chunk.all(), starts.front(), std::make_unique<Blocks>(), addGaps(chunk), {}};
    *folded.blocks = {FineSize, PackedTimes(starts), chunk.takeFine(), chunk.takeCoarse()};
    charge(folded, memory);
    m_last = chunk.at(ChunkSize - 1);
    m_chunks.push_back(std::move(folded));
}

/// How many were added: of a chunk that holds too many the longest.
std::uint16_t FoldedHistory::addGaps(const PackedChunk &chunk)
{
    std::vector<Gap> gaps;
    for (const std::uint16_t slot : chunk.gaps()) {
        if (slot > 0 || !isEmpty())
            gaps.push_back({slot > 0 ? chunk.at(slot - 1U) : m_last, chunk.at(slot), endPlace() + slot});
    }
    if (gaps.size() > MostGaps) {
        const auto isLonger = [](const Gap &a, const Gap &b) { return a.after - a.before > b.after - b.before; };
        std::ranges::nth_element(gaps, gaps.begin() + MostGaps, isLonger);
        gaps.resize(MostGaps);
        std::ranges::sort(gaps, {}, &Gap::place);
    }
    m_gaps.insert(m_gaps.end(), gaps.begin(), gaps.end());
    return static_cast<std::uint16_t>(gaps.size());
}

std::size_t FoldedHistory::count(Detail detail) const
{
    switch (detail) {
    case Detail::Fine: return m_chunks.size() - m_whole - m_coarse;
    case Detail::Coarse: return m_coarse;
    case Detail::Whole: return m_whole;
    case Detail::Samples: break;
    }
    return 0;
}

std::size_t FoldedHistory::indexOf(Detail detail) const
{
    return detail == Detail::Fine ? m_whole + m_coarse : detail == Detail::Coarse ? m_whole : 0;
}

std::optional<LineTime> FoldedHistory::oldest(Detail detail) const
{
    if (count(detail) == 0)
        return std::nullopt;
    return m_chunks[indexOf(detail)].first;
}

void FoldedHistory::foldOldest(Detail detail, HistoryMemory *memory)
{
    if (count(detail) == 0)
        return;
    if (detail == Detail::Whole) {
        m_chunks.pop_front();
        ++m_dropped;
        --m_whole;
        while (!m_gaps.empty() && m_gaps.front().place < m_dropped * ChunkSize)
            m_gaps.pop_front();
        return;
    }
    Chunk &chunk = m_chunks[indexOf(detail)];
    if (detail == Detail::Fine) {
        std::array<LineTime, ChunkSize / CoarseSize> starts{};
        for (std::size_t i = 0; i < starts.size(); ++i)
            starts[i] = chunk.blocks->starts[i * Fan];
        *chunk.blocks = {CoarseSize, PackedTimes(starts), {}, std::move(chunk.blocks->coarse)};
        ++m_coarse;
    } else {
        chunk.blocks.reset();
        --m_coarse;
        ++m_whole;
    }
    charge(chunk, memory);
}

std::size_t FoldedHistory::blockSize(Place place) const
{
    const Chunk &chunk = chunkOf(place);
    return chunk.blocks ? chunk.blocks->size : ChunkSize;
}

/// The first block that doesn't begin before `at`.
FoldedHistory::Place FoldedHistory::firstBlock(LineTime at) const
{
    const auto next = std::ranges::lower_bound(m_chunks, at, {}, &Chunk::first);
    const auto index = static_cast<std::size_t>(next - m_chunks.begin());
    const Place place = (m_dropped + index) * ChunkSize;
    if (index == 0 || !m_chunks[index - 1].blocks)
        return place;
    const Blocks &before = *m_chunks[index - 1].blocks;
    return place - ChunkSize + before.starts.lowerBound(at) * before.size;
}

FoldedHistory::Stretch FoldedHistory::stretch(LineTime from, LineTime to, LineTime end) const
{
    Stretch result;
    if (isEmpty() || from >= end || from >= to)
        return result;
    Place begin = firstBlock(from);
    if (begin > m_dropped * ChunkSize)
        begin -= blockSize(begin - 1); // it reaches up to that one, and may hold a sample of the same time
    const auto gap = std::ranges::lower_bound(m_gaps, from, {}, &Gap::after);
    if (gap != m_gaps.end() && gap->before < from) {
        begin = std::max(begin, gap->place - gap->place % blockSize(gap->place));
        if (gap->after >= to)
            return result;
        result.gapBefore = true;
    }
    result.extremes = extremes(begin, firstBlock(to));
    return result;
}

Extremes FoldedHistory::extremes(Place from, Place to) const
{
    Extremes result;
    while (from < to) {
        const Chunk &chunk = chunkOf(from);
        const std::size_t begin = from % ChunkSize;
        const auto count = static_cast<std::size_t>(std::min<Place>(to - from, ChunkSize - begin));
        if (count == ChunkSize || !chunk.blocks)
            result.include(chunk.all);
        else
            result.include(extremesOf(*chunk.blocks, begin, begin + count));
        from += count;
    }
    return result;
}

} // namespace dynascope
