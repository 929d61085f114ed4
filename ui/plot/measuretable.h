// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QTableView>

namespace dynascope {

class MeasureModel;

/// The figures between the cursors, below a plot. As high as it has rows, within reason; columns grow and never shrink,
/// so that ticking figures don't jump.
class MeasureTable : public QTableView
{
    Q_OBJECT

public:
    explicit MeasureTable(MeasureModel &model, QWidget *parent = nullptr);

    void setRoom(int height); ///< takes no more of it than its rows need, and at least two rows

    QSize sizeHint() const override;
    QSize minimumSizeHint() const override;

protected:
    void resizeEvent(QResizeEvent *event) override;
    void changeEvent(QEvent *event) override;
    void keyPressEvent(QKeyEvent *event) override;

private:
    void fitColumns();
    void copySelected() const;
    int heightFor(int rows) const;

    int m_mostRows; ///< more are scrolled
};

} // namespace dynascope
