// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QAbstractSlider>

#include <vector>

namespace dynascope {

/// Where a replay stands in its recording, as a bar to be dragged or clicked at, with marks where something happened.
/// Its values are milliseconds from the begin. Keys: arrows a second, page keys ten, Home and End.
class Timeline : public QAbstractSlider
{
    Q_OBJECT

public:
    explicit Timeline(QWidget *parent = nullptr);

    void setLength(int milliseconds);
    void setMarks(std::vector<int> at); ///< ascending
    void setLoaded(int percent);        ///< what is read already, from the begin on

    QSize sizeHint() const override { return {240, 28}; }
    QSize minimumSizeHint() const override { return {80, 28}; }

protected:
    void paintEvent(QPaintEvent *event) override;
    void mousePressEvent(QMouseEvent *event) override;
    void mouseMoveEvent(QMouseEvent *event) override;
    void mouseReleaseEvent(QMouseEvent *event) override;
    void focusInEvent(QFocusEvent *event) override;
    void focusOutEvent(QFocusEvent *event) override;

private:
    QRectF groove() const;
    qreal placeOf(int value) const;
    void moveTo(qreal x);

    std::vector<int> m_marks;
    int m_percent = 100;
    bool m_showFocus = false;
};

} // namespace dynascope
