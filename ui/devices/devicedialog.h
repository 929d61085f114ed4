// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/device.h"
#include "ui/common/messagebar.h"

#include <QDialog>
#include <QPointer>

class QCheckBox;
class QDialogButtonBox;
class QFormLayout;
class QLabel;
class QPushButton;

namespace dynascope {

/// What the dialogs about one device share: who it is, a line that says what stands in the way or what will follow,
/// torque. Closes when the device goes, follows it where it moves. Its title says whose it is, for others may be selected
/// meanwhile. For present(), never exec().
class DeviceDialog : public QDialog
{
    Q_OBJECT

protected:
    DeviceDialog(Device &device, const QString &title, const QString &accept, QWidget *parent);

    /// nullptr once the session has dropped it.
    Device *device() const { return m_device; }
    QFormLayout *form() const { return m_form; }
    bool turnsTorqueOff() const;
    void beginWith(QWidget *widget); ///< has the focus first; the rest follows it at the Tab key
    void leaveTorque();              ///< what it does needs no torque off first

    /// Why it can't be done, or what it will mean. An error disables the button.
    void setNote(MessageKind kind, const QString &text, bool mayAccept = true); ///< never with an error
    /// The torque has to be off: says so where it is on, with the box that turns it off. False: it stands in the way.
    bool torqueAllows() const;
    /// Called at start, when the device changes and when the torque box is ticked.
    virtual void check() = 0;
    void changeEvent(QEvent *event) override;

private:
    void showWho();
    void showTorque();
    void drawNote();

    QPointer<Device> m_device;
    const QString m_title;
    QLabel *m_who;
    QFormLayout *m_form;
    QLabel *m_noteIcon;
    QLabel *m_note;
    QCheckBox *m_torqueOff;
    QDialogButtonBox *m_buttons;
    QPushButton *m_accept;
    MessageKind m_noteKind = MessageKind::Info;
    bool m_leavesTorque = false;
};

} // namespace dynascope
