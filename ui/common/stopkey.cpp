// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/common/stopkey.h"

#include <QCoreApplication>
#include <QKeyEvent>

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
    // A drag takes keys by a filter of its own, put before this one when it starts; the filter put last is asked first.
    if (event->type() == QEvent::DragEnter)
        QMetaObject::invokeMethod(this, [this] { qApp->installEventFilter(this); }, Qt::QueuedConnection);
    return QObject::eventFilter(watched, event);
}

} // namespace dynascope
