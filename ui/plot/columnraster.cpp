// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/plot/columnraster.h"

#include <algorithm>
#include <cmath>

namespace dynascope {

namespace {

/// All four channels × factor / 256.
quint32 scaled(quint32 color, quint32 factor)
{
    const quint32 even = (((color & 0x00FF00FFU) * factor) >> 8) & 0x00FF00FFU;
    const quint32 odd = ((color >> 8) & 0x00FF00FFU) * factor & 0xFF00FF00U;
    return even | odd;
}

/// `coverage` of a premultiplied color laid over a pixel.
quint32 blended(quint32 color, quint32 pixel, float coverage)
{
    const quint32 source = scaled(color, static_cast<quint32>(static_cast<qint32>(coverage * 256.0F)));
    return source + scaled(pixel, 256 - (source >> 24));
}

} // namespace

void ColumnRaster::resize(int width, int height)
{
    if (width == m_width && height == m_height)
        return;
    m_width = std::max(width, 0);
    m_height = std::max(height, 0);
    m_pixels.assign(static_cast<std::size_t>(m_width) * static_cast<std::size_t>(m_height), 0);
    m_image = QImage(m_width, m_height, QImage::Format_ARGB32_Premultiplied);
    m_firstNew = 0;
}

void ColumnRaster::scroll(int columns, int firstNew)
{
    m_firstNew = std::clamp(firstNew, 0, m_width);
    std::fill(m_pixels.begin() + static_cast<std::ptrdiff_t>(m_firstNew) * m_height, m_pixels.end(), 0U);
    if (columns <= 0 || m_firstNew == 0)
        return;
    for (int y = 0; y < m_height; ++y) {
        auto *row = reinterpret_cast<quint32 *>(m_image.scanLine(y));
        std::copy(row + columns, row + columns + m_firstNew, row);
    }
}

void ColumnRaster::setColor(const QColor &color)
{
    m_color = qPremultiply(color.rgba());
    m_opaque = color.alpha() == 255;
}

void ColumnRaster::span(int x, float top, float bottom)
{
    top = std::max(top, 0.0F);
    bottom = std::min(bottom, static_cast<float>(m_height));
    if (!(top < bottom))
        return;
    quint32 *column = m_pixels.data() + static_cast<std::size_t>(x) * static_cast<std::size_t>(m_height);
    const int first = static_cast<int>(top);
    const int last = static_cast<int>(bottom); // the pixel after the last whole one
    const quint32 color = m_color;
    if (first == last) {
        column[first] = blended(color, column[first], bottom - top);
        return;
    }
    column[first] = blended(color, column[first], 1.0F - (top - static_cast<float>(first)));
    if (m_opaque) {
        std::fill(column + first + 1, column + last, color);
    } else {
        for (int y = first + 1; y < last; ++y)
            column[y] = blended(color, column[y], 1);
    }
    if (last < m_height)
        column[last] = blended(color, column[last], bottom - static_cast<float>(last));
}

void ColumnRaster::slope(int x, float from, float to, float thickness, Limits limits)
{
    const float low = std::min(from, to);
    const float high = std::max(from, to);
    const float rise = high - low;
    // How much of the column's width the line covers at each height: rises over `ramp`, stays, falls.
    const float half = thickness / 2 * std::sqrt(1.0F + rise * rise);
    if (rise < 1.0F / 64) {
        span(x, low - half, high + half);
        return;
    }
    const float ramp = std::max(rise, 1.0F);
    const float most = std::min(1.0F, 2 * half / ramp);
    const float begin = low - half - 0.5F;
    const float end = high + half + 0.5F;
    const float top = std::max({begin, limits.top, 0.0F});
    const float bottom = std::min({end, limits.bottom, static_cast<float>(m_height)});
    if (!(top < bottom))
        return;
    const int first = static_cast<int>(top);
    const int last = static_cast<int>(std::ceil(bottom));
    quint32 *column = m_pixels.data() + static_cast<std::size_t>(x) * static_cast<std::size_t>(m_height);
    const quint32 color = m_color;
    const float perPixel = 1 / ramp;
    for (int y = first; y < last; ++y) { // without a branch, so that several pixels go at once
        const auto above = static_cast<float>(y);
        const float inside = std::min(above + 1, bottom) - std::max(above, top);
        const float rising = (above + 0.5F - begin) * perPixel;
        const float falling = (end - above - 0.5F) * perPixel;
        const float coverage = std::max(0.0F, std::min(std::min(inside, most), std::min(rising, falling)));
        column[y] = blended(color, column[y], coverage);
    }
}

const QImage &ColumnRaster::image()
{
    // In tiles that fit the cache, or each pixel read would touch a line of its own.
    constexpr int Tile = 16;
    const auto height = static_cast<std::size_t>(m_height);
    auto *pixels = reinterpret_cast<quint32 *>(m_image.bits());
    const auto stride = static_cast<std::size_t>(m_image.bytesPerLine()) / sizeof(quint32);
    for (int top = 0; top < m_height; top += Tile) {
        const int bottom = std::min(top + Tile, m_height);
        for (int left = m_firstNew; left < m_width; left += Tile) {
            const int right = std::min(left + Tile, m_width);
            for (int y = top; y < bottom; ++y) {
                quint32 *to = pixels + static_cast<std::size_t>(y) * stride;
                const quint32 *from = m_pixels.data() + y;
                for (int x = left; x < right; ++x)
                    to[x] = from[static_cast<std::size_t>(x) * height];
            }
        }
    }
    return m_image;
}

} // namespace dynascope
