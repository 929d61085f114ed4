// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/common/stopkey.h"

#include <QApplication>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QWidget>
#include <QWindow>

namespace dynascope {

StopKey::StopKey(QObject *parent)
    : QObject(parent)
{
}

bool StopKey::eventFilter(QObject *watched, QEvent *event)
{
    // ShortcutOverride comes first, and alone where some shortcut takes the key.
    if (event->type() == QEvent::KeyPress || event->type() == QEvent::ShortcutOverride) {
        const auto *key = static_cast<QKeyEvent *>(event);
        if (key->key() == Qt::Key_Escape && !key->isAutoRepeat() && !m_seen) {
            m_seen = true;
            QMetaObject::invokeMethod(this, [this] { m_seen = false; }, Qt::QueuedConnection);
            emit pressed();
        }
    }
    if (event->type() == QEvent::MouseButtonPress && QApplication::activePopupWidget()
        && isOnButton(watched, *static_cast<QMouseEvent *>(event))) {
        emit pressed();
        // The press ends here: neither the popup nor, once it is closed, the button, which would release STOP.
        const QWidget *closed = nullptr;
        for (QWidget *popup = QApplication::activePopupWidget(); popup && popup != closed;
             popup = QApplication::activePopupWidget()) {
            closed = popup;
            popup->close();
        }
        return true;
    }
    // A drag takes keys by a filter of its own, put before this one when it starts; the filter put last is asked first.
    if (event->type() == QEvent::DragEnter)
        QMetaObject::invokeMethod(this, [this] { qApp->installEventFilter(this); }, Qt::QueuedConnection);
    return QObject::eventFilter(watched, event);
}

/// Asked of windows and of widgets alike: which of them a press comes to first depends on the platform.
bool StopKey::isOnButton(const QObject *watched, const QMouseEvent &press) const
{
    if (!m_button || !m_button->isVisible() || press.button() != Qt::LeftButton)
        return false;
    const QPoint at = press.globalPosition().toPoint();
    if (!m_button->rect().contains(m_button->mapFromGlobal(at)))
        return false;
    const QWidget *window = m_button->window();
    if (watched == window->windowHandle())
        return true; // so it came down on nothing above it
    for (const QWidget *other : QApplication::topLevelWidgets()) {
        if (other != window && other->isVisible() && other->frameGeometry().contains(at))
            return false;
    }
    return true;
}

} // namespace dynascope
