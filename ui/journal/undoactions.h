// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/journal/undo.h"
#include "ui/common/workbench.h"

#include <QObject>

class QAction;
class QWidget;

namespace dynascope {

/// Undo, Redo and the journal. What would move a motor or end its torque is asked first.
class UndoActions : public QObject
{
    Q_OBJECT

public:
    /// The workbench has a journal and its undo.
    UndoActions(const Workbench &workbench, QWidget *window);

    std::vector<QAction *> actions() const { return {m_undo, m_redo, nullptr, m_show}; }

signals:
    void failed(const QString &what);

private:
    QAction *add(const char *name, const QString &text, const char *shortcut);
    void start(const std::vector<qint64> &numbers, Direction direction, const UndoOptions &options);
    void ask(const std::vector<qint64> &numbers, Direction direction, const UndoOptions &options, const QString &why);
    void showJournal();
    void update();

    Workbench m_workbench;
    QWidget *m_window;
    QAction *m_undo;
    QAction *m_redo;
    QAction *m_show;
};

} // namespace dynascope
