// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QFrame>

namespace dynascope {

/// One line of text that elides in the middle where it doesn't fit, and shows whole on hover.
class ElidedLabel : public QFrame
{
    Q_OBJECT

public:
    explicit ElidedLabel(QWidget *parent = nullptr);

    void setText(const QString &text);
    QString text() const { return m_text; }
    bool isElided() const { return elided() != m_text; }

    QSize sizeHint() const override;
    QSize minimumSizeHint() const override;

signals:
    void elidedChanged(); ///< isElided() may have become another

protected:
    void resizeEvent(QResizeEvent *event) override;
    void paintEvent(QPaintEvent *event) override;
    bool event(QEvent *event) override;

private:
    QString elided() const;

    QString m_text;
};

} // namespace dynascope
