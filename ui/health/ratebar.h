// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>

namespace dynascope {

/// A part of a whole as a quiet bar; the largest one in the accent colour. Its figure stands beside it.
class RateBar : public QWidget
{
    Q_OBJECT

public:
    RateBar(int width, QWidget *parent);

    void setShare(double share, bool isLargest);

protected:
    void paintEvent(QPaintEvent *event) override;

private:
    double m_share = 0;
    bool m_isLargest = false;
};

} // namespace dynascope
