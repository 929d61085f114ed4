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
    };

    /// As wide as the view has columns. The first item lies on top. Items keep what they computed by their position.
    const QImage &paint(std::span<const Item> items, const TimeView &view, int height);

private:
    void paintItem(const Item &item, ColumnCache &cache, const TimeView &view);
    void paintColumns(const Item &item, std::span<const History::Column> columns);
    void paintLines(const Item &item, const TimeView &view, std::size_t first, std::size_t last);
    void strokePath(float thickness);
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
    std::vector<PathColumn> m_path;
};

} // namespace dynascope
