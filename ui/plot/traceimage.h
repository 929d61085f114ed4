// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/plot/axisscaler.h"
#include "ui/plot/columncache.h"
#include "ui/plot/columnraster.h"

namespace dynascope {

/// Draws traces into a picture the size of the plot area: spans from decimated columns where samples are dense, proper
/// lines where there are few.
class TraceImage
{
public:
    struct Item {
        const TraceData *trace = nullptr;
        const AxisRange *range = nullptr;
        float thickness = 1.5F; ///< in device pixels
        bool isOnTop = false;
        int pixelRatio = 1; ///< of its dashes
    };

    /// As wide as the view has columns. The first item lies on top. While a view moves on and nothing else changes,
    /// only the columns that new samples touch are painted; the rest is shifted.
    const QImage &paint(std::span<const Item> items, const TimeView &view, int height);

private:
    /// What an item looked like when it was painted last.
    struct Painted {
        const History *history = nullptr;
        HistoryMark mark;
        double scale = 0, offset = 0;
        QRgb color = 0;
        int dash = 0;
        bool isDrawn = false;
        bool isOnTop = false;
        bool asLines = false; ///< each sample for itself
        bool hasDots = false;
        float thickness = 0;
        AxisRange range;

        Painted(const Item &item, const TimeView &view, const Painted *before);
        bool looksAs(const Painted &other) const;
    };

    int firstToPaint(std::span<const Painted> now, const TimeView &view, int height) const;
    void paintItem(const Item &item, const Painted &how, ColumnCache &cache, const TimeView &view);
    void paintColumns(const Item &item, std::span<const History::Column> columns, std::int64_t firstColumn);
    void paintLines(const Item &item, const TimeView &view, std::size_t first, std::size_t last);
    void strokePath(const Item &item, const TimeView &view);
    void paintDots(const Item &item, const TimeView &view, std::size_t first, std::size_t last);

    /// The heights that a trace passes through inside a column.
    struct PathColumn {
        float low = 1;
        float high = 0; ///< below `low`: none
        int samples = 0;

        bool isEmpty() const { return high < low; }
        void include(float y);
    };

    ColumnRaster m_raster;
    std::vector<ColumnCache> m_caches;
    std::vector<PathColumn> m_path; ///< begins with the column before the first
    std::vector<Painted> m_painted;
    TimeView m_view; ///< as painted last
    int m_first = 0; ///< the first column that is painted this time
};

} // namespace dynascope
