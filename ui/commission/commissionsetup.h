// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/commissioning/commissionround.h"

#include <QWidget>

class QCheckBox;
class QComboBox;
class QFormLayout;
class QLabel;
class QLineEdit;
class QPushButton;
class QSpinBox;

namespace dynascope {

class BaudCombo;
class LineSession;

/// Which servos shall be set up: one model with IDs in a row, or the joints of a profile. `line` outlives it.
class CommissionSetup : public QWidget
{
    Q_OBJECT

public:
    CommissionSetup(const LineSession &line, QWidget *parent);

    /// As it stands; InvalidArgument says why it can't be.
    const Result<CommissionList> &list() const { return m_list; }
    CommissionOptions options() const;
    void loadProfile(const QString &path);

signals:
    void changed();

private:
    void build(const LineSession &line);
    void choose();
    void update();
    void showNote();
    void changeEvent(QEvent *event) override;

    const Catalog &m_catalog;
    QComboBox *m_source;
    QComboBox *m_model;
    QSpinBox *m_first;
    QSpinBox *m_count;
    QSpinBox *m_firmware;
    BaudCombo *m_baud;
    QLineEdit *m_names;
    QPushButton *m_file;
    QCheckBox *m_torqueOff;
    QLabel *m_noteIcon;
    QLabel *m_note;
    QFormLayout *m_form;
    QString m_path;                       ///< of the profile; empty: none is chosen
    Result<CommissionList> m_fromProfile; ///< what it says
    Result<CommissionList> m_list;
};

} // namespace dynascope
