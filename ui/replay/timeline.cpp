// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/replay/timeline.h"

#include "ui/common/theme.h"

#include <QMouseEvent>
#include <QPainter>

#include <algorithm>
#include <cmath>

namespace dynascope {
namespace {

constexpr qreal Knob = 7;      ///< its radius
constexpr qreal Thickness = 4; ///< of the groove
constexpr int Second = 1000;

} // namespace

Timeline::Timeline(QWidget *parent) : QAbstractSlider(parent)
{
    setObjectName(QStringLiteral("timeline"));
    setAccessibleName(tr("Position in the recording"));
    setFocusPolicy(Qt::StrongFocus);
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    setSingleStep(Second);
    setPageStep(10 * Second);
    setCursor(Qt::PointingHandCursor);
}

void Timeline::setLength(int milliseconds)
{
    setRange(0, std::max(0, milliseconds));
    update();
}

void Timeline::setMarks(std::vector<int> at)
{
    m_marks = std::move(at);
    update();
}

void Timeline::setLoaded(int percent)
{
    if (m_percent == percent)
        return;
    m_percent = percent;
    update();
}

QRectF Timeline::groove() const
{
    return QRectF(Knob + 2, std::round((height() - Thickness) / 2), std::max(1.0, width() - 2 * Knob - 4), Thickness);
}

qreal Timeline::placeOf(int value) const
{
    const QRectF along = groove();
    return along.left() + along.width() * value / std::max(1, maximum());
}

void Timeline::moveTo(qreal x)
{
    const QRectF along = groove();
    setSliderPosition(static_cast<int>(std::lround((x - along.left()) / along.width() * maximum())));
}

void Timeline::paintEvent(QPaintEvent *)
{
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    const ThemeColors &theme = colors(palette());
    const QRectF along = groove();
    const qreal at = placeOf(sliderPosition());
    painter.setPen(Qt::NoPen);
    painter.setBrush(theme.border);
    painter.drawRoundedRect(along, Thickness / 2, Thickness / 2);
    if (m_percent < 100) { // what is there to be seen already
        painter.setBrush(theme.dimmed);
        painter.drawRoundedRect(QRectF(along.left(), along.top(), along.width() * m_percent / 100, Thickness), 2, 2);
    }
    painter.setBrush(theme.accent);
    painter.drawRoundedRect(QRectF(along.left(), along.top(), at - along.left(), Thickness), Thickness / 2, Thickness / 2);
    painter.setBrush(theme.warning);
    qreal last = -1;
    for (const int mark : m_marks) {
        const qreal x = std::round(placeOf(mark));
        if (x == last)
            continue; // of many at one place one is enough
        last = x;
        painter.drawRect(QRectF(x - 1, along.top() - 6, 2, 4));
    }
    painter.setBrush(isEnabled() ? theme.accent : theme.dimmed);
    painter.setPen(QPen(palette().color(QPalette::Window), 2));
    painter.drawEllipse(QPointF(at, along.center().y()), Knob, Knob);
    if (m_showFocus) {
        painter.setBrush(Qt::NoBrush);
        painter.setPen(QPen(theme.accent, 1));
        painter.drawEllipse(QPointF(at, along.center().y()), Knob + 1.5, Knob + 1.5);
    }
}

void Timeline::mousePressEvent(QMouseEvent *event)
{
    if (event->button() != Qt::LeftButton)
        return event->ignore();
    setSliderDown(true);
    moveTo(event->position().x());
}

void Timeline::mouseMoveEvent(QMouseEvent *event)
{
    if (isSliderDown())
        moveTo(event->position().x());
}

void Timeline::mouseReleaseEvent(QMouseEvent *)
{
    setSliderDown(false);
}

void Timeline::focusInEvent(QFocusEvent *event)
{
    m_showFocus = event->reason() != Qt::MouseFocusReason;
    QAbstractSlider::focusInEvent(event);
    update();
}

void Timeline::focusOutEvent(QFocusEvent *event)
{
    m_showFocus = false;
    QAbstractSlider::focusOutEvent(event);
    update();
}

} // namespace dynascope
