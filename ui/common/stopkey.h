// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QObject>

namespace dynascope {

/// Esc anywhere in the application: open editors, dialogs, menus and drags included, where a shortcut doesn't fire. The
/// key keeps its usual meaning. Install on the application.
class StopKey : public QObject
{
    Q_OBJECT

public:
    explicit StopKey(QObject *parent = nullptr);

    bool eventFilter(QObject *watched, QEvent *event) override;

signals:
    void pressed();

private:
    bool m_seen = false; ///< one press of the key passes the filter once for each object it is offered to
};

} // namespace dynascope
