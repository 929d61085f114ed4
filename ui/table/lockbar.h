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

    /// `way` is the button's text, `other` that of a second one; empty: no button.
    void showReason(const QString &reason, const QString &way, const QString &other = {});
    void setBusy(bool busy);                                    ///< the way is being gone

signals:
    void wayChosen();
    void otherChosen();
    void dismissed();

private:
    QLabel *m_text;
    QPushButton *m_button, *m_other;
};

} // namespace dynascope
