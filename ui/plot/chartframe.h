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

/// Axes, grid and their labels, drawn by Qt Charts into a picture that is kept until one of them changes. The chart's
/// own series stay empty: the samples are painted over it.
class ChartFrame
{
public:
    struct ValueAxis {
        QString title; ///< the unit
        AxisRange range;
        bool isUsed = false;

        friend bool operator==(const ValueAxis &, const ValueAxis &) = default;
    };
    /// All that the picture depends on.
    struct Content {
        QSize size; ///< in device-independent pixels
        qreal pixelRatio = 1;
        QFont font;
        QPalette palette;
        double fromSeconds = -10; ///< of the time axis
        double toSeconds = 0;
        std::array<ValueAxis, 2> values; ///< left, right
        std::array<bool, 2> hasRoom{};   ///< for labels on that side, even where none are

        friend bool operator==(const Content &, const Content &) = default;
    };

    ChartFrame();
    ~ChartFrame();

    const QPixmap &pixmap(const Content &content);
    /// Inside the axes, on whole device pixels. Depends on size, font and where there is room for labels, not on
    /// ranges, so it doesn't jump while values do.
    static QRectF plotArea(const Content &content);

private:
    void applyColors(const Content &content);
    void applyRanges(const Content &content);

    Content m_content;
    QPixmap m_pixmap;
    std::unique_ptr<QGraphicsScene> m_scene;
    QChart *m_chart; ///< the scene's, as the axes and series are the chart's
    QValueAxis *m_time;
    std::array<QValueAxis *, 2> m_values{};
};

} // namespace dynascope
