// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>

class QTreeView;

namespace dynascope {

/// The first column of a tree once more, over it: names stay in sight while what they name is scrolled to sideways.
class FrozenNames : public QWidget
{
    Q_OBJECT

public:
    explicit FrozenNames(QTreeView &view); ///< a child of it

    void place(); ///< over the first column's place; hidden while that is in sight

protected:
    bool eventFilter(QObject *watched, QEvent *event) override;
    void paintEvent(QPaintEvent *event) override;
    void mousePressEvent(QMouseEvent *event) override;
    void mouseDoubleClickEvent(QMouseEvent *event) override;
    void contextMenuEvent(QContextMenuEvent *event) override;
    void wheelEvent(QWheelEvent *event) override;

private:
    int headerHeight() const;
    QModelIndex rowAt(int y) const; ///< its name
    void paintRow(QPainter &painter, const QModelIndex &name) const;

    QTreeView &m_view;
};

} // namespace dynascope
