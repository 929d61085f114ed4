// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>

class QLineEdit;
class QToolButton;

namespace dynascope {

class FieldFilterModel;

/// Search and filters above the grid, and what only several devices need.
class TableTools : public QWidget
{
    Q_OBJECT

public:
    explicit TableTools(FieldFilterModel &filter, QWidget *parent = nullptr);

    void setDeviceCount(int count);
    void setAnySetHere(bool any); ///< without any there is nothing to filter by
    void showSetHere();           ///< nothing but what was set in this session
    QLineEdit *search() const { return m_search; }

signals:
    void filterChanged();
    void leaveSearch();            ///< back to the grid

protected:
    bool eventFilter(QObject *watched, QEvent *event) override;

private:
    QToolButton *addToggle(const char *objectName, const QString &text, const QString &toolTip);

    FieldFilterModel &m_filter;
    QLineEdit *m_search;
    QToolButton *m_setHere;
    QToolButton *m_different;
};

} // namespace dynascope
