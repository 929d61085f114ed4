// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/common/loweredge.h"

#include <QEvent>
#include <QWidget>

#include <algorithm>

namespace dynascope {

LowerEdge::LowerEdge(QWidget &strip, QWidget &ground)
    : QObject(&strip)
    , m_strip(strip)
    , m_ground(&ground)
{
    strip.installEventFilter(this);
    ground.installEventFilter(this);
    // Where the ground stands is changed by what stands around it.
    if (strip.parentWidget())
        strip.parentWidget()->installEventFilter(this);
}

void LowerEdge::standOn(QWidget &other)
{
    m_under = &other;
    other.installEventFilter(this);
}

bool LowerEdge::eventFilter(QObject *watched, QEvent *event)
{
    switch (event->type()) {
    case QEvent::Resize:
    case QEvent::Move:
    case QEvent::LayoutRequest:
    case QEvent::Hide:
        place();
        break;
    case QEvent::Show:
        place();
        if (watched == m_ground) // only now its own layout is right
            QMetaObject::invokeMethod(this, &LowerEdge::place, Qt::QueuedConnection);
        break;
    default: break;
    }
    return QObject::eventFilter(watched, event);
}

void LowerEdge::place()
{
    if (!m_ground || !m_strip.parentWidget() || m_strip.isHidden())
        return;
    const QRect ground(m_ground->mapTo(m_strip.parentWidget(), QPoint()), m_ground->size());
    int height = m_strip.hasHeightForWidth() ? m_strip.heightForWidth(ground.width()) : m_strip.sizeHint().height();
    height = std::max(height, m_strip.minimumSizeHint().height());
    if (m_coversAll)
        height = std::max(height, ground.height());
    int bottom = ground.bottom();
    if (m_under && !m_under->isHidden())
        bottom = std::min(bottom, m_under->geometry().top() - 1);
    QRect wanted(ground.left(), bottom - height + 1, ground.width(), height);
    if (m_spared && wanted.intersects(m_spared().translated(ground.topLeft())))
        wanted.moveTop(ground.top());
    if (m_strip.geometry() != wanted)
        m_strip.setGeometry(wanted);
    m_strip.raise();
}

} // namespace dynascope
