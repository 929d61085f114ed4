// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/ratelimit_values.h"
#include "core/session/linesession.h"
#include "ui/common/workbench.h"

#include <QFrame>
#include <QPointer>

class QCheckBox;
class QGridLayout;
class QLabel;
class QPushButton;
class QVBoxLayout;

namespace dynascope {

/// How often is read what is wanted: wanted, predicted, achieved; what takes the time, with what can be done about it;
/// and how often each watched field is wanted. A pop-up: Esc or a click beside it closes it. Deletes itself.
class RatePopup : public QFrame
{
    Q_OBJECT

public:
    RatePopup(const Workbench &workbench, LineSession &line, QWidget *parent);

    void open(const QWidget &over); ///< above its upper edge

signals:
    void remedyChosen(const dynascope::RateLimit &limit);

private:
    struct Row {
        QLabel *name, *wanted, *predicted, *achieved;
    };
    struct LimitRow {
        QLabel *name, *share, *gain;
        QWidget *bar;
        QPushButton *remedy;
        RateLimit limit;
    };
    QLabel *add(QGridLayout &grid, int row, int column, const QString &text, bool isFigure);
    void addRates(QVBoxLayout &layout);
    void addLimits(QVBoxLayout &layout);
    void addFields(QVBoxLayout &layout);
    void refresh();
    void refreshRates();
    void refreshLimits();

    Workbench m_workbench;
    QPointer<LineSession> m_line;
    QLabel *m_verdict = nullptr;
    std::vector<Row> m_rates;
    std::vector<LimitRow> m_limits;
    QCheckBox *m_fast = nullptr;
};

} // namespace dynascope
