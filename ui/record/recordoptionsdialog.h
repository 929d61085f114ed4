// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/record/recordwishes.h"

#include <QDialog>

class QComboBox;
class QLineEdit;
class QPlainTextEdit;
class QSpinBox;

namespace dynascope {

/// How recordings are made: format, folder, when a new file begins, a note. Saved when accepted; for the next recording.
class RecordOptionsDialog : public QDialog
{
    Q_OBJECT

public:
    explicit RecordOptionsDialog(QWidget *parent = nullptr);

    void accept() override;

private:
    void build();
    void chooseFolder();

    QComboBox *m_format;
    QLineEdit *m_folder;
    QSpinBox *m_minutes;
    QSpinBox *m_megabytes;
    QPlainTextEdit *m_note;
};

} // namespace dynascope
