// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QFrame>

class QLabel;
class QPushButton;

namespace dynascope {

/// Says why something can't be written now and offers the way, if there is one.
class LockBar : public QFrame
{
    Q_OBJECT

public:
    explicit LockBar(QWidget *parent = nullptr);

    void showReason(const QString &reason, const QString &way); ///< `way` is the button's text; empty: no button
    void setBusy(bool busy);                                    ///< the way is being gone

signals:
    void wayChosen();
    void dismissed();

private:
    QLabel *m_text;
    QPushButton *m_button;
};

} // namespace dynascope
