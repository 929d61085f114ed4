// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QDialog>
#include <QTimer>

class QLabel;
class QLineEdit;
class QPushButton;
class QSpinBox;

namespace dynascope {

class SessionStream;
struct StreamWishes;

/// Starts and stops the streaming of what is watched, and says what leaves this machine.
class StreamDialog : public QDialog
{
    Q_OBJECT

public:
    /// `stream` outlives it.
    explicit StreamDialog(SessionStream &stream, QWidget *parent = nullptr);

protected:
    void changeEvent(QEvent *event) override;

private:
    void build();
    StreamWishes wishes() const;
    void toggle();
    void update();

    SessionStream &m_stream;
    QLineEdit *m_host;
    QSpinBox *m_port;
    QLabel *m_warningIcon;
    QLabel *m_warning;
    QLabel *m_state;
    QPushButton *m_toggle;
    QTimer m_timer;
    QString m_failure; ///< why it could not be started
};

} // namespace dynascope
