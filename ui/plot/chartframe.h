// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/plot/axisscaler.h"

#include <QFont>
#include <QPalette>
#include <QPixmap>

#include <array>
#include <memory>

class QAbstractAxis;
class QChart;
class QGraphicsScene;
class QLineSeries;
class QValueAxis;

namespace dynascope {

/// How many columns of value labels there is room for.
struct LabelColumns {
    int left = 0;
    int right = 0;

    LabelColumns unitedWith(const LabelColumns &other) const
    {
        return {left > other.left ? left : other.left, right > other.right ? right : other.right};
    }
    friend bool operator==(const LabelColumns &, const LabelColumns &) = default;
};

/// Axes and grid, drawn by Qt Charts into a picture that is kept until one of them changes. Their labels are written by
/// us: with the window's minus sign, and for more axes than Charts lays out beside a fixed plot area. The chart's own
/// series stay empty: the samples are painted over it.
class ChartFrame
{
public:
    struct ValueAxis {
        QString title; ///< the unit
        AxisRange range;
        bool isUsed = false;

        friend bool operator==(const ValueAxis &, const ValueAxis &) = default;
    };
    static constexpr int MostAxes = 4;
    /// All that the picture depends on.
    struct Content {
        QSize size; ///< in device-independent pixels
        qreal pixelRatio = 1;
        QFont font;
        QPalette palette;
        double fromSeconds = -10; ///< of the time axis
        double toSeconds = 0;
        std::array<ValueAxis, MostAxes> values; ///< the first at the left, the others at the right
        LabelColumns room;                      ///< for labels, even where none are

        friend bool operator==(const Content &, const Content &) = default;
    };

    ChartFrame();
    ~ChartFrame();

    const QPixmap &pixmap(const Content &content);
    void paint(QPainter &painter, const Content &content); ///< the same, straight
    /// Inside the axes, on whole device pixels. Depends on size, font and where there is room for labels, not on
    /// ranges, so it doesn't jump while values do.
    static QRectF plotArea(const Content &content);
    static qreal columnWidth(const QFont &font); ///< of the labels of one value axis

private:
    void draw(QPainter &painter, const Content &content);
    void applyColors(const Content &content);
    void applyRanges(const Content &content, double seconds);
    static void paintTimes(QPainter &painter, const Content &content, double step);
    static void paintValues(QPainter &painter, const Content &content, int axis);

    Content m_content;
    QPixmap m_pixmap;
    bool m_isColored = false;
    QRectF m_area; ///< as laid out last
    std::unique_ptr<QGraphicsScene> m_scene;
    QChart *m_chart; ///< the scene's, as the axes and series are the chart's
    QValueAxis *m_time;
    std::array<QValueAxis *, 2> m_values{};
};

} // namespace dynascope
