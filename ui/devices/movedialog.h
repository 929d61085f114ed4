// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/moverun.h"
#include "ui/common/messagebar.h"

#include <QDialog>

class QCheckBox;
class QLabel;
class QListView;
class QPushButton;

namespace dynascope {

class MoveStepsModel;
class MoveWishes;

/// New IDs and baud rates for many devices of one line: wishes, the order of steps that they mean, what stands in the
/// way, then how far it is. Also the rest of what another run left. For present(), never exec(). While devices are
/// moved it stays: closing it ends the moves before the next step.
class MoveDialog : public QDialog
{
    Q_OBJECT

public:
    /// `devices` of the line; may be empty where a plan was left. `folder` as for MoveRun.
    MoveDialog(Session &session, Commands &commands, LineSession &line, const std::vector<Device *> &devices,
               const QString &folder, QWidget *parent);

    const MoveRun &run() const { return m_run; }
    void reject() override;

protected:
    void changeEvent(QEvent *event) override;

private:
    void build();
    void connectParts(LineSession &line);
    void replan();
    void update();
    void updateButtons();
    void showIdle();
    void showUnderWay();
    void setNote(MessageKind kind, const QString &text);
    void drawNote();
    void accepted();
    void forget();
    std::vector<const Device *> devices() const; ///< those that still live
    int underTorque() const;                     ///< movers that are
    QString whatFollows() const;

    Session &m_session;
    MoveRun m_run;
    std::vector<DeviceKey> m_devices;
    Result<MovePlan> m_planned = MovePlan();
    MoveWishes *m_wishes;
    MoveStepsModel *m_steps;
    QListView *m_list;
    QLabel *m_where;
    QLabel *m_noteIcon;
    QLabel *m_note;
    MessageKind m_noteKind = MessageKind::Info;
    QCheckBox *m_torqueOff;
    QPushButton *m_accept;
    QPushButton *m_cancel;
    QPushButton *m_forget;
    bool m_wasLeft = false; ///< by another run, and nothing was tried here yet
};

} // namespace dynascope
