// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QColor>
#include <QImage>

#include <vector>

namespace dynascope {

/// A picture that is painted in vertical spans, with soft ends. Pixels of a column lie side by side in memory, so a
/// span is one fill; image() turns what is new on its side.
class ColumnRaster
{
public:
    void resize(int width, int height);
    /// Keeps what was painted, moved to the left, but for the columns from `firstNew` on, which are empty.
    void scroll(int columns, int firstNew);
    int width() const { return m_width; }
    int height() const { return m_height; }

    void setColor(const QColor &color); ///< alpha counts
    /// Everything between top and bottom, in pixels from the upper edge; beyond the edges is cut off.
    void span(int x, float top, float bottom);
    /// A line of this thickness that crosses the column between the heights `from` and `to`; nothing beyond `limits`.
    struct Limits {
        float top;
        float bottom;
    };
    void slope(int x, float from, float to, float thickness, Limits limits);

    /// Premultiplied, transparent where nothing was painted; valid until the next call.
    const QImage &image();

private:
    int m_width = 0;
    int m_height = 0;
    std::vector<quint32> m_pixels; ///< column by column
    QImage m_image;
    int m_firstNew = 0;  ///< columns before it are in m_image alone
    quint32 m_color = 0; ///< premultiplied
    bool m_opaque = true;
};

} // namespace dynascope
