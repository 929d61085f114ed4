// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/journal/undo.h"
#include "ui/common/workbench.h"

#include <QDialog>

class QLabel;
class QPushButton;
class QTreeView;

namespace dynascope {

class JournalModel;

/// What was written, by whom, and what it replaced; the selected entries can be taken back. Stands beside the window.
class JournalDialog : public QDialog
{
    Q_OBJECT

public:
    JournalDialog(const Workbench &workbench, QWidget *window);

signals:
    void requested(const std::vector<qint64> &numbers, dynascope::Direction direction);

private:
    std::vector<qint64> selected() const;
    void makeView();
    void saveScript();
    void update();
    void restoreSelection();

    Workbench m_workbench;
    JournalModel *m_model;
    QTreeView *m_view;
    QPushButton *m_undo;
    QPushButton *m_redo;
    QPushButton *m_script;
    QLabel *m_empty;
    QLabel *m_said; ///< where the script is
    std::vector<qint64> m_selected; ///< over a reset of the model
    qint64 m_current = 0;
};

} // namespace dynascope
