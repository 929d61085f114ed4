// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/derived.h"

#include <QDialog>

class QComboBox;
class QDoubleSpinBox;
class QFormLayout;
class QLabel;
class QLineEdit;
class QPushButton;
class QSpinBox;

namespace dynascope {

class TraceModel;

/// Asks how a trace shall be made from those of a panel. Its traces are those of when it was opened.
class DerivedDialog : public QDialog
{
    Q_OBJECT

public:
    /// `row`: of what is proposed; −1: the first. Deleting `model` deletes nothing here: the dialog is a child of its view.
    DerivedDialog(const TraceModel &model, int row, QWidget *parent = nullptr);

signals:
    void chosen(const dynascope::TraceKey &key);

private:
    TraceKey result() const;
    void fillOthers();
    void showKind();
    Derivation::Kind kind() const;

    const TraceModel &m_model;
    std::vector<Watch> m_sources;
    QFormLayout *m_form;
    QComboBox *m_source;
    QComboBox *m_kind;
    QComboBox *m_other;
    QSpinBox *m_span;
    QDoubleSpinBox *m_factor;
    QDoubleSpinBox *m_offset;
    QLineEdit *m_unit;
    QLabel *m_meaning;
    QPushButton *m_add;
};

} // namespace dynascope
