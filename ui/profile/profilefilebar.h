// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>

class QAction;
class QLabel;
class QMenu;
class QPushButton;

namespace dynascope {

class ElidedLabel;

/// Which robot and which file, and what opens and saves one. Remembers the files of late.
class ProfileFileBar : public QWidget
{
    Q_OBJECT

public:
    explicit ProfileFileBar(QWidget *parent = nullptr);

    void setFile(const QString &robot, const QString &path); ///< both may be empty
    /// `maySave`: there is a line to save from; `hasFile`: and a file without faults to save into.
    void setUse(bool mayOpen, bool maySave, bool hasFile);
    QWidget *makeEmptyPage(QWidget *parent); ///< to stand where no file is open: what one is for, and the ways to one
    bool includesCalibration() const; ///< what belongs to one single device

    static QStringList recent(); ///< paths, the last one first
    static void remember(const QString &path);

signals:
    void openRequested(const QString &path);
    void saveNewRequested(const QString &path);
    void saveIntoRequested();

private:
    QPushButton *addButton(const char *name, const QString &text, QMenu *menu);
    void fillRecent();
    void askWhat();
    void askWhere();

    QLabel *m_robot;
    ElidedLabel *m_path;
    QMenu *m_recentMenu;
    QMenu *m_saveMenu;
    QPushButton *m_open;
    QPushButton *m_recent;
    QPushButton *m_save;
    QAction *m_saveNew;
    QAction *m_saveInto;
    QAction *m_calibration;
    QPushButton *m_openFirst = nullptr; ///< of the empty page, once that is made
    QPushButton *m_saveFirst = nullptr;
};

} // namespace dynascope
