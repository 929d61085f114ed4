// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/health/ratebar.h"

#include "ui/common/flatcontrols.h"
#include "ui/common/theme.h"

#include <QPainter>

#include <algorithm>

namespace dynascope {

namespace {

constexpr int Thickness = 6;

} // namespace

RateBar::RateBar(int width, QWidget *parent)
    : QWidget(parent)
{
    setFixedSize(width, 2 * Thickness);
}

void RateBar::setShare(double share, bool isLargest)
{
    m_share = std::clamp(share, 0.0, 1.0);
    m_isLargest = isLargest;
    update();
}

void RateBar::paintEvent(QPaintEvent *)
{
    const ThemeColors &theme = colors(palette());
    QPainter painter(this);
    QRect rect(0, (height() - Thickness) / 2, width(), Thickness);
    painter.fillRect(rect, theme.grid);
    rect.setWidth(std::max(m_share > 0 ? 1 : 0, qRound(m_share * width())));
    painter.fillRect(rect, m_isLargest ? theme.accent : theme.dimmed);
}

} // namespace dynascope
