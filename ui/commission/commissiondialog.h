// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/commissioning/commissioning.h"
#include "ui/common/messagebar.h"

#include <QDialog>

class QLabel;
class QPushButton;
class QStackedWidget;
class QTreeView;

namespace dynascope {

class CommissionModel;
class CommissionSetup;

/// New servos of one line, plugged in one after the other: first which, then who is next, in one big sentence. Closes
/// with its line. For present(), never exec().
class CommissionDialog : public QDialog
{
    Q_OBJECT

public:
    /// `folder`: MoveFile::usualFolder(), or a test's.
    CommissionDialog(Commands &commands, LineSession &line, const QString &folder, QWidget *parent);

    Commissioning &commissioning() { return m_commissioning; }

signals:
    void posted(dynascope::MessageKind kind, const QString &text);

protected:
    void changeEvent(QEvent *event) override;

private:
    QWidget *makeWork();
    QLayout *makeJointButtons();
    void makeButtons();
    QPushButton *button(const QString &name, const QString &text, const QString &iconName, const QString &toolTip);
    void startOrGoOn();
    void update();
    void updateButtons();
    void showNote();
    void saveLabels(const QString &suffix);
    std::optional<std::size_t> selected() const; ///< a joint; else the one that was done last

    const Catalog &m_catalog;
    Commissioning m_commissioning;
    CommissionModel *m_model;
    QStackedWidget *m_pages;
    CommissionSetup *m_setup;
    QLabel *m_sentence = nullptr;
    QLabel *m_detail = nullptr;
    QLabel *m_noteIcon = nullptr;
    QLabel *m_note = nullptr;
    QTreeView *m_view = nullptr;
    QPushButton *m_led = nullptr;
    QPushButton *m_skip = nullptr;
    QPushButton *m_back = nullptr;
    QPushButton *m_isNew = nullptr;
    QPushButton *m_again = nullptr;
    QPushButton *m_csv = nullptr;
    QPushButton *m_pdf = nullptr;
    QPushButton *m_start = nullptr;
    QPushButton *m_pause = nullptr;
    MessageKind m_noteKind = MessageKind::Info;
    int m_lastTicked = -1;
};

} // namespace dynascope
