// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/common/stopkey.h"

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
    return QObject::eventFilter(watched, event);
}

} // namespace dynascope
