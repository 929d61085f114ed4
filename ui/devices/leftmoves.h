// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/session.h"
#include "ui/common/messagebar.h"
#include "ui/common/workbench.h"

#include <QObject>

namespace dynascope {

/// Moves of many devices: opens their dialog, and says of a line that is opened when moves on it were left in their
/// middle, by this program or another.
class LeftMoves : public QObject
{
    Q_OBJECT

public:
    LeftMoves(const Workbench &workbench, QWidget *window);

    /// The dialog about these devices of the line; that of the line which is open comes to the front.
    void open(LineSession &line, const std::vector<Device *> &devices);

signals:
    void posted(const dynascope::Message &message);
    void retracted(const QString &topic);

private:
    void follow(LineSession *line);
    void say(LineSession &line);

    Workbench m_workbench;
    QWidget *m_window;
};

} // namespace dynascope
