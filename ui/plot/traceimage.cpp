// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/plot/traceimage.h"

#include <algorithm>
#include <cmath>

namespace dynascope {

namespace {

constexpr std::size_t LineDensity = 2; ///< samples per column up to which each is drawn for itself
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

QColor colorOf(const TraceData &trace)
{
    QColor color = trace.color;
    if (trace.dimmed)
        color.setAlphaF(0.35F);
    return color;
}

} // namespace

const QImage &TraceImage::paint(std::span<const Item> items, const TimeView &view, int height)
{
    m_raster.resize(view.columns, height);
    m_raster.clear();
    m_caches.resize(items.size());
    for (const bool onTop : {false, true}) {
        for (std::size_t i = items.size(); i-- > 0;) {
            if (items[i].trace->isDrawn() && items[i].isOnTop == onTop)
                paintItem(items[i], m_caches[i], view);
        }
    }
    return m_raster.image();
}

void TraceImage::paintItem(const Item &item, ColumnCache &cache, const TimeView &view)
{
    m_raster.setColor(colorOf(*item.trace));
    const History &history = *item.trace->history;
    const std::size_t first = history.indexAt(view.from());
    const std::size_t last = history.indexAt(view.shownTo());
    if (last - first <= static_cast<std::size_t>(view.columns) * LineDensity)
        paintLines(item, view, first, last);
    else
        paintColumns(item, cache.columns(history, view));
}

void TraceImage::paintColumns(const Item &item, std::span<const History::Column> columns)
{
    const Vertical vertical(item, m_raster.height());
    const float half = item.thickness / 2;
    const History::Column *before = nullptr;
    int beforeAt = 0;
    for (int x = 0; x < static_cast<int>(columns.size()); ++x) {
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
            for (int between = beforeAt + 1; between < x; ++between) {
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
    m_path.assign(static_cast<std::size_t>(view.columns), {});
    const auto visit = [this](int column, float y, bool isSample) {
        if (column < 0 || column >= static_cast<int>(m_path.size()))
            return;
        PathColumn &path = m_path[static_cast<std::size_t>(column)];
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
            const double stop = std::min(x, static_cast<double>(view.columns));
            for (int border = static_cast<int>(std::max(std::floor(fromX) + 1, 0.0)); border <= stop; ++border) {
                const auto at = static_cast<float>(fromY + steepness * (border - fromX));
                visit(border - 1, at, false);
                visit(border, at, false);
            }
        }
        if (x >= 0)
            visit(static_cast<int>(std::min(x, static_cast<double>(view.columns))), y, true);
        fromX = x;
        fromY = y;
    }
    strokePath(item.thickness);
    paintDots(item, view, first, last);
}

void TraceImage::strokePath(float thickness)
{
    const float half = thickness / 2;
    for (std::size_t i = 0; i < m_path.size(); ++i) {
        const PathColumn &path = m_path[i];
        if (path.isEmpty())
            continue;
        if (path.samples > 1) { // may go up and down
            m_raster.span(static_cast<int>(i), path.low - half, path.high + half);
            continue;
        }
        // A steep line's edge reaches into the columns beside it, yet not past its own end.
        float low = path.low;
        float high = path.high;
        for (const std::size_t beside : {i - 1, i + 1}) {
            if (beside >= m_path.size() || m_path[beside].isEmpty())
                continue;
            low = std::min(low, m_path[beside].low);
            high = std::max(high, m_path[beside].high);
        }
        m_raster.slope(static_cast<int>(i), path.low, path.high, thickness, {low - half, high + half});
    }
}

void TraceImage::paintDots(const Item &item, const TimeView &view, std::size_t first, std::size_t last)
{
    const History &history = *item.trace->history;
    const Vertical vertical(item, m_raster.height());
    if (last <= first || view.columns < static_cast<double>(last - first) * DotSpacing)
        return;
    const float radius = item.thickness * 1.6F;
    for (std::size_t i = first; i < last; ++i) {
        const History::Sample sample = history.at(i);
        const auto x = static_cast<float>(view.column(sample.at));
        const float y = vertical(sample.raw);
        for (int column = std::max(0, static_cast<int>(x - radius));
             column < std::min(view.columns, static_cast<int>(x + radius) + 1); ++column) {
            const float aside = static_cast<float>(column) + 0.5F - x;
            const float half = std::sqrt(std::max(0.0F, radius * radius - aside * aside));
            m_raster.span(column, y - half, y + half);
        }
    }
}

} // namespace dynascope
