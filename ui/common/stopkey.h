// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QObject>
#include <QPointer>

class QMouseEvent;
class QWidget;

namespace dynascope {

/// Esc anywhere in the application: open editors, dialogs, menus and drags included, where a shortcut doesn't fire. The
/// key keeps its usual meaning. And a press of the STOP button while a menu or a list is open, which the popup would
/// take for one beside it. Install on the application.
class StopKey : public QObject
{
    Q_OBJECT

public:
    explicit StopKey(QObject *parent = nullptr);

    void setButton(QWidget *stopButton) { m_button = stopButton; }

    bool eventFilter(QObject *watched, QEvent *event) override;

signals:
    void pressed();

private:
    bool isOnButton(const QObject *watched, const QMouseEvent &press) const;

    QPointer<QWidget> m_button;
    bool m_seen = false; ///< one press of the key passes the filter once for each object it is offered to
};

} // namespace dynascope
