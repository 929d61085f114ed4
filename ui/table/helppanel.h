// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/table/units.h"

#include <QFrame>
#include <QModelIndex>

class QLabel;
class QScrollArea;
class QToolButton;

namespace dynascope {

/// What the register under the cursor is for, in a strip of fixed height that folds to one line.
class HelpPanel : public QFrame
{
    Q_OBJECT

public:
    explicit HelpPanel(QWidget *parent = nullptr);

    void showCell(const QModelIndex &cell); ///< a value's cell; invalid: nothing
    void setUnits(const UnitPreferences &units) { m_units = units; }
    void setNotes(const QStringList &notes); ///< on the whole table: said where no register is chosen
    bool isFolded() const { return m_folded; }
    void setFolded(bool folded);
    void setTight(bool tight); ///< where there is little height: two lines of text, the rest is scrolled to

private:
    QStringList linesFor(const QModelIndex &cell, const Field &field) const;

    UnitPreferences m_units;
    bool m_folded = false;
    QString m_shown;
    QStringList m_notes;
    QLabel *m_name;
    QLabel *m_facts;
    QLabel *m_text;
    QScrollArea *m_area;
    QToolButton *m_fold;
};

} // namespace dynascope
