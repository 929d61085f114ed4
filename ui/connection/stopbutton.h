// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QAbstractButton>

namespace dynascope {

class StopControl;

/// Big and red, always in sight. While STOP holds it turns into its release.
class StopButton : public QAbstractButton
{
    Q_OBJECT

public:
    explicit StopButton(StopControl &stop, QWidget *parent = nullptr);

    QSize sizeHint() const override;
    QSize minimumSizeHint() const override { return sizeHint(); }

protected:
    void paintEvent(QPaintEvent *event) override;
    void mouseDoubleClickEvent(QMouseEvent *event) override;

private:
    void update();

    StopControl &m_stop;
    bool m_isSecond = false; ///< the press under way is the second of a double click
    bool m_stopsNow = false; ///< the press under way is the one that stopped
};

} // namespace dynascope
