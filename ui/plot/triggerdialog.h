// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/plot/plottrigger.h"

#include <QDialog>

class QComboBox;
class QDoubleSpinBox;
class QFormLayout;
class QSpinBox;

namespace dynascope {

/// Asks what the plots shall be triggered by.
class TriggerDialog : public QDialog
{
    Q_OBJECT

public:
    /// A trace that may trigger, with the value it has now.
    struct Source {
        TraceKey key;
        QString name, unit;
        int decimals = 0;
        double value = 0;
    };
    TriggerDialog(const TriggerChoice &choice, std::vector<Source> sources, QWidget *parent = nullptr);

signals:
    void chosen(const dynascope::TriggerChoice &choice);

private:
    TriggerChoice result() const;
    void showKind();
    void showUnit();

    std::vector<Source> m_sources;
    QFormLayout *m_form;
    QComboBox *m_kind;
    QComboBox *m_source;
    QDoubleSpinBox *m_level;
    QDoubleSpinBox *m_hysteresis;
    QSpinBox *m_before;
    QSpinBox *m_after;
    QComboBox *m_mode;
};

} // namespace dynascope
