// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/plot/traceimage.h"

#include "ui/plot/tracecolors.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace dynascope {

namespace {

constexpr double LineDensity = 2; ///< samples per column up to which each is drawn for itself
constexpr int Overlap = 8;        ///< columns into which a sample's dot or a line's edge reaches
constexpr double DotSpacing = 10; ///< pixels between samples from which on each gets a dot

/// Raw value → pixels from the upper edge.
struct Vertical {
    float factor;
    float offset;

    Vertical(const TraceImage::Item &item, int height)
    {
        const double perUnit = height / item.range->span();
        factor = static_cast<float>(-item.trace->scale * perUnit);
        offset = static_cast<float>((item.range->maximum - item.trace->offset) * perUnit);
    }
    float operator()(std::int32_t raw) const { return static_cast<float>(raw) * factor + offset; }
};

/// Do the samples of this column go one way, the way they came and go on? Then they are as good as a line.
bool isSlope(std::span<const History::Column> columns, int x)
{
    const auto at = static_cast<std::size_t>(x);
    if (at == 0 || at + 1 >= columns.size() || columns[at - 1].isEmpty || columns[at + 1].isEmpty)
        return false;
    const History::Column &column = columns[at];
    const std::int32_t from = columns[at - 1].last;
    const std::int32_t to = columns[at + 1].first;
    const bool rises = from <= column.first && column.first == column.minimum && column.last == column.maximum;
    const bool falls = from >= column.first && column.first == column.maximum && column.last == column.minimum;
    return (rises && column.last <= to) || (falls && column.last >= to);
}

/// A steep line's edge reaches into the columns beside it, yet not past its own end.
ColumnRaster::Limits limitsAround(
    std::span<const History::Column> columns, int x, const Vertical &vertical, ColumnRaster::Limits limits, float half)
{
    for (const int beside : {x - 1, x + 1}) {
        if (beside < 0 || beside >= static_cast<int>(columns.size())
            || columns[static_cast<std::size_t>(beside)].isEmpty)
            continue;
        const float one = vertical(columns[static_cast<std::size_t>(beside)].minimum);
        const float other = vertical(columns[static_cast<std::size_t>(beside)].maximum);
        limits = {std::min({limits.top, one, other}), std::max({limits.bottom, one, other})};
    }
    return {limits.top - half, limits.bottom + half};
}

QColor colorOf(const TraceData &trace)
{
    QColor color = trace.color;
    if (trace.dimmed)
        color.setAlphaF(0.35F);
    return color;
}

} // namespace

TraceImage::Painted::Painted(const Item &item, const TimeView &view, const Painted *before)
    : history(item.trace->history)
    , scale(item.trace->scale)
    , offset(item.trace->offset)
    , color(colorOf(*item.trace).rgba())
    , dash(item.trace->dash)
    , isDrawn(item.trace->isDrawn())
    , isOnTop(item.isOnTop)
    , thickness(item.thickness)
    , range(*item.range)
{
    if (!isDrawn)
        return;
    mark = HistoryMark::of(*history);
    // On the border between the two ways what was drawn stays: a change means to paint all anew.
    const auto samples = static_cast<double>(history->indexAt(view.shownTo()) - history->indexAt(view.from()));
    asLines = samples <= view.columns * (before && before->asLines ? 1.25 : 1.0) * LineDensity
        && !history->isFolded(view.from(), view.shownTo());
    hasDots = samples * (before && before->hasDots ? 0.8 : 1.0) * DotSpacing <= view.columns;
}

bool TraceImage::Painted::looksAs(const Painted &other) const
{
    return std::tie(history, scale, offset, color, dash, isDrawn, isOnTop, asLines, hasDots, thickness, range)
        == std::tie(other.history, other.scale, other.offset, other.color, other.dash, other.isDrawn, other.isOnTop, other.asLines,
            other.hasDots, other.thickness, other.range);
}

/// The column from which on the picture differs from the last one, moved; 0: anywhere.
int TraceImage::firstToPaint(std::span<const Painted> now, const TimeView &view, int height) const
{
    const std::int64_t moved = view.firstColumn - m_view.firstColumn;
    if (view.step != m_view.step || view.columns != m_view.columns || view.until != m_view.until
        || height != m_raster.height() || moved < 0 || moved >= view.columns || now.size() != m_painted.size())
        return 0;
    double first = static_cast<double>(view.columns - moved);
    for (std::size_t i = 0; i < now.size(); ++i) {
        const HistoryMark &before = m_painted[i].mark;
        if (!now[i].looksAs(m_painted[i]) || (now[i].isDrawn && !before.stillHolds(*now[i].history)))
            return 0;
        if (now[i].isDrawn && now[i].mark.appended != before.appended)
            first = std::min(first, view.column(before.last.at)); // from there a line goes to what is new
    }
    return std::max(0, static_cast<int>(first) - Overlap);
}

const QImage &TraceImage::paint(std::span<const Item> items, const TimeView &view, int height)
{
    std::vector<Painted> now;
    now.reserve(items.size());
    for (const Item &item : items)
        now.emplace_back(item, view, now.size() < m_painted.size() ? &m_painted[now.size()] : nullptr);
    m_first = firstToPaint(now, view, height);
    m_raster.resize(view.columns, height);
    m_raster.scroll(
        static_cast<int>(std::clamp<std::int64_t>(view.firstColumn - m_view.firstColumn, 0, view.columns)), m_first);
    m_painted = std::move(now);
    m_view = view;
    m_caches.resize(items.size());
    for (const bool onTop : {false, true}) {
        for (std::size_t i = items.size(); i-- > 0;) {
            if (items[i].trace->isDrawn() && items[i].isOnTop == onTop)
                paintItem(items[i], m_painted[i], m_caches[i], view);
        }
    }
    return m_raster.image();
}

void TraceImage::paintItem(const Item &item, const Painted &how, ColumnCache &cache, const TimeView &view)
{
    m_raster.setColor(colorOf(*item.trace));
    const History &history = *item.trace->history;
    if (!how.asLines) {
        paintColumns(item, cache.columns(history, view), view.firstColumn);
        return;
    }
    const LineTime from = view.step * (view.firstColumn + std::max(m_first - Overlap, 0));
    const std::size_t first = history.indexAt(from);
    const std::size_t last = history.indexAt(view.shownTo());
    paintLines(item, view, first, last);
    if (how.hasDots)
        paintDots(item, view, first, last);
}

void TraceImage::paintColumns(
    const Item &item, std::span<const History::Column> columns, std::int64_t firstColumn)
{
    const auto hasInk = [dash = item.trace->dash, ratio = item.pixelRatio, firstColumn](
                            int x) { return traceInk(dash, firstColumn + x, ratio); };
    const Vertical vertical(item, m_raster.height());
    const float half = item.thickness / 2;
    int beforeAt = m_first - 1;
    while (beforeAt >= 0 && columns[static_cast<std::size_t>(beforeAt)].isEmpty)
        --beforeAt;
    const History::Column *before = beforeAt < 0 ? nullptr : &columns[static_cast<std::size_t>(beforeAt)];
    for (int x = m_first; x < static_cast<int>(columns.size()); ++x) {
        const History::Column &column = columns[static_cast<std::size_t>(x)];
        if (column.isEmpty)
            continue;
        float top = vertical(column.minimum);
        float bottom = vertical(column.maximum);
        if (top > bottom)
            std::swap(top, bottom);
        if (before && !column.gapBefore) {
            const float from = vertical(before->last);
            const float to = vertical(column.first);
            const auto distance = static_cast<float>(x - beforeAt);
            for (int between = std::max(beforeAt + 1, m_first); between < x; ++between) {
                if (!hasInk(between))
                    continue;
                const auto part = static_cast<float>(between - beforeAt);
                m_raster.slope(between, from + (to - from) * (part - 0.5F) / distance,
                    from + (to - from) * (part + 0.5F) / distance, item.thickness,
                    {std::min(from, to) - half, std::max(from, to) + half});
            }
            // Meets the neighbour half-way, so that both share a jump.
            const float meeting = beforeAt == x - 1 ? from : from + (to - from) * (distance - 0.5F) / distance;
            top = std::min(top, meeting);
            bottom = std::max(bottom, meeting);
        }
        if (hasInk(x) && isSlope(columns, x))
            m_raster.slope(x, top, bottom, item.thickness, limitsAround(columns, x, vertical, {top, bottom}, half));
        else if (hasInk(x))
            m_raster.span(x, top - half, bottom + half);
        before = &column;
        beforeAt = x;
    }
}

void TraceImage::PathColumn::include(float y)
{
    const bool isFirst = isEmpty();
    low = isFirst ? y : std::min(low, y);
    high = isFirst ? y : std::max(high, y);
}

/// The way through samples first - 1 ... last.
void TraceImage::paintLines(const Item &item, const TimeView &view, std::size_t first, std::size_t last)
{
    const History &history = *item.trace->history;
    const Vertical vertical(item, m_raster.height());
    m_path.assign(static_cast<std::size_t>(view.columns) + 2, {});
    const auto visit = [this](int column, float y, bool isSample) {
        if (column < -1 || column + 1 >= static_cast<int>(m_path.size()))
            return;
        PathColumn &path = m_path[static_cast<std::size_t>(column) + 1];
        path.include(y);
        path.samples += isSample ? 1 : 0;
    };
    const std::size_t begin = first > 0 ? first - 1 : first;
    const std::size_t end = last < history.size() && history.at(last).at <= view.until ? last + 1 : last;
    double fromX = 0;
    float fromY = 0;
    for (std::size_t i = begin; i < end; ++i) {
        const History::Sample sample = history.at(i);
        const double x = view.column(sample.at);
        const float y = vertical(sample.raw);
        if (i > begin && !history.gapBefore(i)) {
            const double steepness = x > fromX ? static_cast<double>(y - fromY) / (x - fromX) : 0;
            const double stop = std::min(x, view.columns + 1.0);
            for (int border = static_cast<int>(std::max(std::floor(fromX) + 1, -1.0)); border <= stop; ++border) {
                const auto at = static_cast<float>(fromY + steepness * (border - fromX));
                visit(border - 1, at, false);
                visit(border, at, false);
            }
        }
        visit(static_cast<int>(std::clamp(std::floor(x), -2.0, view.columns + 1.0)), y, true);
        fromX = x;
        fromY = y;
    }
    strokePath(item, view);
}

void TraceImage::strokePath(const Item &item, const TimeView &view)
{
    const float thickness = item.thickness;
    const float half = thickness / 2;
    for (auto i = static_cast<std::size_t>(m_first) + 1; i + 1 < m_path.size(); ++i) {
        const PathColumn &path = m_path[i];
        if (path.isEmpty())
            continue;
        const int column = static_cast<int>(i) - 1;
        if (!traceInk(item.trace->dash, view.firstColumn + column, item.pixelRatio))
            continue;
        if (path.samples > 1) { // may go up and down
            m_raster.span(column, path.low - half, path.high + half);
            continue;
        }
        // As in limitsAround().
        float low = path.low;
        float high = path.high;
        for (const std::size_t beside : {i - 1, i + 1}) {
            if (m_path[beside].isEmpty())
                continue;
            low = std::min(low, m_path[beside].low);
            high = std::max(high, m_path[beside].high);
        }
        m_raster.slope(column, path.low, path.high, thickness, {low - half, high + half});
    }
}

void TraceImage::paintDots(const Item &item, const TimeView &view, std::size_t first, std::size_t last)
{
    const History &history = *item.trace->history;
    const Vertical vertical(item, m_raster.height());
    const float radius = item.thickness * 1.6F;
    for (std::size_t i = first; i < last; ++i) {
        const History::Sample sample = history.at(i);
        const auto x = static_cast<float>(view.column(sample.at));
        const float y = vertical(sample.raw);
        for (int column = std::max(m_first, static_cast<int>(x - radius));
             column < std::min(view.columns, static_cast<int>(x + radius) + 1); ++column) {
            const float aside = static_cast<float>(column) + 0.5F - x;
            const float half = std::sqrt(std::max(0.0F, radius * radius - aside * aside));
            m_raster.span(column, y - half, y + half);
        }
    }
}

} // namespace dynascope
