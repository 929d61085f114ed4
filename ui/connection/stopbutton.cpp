// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/connection/stopbutton.h"

#include "core/session/stopcontrol.h"
#include "ui/common/icons.h"
#include "ui/common/texts.h"
#include "ui/common/theme.h"

#include <QPainter>
#include <QStyle>

namespace dynascope {

namespace {

constexpr int Height = 36;
constexpr int IconSize = 20;
constexpr int Padding = 14;
constexpr int Gap = 8;
const QColor Red(0xC6, 0x28, 0x28); ///< the same in light and dark: a sign, not a decoration; white on it is 5.6:1

} // namespace

StopButton::StopButton(StopControl &stop, QWidget *parent)
    : QAbstractButton(parent)
    , m_stop(stop)
{
    setObjectName(QStringLiteral("stopButton"));
    setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Fixed);
    setFocusPolicy(Qt::TabFocus); // a click must not take the focus from an editor
    setAttribute(Qt::WA_Hover);
    setCursor(Qt::PointingHandCursor);
    // Down, not up: the way of a real emergency stop. The click that follows must not release what was just pressed.
    connect(this, &QAbstractButton::pressed, this, [this] {
        m_stopsNow = !m_stop.isActive() || m_isSecond;
        if (m_stopsNow)
            m_stop.press();
    });
    connect(this, &QAbstractButton::clicked, this, [this] {
        if (!m_stopsNow && m_stop.isActive())
            m_stop.release();
    });
    connect(&m_stop, &StopControl::changed, this, &StopButton::update);
    update();
}

void StopButton::update()
{
    const bool active = m_stop.isActive();
    setText(active ? tr("Release STOP") : tr("STOP"));
    setAccessibleName(text());
    const QString release = tr("Torque may be turned on again. Nothing moves by itself.\n%1").arg(m_stop.report());
    setToolTip(active ? plainToolTip(release)
                      : tr("Turns the torque of every device off at once (Esc)"));
    updateGeometry();
    QAbstractButton::update();
}

QSize StopButton::sizeHint() const
{
    // Wide enough for either text, so that nothing beside it moves.
    const QFontMetrics metrics(boldened(font()));
    const int text = qMax(metrics.horizontalAdvance(tr("Release STOP")), metrics.horizontalAdvance(tr("STOP")));
    return {text + IconSize + Gap + 2 * Padding, Height};
}

/// Who hits it twice in haste wants to stop.
void StopButton::mouseDoubleClickEvent(QMouseEvent *event)
{
    m_isSecond = true;
    mousePressEvent(event);
    m_isSecond = false;
}

void StopButton::paintEvent(QPaintEvent *)
{
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    const bool active = m_stop.isActive();
    const QRectF box = QRectF(rect()).adjusted(1, 1, -1, -1);
    QColor fill = active ? palette().color(QPalette::Base) : Red;
    if (isDown())
        fill = fill.darker(125);
    else if (underMouse())
        fill = active ? fill.darker(105) : fill.lighter(112);
    painter.setBrush(fill);
    painter.setPen(active ? QPen(Red, 2) : QPen(Qt::NoPen));
    painter.drawRoundedRect(box, 5, 5);
    if (hasFocus() && window()->testAttribute(Qt::WA_KeyboardFocusChange)) {
        painter.setBrush(Qt::NoBrush);
        painter.setPen(QPen(active ? colors(palette()).accent : QColor(Qt::white), 1.5));
        painter.drawRoundedRect(box.adjusted(3, 3, -3, -3), 3, 3);
    }
    const QColor ink = active ? colors(palette()).bad : QColor(Qt::white);
    painter.setFont(boldened(font()));
    const int textWidth = painter.fontMetrics().horizontalAdvance(text());
    const int left = (width() - textWidth - IconSize - Gap) / 2;
    paintIcon(&painter, QRectF(left, (height() - IconSize) / 2.0, IconSize, IconSize),
              active ? QStringLiteral("unlock") : QStringLiteral("stop"), ink);
    painter.setPen(ink);
    painter.drawText(
        QRect(left + IconSize + Gap, 0, textWidth + 4, height()), Qt::AlignVCenter | Qt::AlignLeft, text());
}

} // namespace dynascope
