// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/protocol/protocol_values.h"
#include "core/session/device.h"
#include "ui/common/messagebar.h"

#include <QDialog>

#include <vector>

class QButtonGroup;
class QLabel;
class QPushButton;
class QTreeWidget;

namespace dynascope {

class Commands;
class Session;

/// Factory Reset of several devices of a line: what survives, where each will be, and why some can't be reset together.
/// For present(), never exec().
class ResetManyDialog : public QDialog
{
    Q_OBJECT

public:
    ResetManyDialog(const std::vector<Device *> &devices, Session &session, Commands &commands, QWidget *parent);

    void accept() override;

protected:
    void changeEvent(QEvent *event) override;

private:
    void build();
    QWidget *makeOptions();
    std::vector<Device *> devices() const; ///< those that still live
    ResetOption option() const;
    void check();
    void setNote(MessageKind kind, const QString &text);
    void drawNote();

    Session &m_session;
    Commands &m_commands;
    std::vector<DeviceKey> m_keys;
    QButtonGroup *m_options;
    QTreeWidget *m_list;
    QLabel *m_noteIcon;
    QLabel *m_note;
    MessageKind m_noteKind = MessageKind::Warning;
    QPushButton *m_accept;
};

} // namespace dynascope
