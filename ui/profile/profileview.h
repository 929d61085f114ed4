// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/profilerun.h"
#include "core/session/profilesaver.h"
#include "ui/common/messagebar.h"
#include "ui/common/workbench.h"

#include <QDialog>

class QCheckBox;
class QComboBox;
class QLabel;
class QProgressBar;
class QPushButton;
class QStackedWidget;
class QTreeView;

namespace dynascope {

class ProfileFaults;
class ProfileFileBar;
class ProfileFilter;
class ProfileModel;
class ProfileNote;
class ProfilePlanPage;

/// A robot's profile beside what is on a line: what differs, then what would be written, then how far it is. For
/// present(), never exec(). While something is written it stays: closing it ends that before the next joint.
class ProfileView : public QDialog
{
    Q_OBJECT

public:
    /// `line`: the one to begin with; may be null.
    ProfileView(const Workbench &workbench, LineSession *line, QWidget *window);

    void setUnits(const UnitPreferences &units);
    void load(const QString &path);
    void compare();
    const ProfileRun &run() const { return m_run; }
    bool isBusy() const { return m_run.isBusy() || m_saver.isBusy(); }
    void reject() override;

signals:
    void torqueTurnedOn(dynascope::DeviceKey device);

protected:
    void done(int result) override;

private:
    enum Page { Empty, Faults, Compared, Plan };

    void build();
    QWidget *makeTools();
    void makeTree();
    QLayout *makeButtons();
    QPushButton *addButton(const char *name, const QString &text);
    void connectParts();
    void followLines(); ///< those that may be chosen
    void onRun();
    void update();
    void updateButtons();
    void showPage(Page page);
    void fitColumns();
    void openPlan();
    void replan();
    void write();
    void saved(const QString &path, const Result<SavedProfile> &result);
    void say();
    void sayBusy();
    void sayPlan();
    void sayCompared();
    QString whyNotCompare() const;
    QString whyNotApply() const;
    QString whyNotWrite() const;
    bool isOpen() const { return m_run.line() && m_run.line()->state() == BusThread::State::Open; }

    Workbench m_workbench;
    ProfileRun m_run;
    ProfileSaver m_saver;
    ProfileFileBar *m_file;
    ProfileModel *m_model;
    ProfileFilter *m_filter;
    QTreeView *m_tree;
    ProfileFaults *m_faults;
    ProfilePlanPage *m_plan;
    QWidget *m_empty;
    QStackedWidget *m_pages;
    QComboBox *m_lines;
    QCheckBox *m_only;
    ProfileNote *m_note;
    QProgressBar *m_progress;
    QPushButton *m_compare;
    QPushButton *m_apply;
    QPushButton *m_write;
    QPushButton *m_back;
    QPushButton *m_cancel;
    QPushButton *m_close;
    bool m_isPlanning = false;
    std::optional<std::pair<MessageKind, QString>> m_said; ///< of a file; until something else is done
};

} // namespace dynascope
