// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/history.h"

#include <algorithm>

namespace dynascope {

namespace {

/// Of a history with its node in a map, and of three deques that are nearly empty.
constexpr std::size_t FixedBytes = sizeof(History) + 3 * (512 + 64) + 12 * HistoryMemory::Overhead;

/// The start of column `index` where `count` columns share [from, to), without overflow at any length.
LineTime columnStart(LineTime from, LineTime to, std::size_t index, std::size_t count)
{
    const auto width = (to - from).count();
    const auto columns = static_cast<std::int64_t>(count);
    const auto i = static_cast<std::int64_t>(index);
    return from + LineTime(width / columns * i + width % columns * i / columns);
}

} // namespace

/// Reads by position, and remembers which chunk it was in: most reads go near the one before.
class History::Reader
{
public:
    explicit Reader(const History &history) : m_history(history) { }

    LineTime time(Position position)
    {
        if (position >= m_history.m_openBegin)
            return m_history.m_open->at[position - m_history.m_openBegin];
        const std::size_t slot = seek(position);
        return m_chunk->at(slot);
    }
    std::int32_t raw(Position position)
    {
        if (position >= m_history.m_openBegin)
            return m_history.m_open->raw[position - m_history.m_openBegin];
        const std::size_t slot = seek(position);
        return m_chunk->raw(slot);
    }
    bool hasGap(Position position)
    {
        if (position >= m_history.m_openBegin)
            return m_history.m_open->gaps[position - m_history.m_openBegin];
        const std::size_t slot = seek(position);
        return m_chunk->hasGap(slot);
    }
    Extremes extremes(Position from, Position to);
    Position findNear(LineTime at, Position from, Position guess);

private:
    std::size_t seek(Position position)
    {
        const Position chunk = (position - m_history.m_packedBegin) / ChunkSize;
        if (chunk != m_index) {
            m_index = chunk;
            m_chunk = &m_history.m_packed[static_cast<std::size_t>(chunk)];
        }
        return position % ChunkSize;
    }

    const History &m_history;
    const PackedChunk *m_chunk = nullptr;
    Position m_index = std::numeric_limits<Position>::max();
};

/// Of [from, to), at least one sample.
Extremes History::Reader::extremes(Position from, Position to)
{
    Extremes result;
    while (from < to) {
        const std::size_t begin = from % ChunkSize;
        if (begin == 0 && to - from >= ChunkSize && from < m_history.m_openBegin) {
            const Position whole = std::min(to, m_history.m_openBegin) / ChunkSize - from / ChunkSize;
            const auto first = static_cast<std::size_t>((from - m_history.m_packedBegin) / ChunkSize);
            for (const Extremes &each : std::span(m_history.m_whole).subspan(first, static_cast<std::size_t>(whole)))
                result.include(each);
            from += whole * ChunkSize;
            continue;
        }
        const auto count = static_cast<std::size_t>(std::min<Position>(to - from, ChunkSize - begin));
        if (from >= m_history.m_openBegin) {
            result.include(m_history.m_open->extremes(begin, begin + count));
        } else {
            seek(from);
            result.include(m_chunk->extremes(begin, begin + count));
        }
        from += count;
    }
    return result;
}

/// The first position from `from` on whose time isn't before `at`. Few steps where it lies near `guess`.
History::Position History::Reader::findNear(LineTime at, Position from, Position guess)
{
    Position low = from;             // all before are earlier than `at`
    Position high = m_history.m_end; // none from here on is
    guess = std::clamp(guess, low, high);
    if (guess < high && time(guess) < at) {
        low = guess + 1;
        for (Position step = 1; low + step < high; step *= 2) {
            if (time(low + step - 1) >= at) {
                high = low + step - 1;
                break;
            }
            low += step;
        }
    } else {
        high = guess;
        for (Position step = 1; low + step <= high; step *= 2) {
            if (time(high - step) < at) {
                low = high - step + 1;
                break;
            }
            high -= step;
        }
    }
    while (low < high) {
        const Position middle = low + (high - low) / 2;
        if (time(middle) < at)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

History::History(std::size_t capacity) : m_capacity(std::max<std::size_t>(capacity, 1)) { }

History::History(HistoryMemory &memory, std::size_t slot)
    : m_capacity(std::numeric_limits<std::size_t>::max())
    , m_memory(&memory)
    , m_origin(slot % ChunkSize)
    , m_begin(m_origin)
    , m_end(m_origin)
{
}

void History::append(LineTime at, std::int32_t raw)
{
    if (!isEmpty() && at < m_open->at[m_end - 1 - m_openBegin])
        return;
    if (!m_open || m_end - m_openBegin == ChunkSize)
        openChunk();
    const std::size_t slot = m_end % ChunkSize;
    if (m_open->makeRoom(slot))
        m_openCharge = MemoryCharge(m_memory, Detail::Samples, m_open->bytes() + FixedBytes);
    for (std::size_t before = 0; isEmpty() && before < slot; ++before) // no block is without values
        m_open->put(before, at, raw, false);
    m_open->put(slot, at, raw, m_gapPending);
    m_gapPending = false;
    ++m_end;
    if (size() > m_capacity)
        dropOldest();
}

/// What was open is packed.
void History::openChunk()
{
    if (!m_open) {
        m_open = std::make_unique<OpenChunk>();
        return;
    }
    m_packed.emplace_back(*m_open, m_memory);
    m_whole.push_back(m_packed.back().all());
    m_open->giveRoomBack();
    m_openBegin += ChunkSize;
}

void History::dropOldest()
{
    ++m_begin;
    if (m_packed.empty() || m_begin - m_packedBegin < ChunkSize)
        return;
    forgetOldestChunk();
}

void History::forgetOldestChunk()
{
    m_packed.pop_front();
    m_whole.erase(m_whole.begin());
    m_packedBegin += ChunkSize;
}

void History::appendGap(LineTime)
{
    m_gapPending = !isEmpty();
}

History::Sample History::at(std::size_t index) const
{
    Reader reader(*this);
    return {reader.time(m_begin + index), reader.raw(m_begin + index)};
}

bool History::gapBefore(std::size_t index) const
{
    return Reader(*this).hasGap(m_begin + index);
}

std::size_t History::indexAt(LineTime at) const
{
    return static_cast<std::size_t>(find(at) - m_begin);
}

/// Samples arrive evenly, so it can be guessed.
History::Position History::find(LineTime at) const
{
    if (isEmpty())
        return m_end;
    Reader reader(*this);
    const LineTime first = reader.time(m_begin);
    const LineTime last = reader.time(m_end - 1);
    if (at <= first || at > last)
        return at <= first ? m_begin : m_end;
    using Seconds = std::chrono::duration<double>;
    const double part = (Seconds(at) - Seconds(first)) / (Seconds(last) - Seconds(first));
    return reader.findNear(at, m_begin, m_begin + static_cast<Position>(part * static_cast<double>(size() - 1)));
}

std::size_t History::slotFor(LineTime at) const
{
    const bool isThere = !isEmpty() && m_open->at[m_end - 1 - m_openBegin] == at;
    return (isThere ? m_end - 1 : m_end) % ChunkSize;
}

std::optional<LineTime> History::oldest(Detail detail) const
{
    if (detail != Detail::Samples)
        return m_folded.oldest(detail);
    return m_packed.empty() ? std::nullopt : std::optional(m_packed.front().at(0));
}

void History::foldOldest(Detail detail)
{
    if (detail != Detail::Samples)
        return m_folded.foldOldest(detail, m_memory);
    if (m_packed.empty())
        return;
    m_folded.add(std::move(m_packed.front()), m_memory);
    forgetOldestChunk();
    m_begin = m_packedBegin;
}

bool History::isFolded(LineTime from, LineTime to) const
{
    return !m_folded.isEmpty() && to > m_folded.first() && from < foldedEnd();
}

/// Up to where a line from the last folded sample goes.
LineTime History::foldedEnd() const
{
    Reader reader(*this);
    return reader.hasGap(m_begin) ? m_folded.last() + LineTime(1) : reader.time(m_begin);
}

void History::foldedColumns(LineTime from, LineTime to, std::span<Column> columns) const
{
    if (!isFolded(from, to))
        return;
    const LineTime end = foldedEnd();
    const Column *before = nullptr;
    LineTime start = from;
    for (std::size_t i = 0; i < columns.size() && start < end; ++i) {
        const LineTime stop = columnStart(from, to, i + 1, columns.size());
        const auto [extremes, gapBefore] = m_folded.stretch(start, stop, end);
        start = stop;
        if (extremes.isEmpty())
            continue;
        const std::int32_t value = before ? std::clamp(before->last, extremes.minimum, extremes.maximum)
                                          : extremes.minimum + static_cast<std::int32_t>(extremes.span() / 2);
        columns[i] = {extremes.minimum, extremes.maximum, value, value, false, gapBefore};
        before = &columns[i];
    }
}

void History::columns(LineTime from, LineTime to, std::span<Column> columns) const
{
    std::ranges::fill(columns, Column{});
    if (columns.empty() || isEmpty() || to <= from)
        return;
    foldedColumns(from, to, columns);
    Reader reader(*this);
    Position begin = find(from);
    Position count = 0; // samples arrive evenly: the next column holds about as many as this one
    for (std::size_t i = 0; i < columns.size() && begin < m_end; ++i) {
        const Position end = reader.findNear(columnStart(from, to, i + 1, columns.size()), begin, begin + count);
        count = end - begin;
        if (count == 0)
            continue;
        Extremes found = reader.extremes(begin, end);
        Column &column = columns[i];
        const std::int32_t last = reader.raw(end - 1);
        if (column.isEmpty) {
            column = {found.minimum, found.maximum, reader.raw(begin), last, false, reader.hasGap(begin)};
        } else { // begins with what was folded
            found.include({column.minimum, column.maximum});
            column = {found.minimum, found.maximum, column.first, last, false, column.gapBefore};
        }
        begin = end;
    }
}

bool History::range(LineTime from, LineTime to, std::int32_t &minimum, std::int32_t &maximum) const
{
    if (isEmpty() || to <= from)
        return false;
    Extremes found;
    if (isFolded(from, to))
        found = m_folded.stretch(from, to, foldedEnd()).extremes;
    Reader reader(*this);
    Position begin = find(from);
    Position end = find(to);
    if (end > m_begin && end < m_end && !reader.hasGap(end))
        ++end;
    if (begin > m_begin && begin < m_end && !reader.hasGap(begin))
        --begin;
    found.include(reader.extremes(begin, end));
    if (found.isEmpty())
        return false;
    minimum = found.minimum;
    maximum = found.maximum;
    return true;
}

} // namespace dynascope
