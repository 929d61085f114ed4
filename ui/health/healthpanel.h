// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QPersistentModelIndex>
#include <QWidget>

class QLabel;
class QStackedWidget;
class QToolButton;
class QTreeView;

namespace dynascope {

class ElidedLabel;
class HealthModel;
class LineSession;

/// The Bus health view: which device's answers come badly, in which way, and what that usually comes from. What the
/// mouse or the selection is at is explained below the table.
class HealthPanel : public QWidget
{
    Q_OBJECT

public:
    explicit HealthPanel(QWidget *parent = nullptr);

    void setLine(LineSession *line); ///< nullptr: none
    void copy() const;               ///< the table as text, to the clipboard

signals:
    void closeRequested();

protected:
    bool eventFilter(QObject *watched, QEvent *event) override;
    void resizeEvent(QResizeEvent *event) override;

private:
    QWidget *makeHeader();
    void makeView();
    void explain();
    void refresh();

    HealthModel *m_model;
    QTreeView *m_view;
    QStackedWidget *m_stack;
    QLabel *m_empty;
    QLabel *m_explanation;
    ElidedLabel *m_since;
    QToolButton *m_anew;
    QToolButton *m_copy;
    QPersistentModelIndex m_hovered;
    int m_hoveredHeading = -1;
};

} // namespace dynascope
