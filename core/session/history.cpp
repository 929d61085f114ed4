// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/history.h"

#include <algorithm>

namespace dynascope {

namespace {

/// The start of column `index` where `count` columns share [from, to), without overflow at any length.
LineTime columnStart(LineTime from, LineTime to, std::size_t index, std::size_t count)
{
    const auto width = (to - from).count();
    const auto columns = static_cast<std::int64_t>(count);
    const auto i = static_cast<std::int64_t>(index);
    return from + LineTime(width / columns * i + width % columns * i / columns);
}

} // namespace

/// Of the samples [from, to) of this chunk, at least one: what lies before and after whole blocks, finer at both ends.
History::Extremes History::Chunk::extremes(std::size_t from, std::size_t to) const
{
    if (from == 0 && to == ChunkSize)
        return all;
    Extremes result{raw[from], raw[from]};
    const auto samples = [this, &result](std::size_t begin, std::size_t end) {
        for (; begin < end; ++begin)
            result.include({raw[begin], raw[begin]});
    };
    const auto blocks = [&result](const auto &of, std::size_t begin, std::size_t end) {
        for (; begin < end; ++begin)
            result.include(of[begin]);
    };
    const std::size_t fineBegin = (from + FineSize - 1) / FineSize;
    const std::size_t fineEnd = to / FineSize;
    if (fineBegin >= fineEnd) {
        samples(from, to);
        return result;
    }
    samples(from, fineBegin * FineSize);
    samples(fineEnd * FineSize, to);
    const std::size_t coarseBegin = (fineBegin + Fan - 1) / Fan;
    const std::size_t coarseEnd = fineEnd / Fan;
    if (coarseBegin >= coarseEnd) {
        blocks(fine, fineBegin, fineEnd);
        return result;
    }
    blocks(fine, fineBegin, coarseBegin * Fan);
    blocks(fine, coarseEnd * Fan, fineEnd);
    blocks(coarse, coarseBegin, coarseEnd);
    return result;
}

History::History(std::size_t capacity) : m_capacity(std::max<std::size_t>(capacity, 1)) { }

void History::addChunk()
{
    if (m_spare) {
        m_spare->gaps.reset();
        m_chunks.push_back(std::move(m_spare));
    } else {
        m_chunks.push_back(std::make_unique_for_overwrite<Chunk>());
    }
}

void History::append(LineTime at, std::int32_t raw)
{
    if (!isEmpty() && at < timeOf(m_end - 1))
        return;
    const std::size_t slot = m_end % ChunkSize;
    if (slot == 0)
        addChunk();
    Chunk &chunk = *m_chunks.back();
    chunk.at[slot] = at;
    chunk.raw[slot] = raw;
    if (m_gapPending)
        chunk.gaps.set(slot);
    m_gapPending = false;

    const auto put = [slot, raw](Extremes &block, std::size_t blockSize) {
        if (slot % blockSize == 0)
            block = {raw, raw};
        else
            block.include({raw, raw});
    };
    put(chunk.fine[slot / FineSize], FineSize);
    put(chunk.coarse[slot / CoarseSize], CoarseSize);
    put(chunk.all, ChunkSize);
    ++m_end;

    if (size() <= m_capacity)
        return;
    ++m_begin;
    if (m_begin % ChunkSize == 0) {
        m_spare = std::move(m_chunks.front());
        m_chunks.pop_front();
        ++m_firstChunk;
    }
}

void History::appendGap(LineTime)
{
    m_gapPending = !isEmpty();
}

History::Sample History::at(std::size_t index) const
{
    const Position position = m_begin + index;
    return {timeOf(position), rawOf(position)};
}

bool History::gapBefore(std::size_t index) const
{
    return hasGap(m_begin + index);
}

std::size_t History::indexAt(LineTime at) const
{
    return static_cast<std::size_t>(find(at) - m_begin);
}

History::Position History::find(LineTime at) const
{
    return findNear(at, m_begin, m_begin + size() / 2);
}

/// The first position from `from` on whose time isn't before `at`. Few steps where it lies near `guess`.
History::Position History::findNear(LineTime at, Position from, Position guess) const
{
    Position low = from;   // all before are earlier than `at`
    Position high = m_end; // none from here on is
    guess = std::clamp(guess, low, high);
    if (guess < high && timeOf(guess) < at) {
        low = guess + 1;
        for (Position step = 1; low + step < high; step *= 2) {
            if (timeOf(low + step - 1) >= at) {
                high = low + step - 1;
                break;
            }
            low += step;
        }
    } else {
        high = guess;
        for (Position step = 1; low + step <= high; step *= 2) {
            if (timeOf(high - step) < at) {
                low = high - step + 1;
                break;
            }
            high -= step;
        }
    }
    while (low < high) {
        const Position middle = low + (high - low) / 2;
        if (timeOf(middle) < at)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

/// Of [from, to), at least one sample. Whole chunks have one entry each: n / 4096 steps at most for disjoint stretches.
History::Extremes History::extremes(Position from, Position to) const
{
    Extremes result{rawOf(from), rawOf(from)};
    while (from < to) {
        const std::size_t begin = from % ChunkSize;
        const auto count = static_cast<std::size_t>(std::min<Position>(to - from, ChunkSize - begin));
        result.include(chunkOf(from).extremes(begin, begin + count));
        from += count;
    }
    return result;
}

void History::columns(LineTime from, LineTime to, std::span<Column> columns) const
{
    std::ranges::fill(columns, Column{});
    if (columns.empty() || isEmpty() || to <= from)
        return;
    Position begin = find(from);
    Position count = 0; // samples arrive evenly: the next column holds about as many as this one
    for (std::size_t i = 0; i < columns.size() && begin < m_end; ++i) {
        const Position end = findNear(columnStart(from, to, i + 1, columns.size()), begin, begin + count);
        count = end - begin;
        if (count == 0)
            continue;
        const Extremes found = extremes(begin, end);
        columns[i] = {found.minimum, found.maximum, rawOf(begin), rawOf(end - 1), false, hasGap(begin)};
        begin = end;
    }
}

bool History::range(LineTime from, LineTime to, std::int32_t &minimum, std::int32_t &maximum) const
{
    if (isEmpty() || to <= from)
        return false;
    Position begin = find(from);
    Position end = find(to);
    if (end > m_begin && end < m_end && !hasGap(end))
        ++end;
    if (begin > m_begin && begin < m_end && !hasGap(begin))
        --begin;
    if (begin >= end)
        return false;
    const Extremes found = extremes(begin, end);
    minimum = found.minimum;
    maximum = found.maximum;
    return true;
}

} // namespace dynascope
