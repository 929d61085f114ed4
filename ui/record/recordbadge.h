// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QTimer>
#include <QWidget>

class QLabel;
class QToolButton;

namespace dynascope {

class SessionRecorder;
class SessionStream;

/// At the end of the status bar: the button that records, before it what a recording has come to, and where samples are
/// streamed to. The button never moves under the pointer, the figures don't jump.
class RecordBadge : public QWidget
{
    Q_OBJECT

public:
    /// `record` is the button's; all outlive this.
    RecordBadge(const SessionRecorder &recorder, const SessionStream &stream, QAction &record, QWidget *parent = nullptr);

protected:
    void changeEvent(QEvent *event) override;

private:
    QLabel *addLabel(const QString &name, const QString &accessible);
    void update();
    void colour();

    const SessionRecorder &m_recorder;
    const SessionStream &m_stream;
    QLabel *m_streaming;
    QLabel *m_dot;
    QLabel *m_word;
    QLabel *m_time;
    QLabel *m_size = nullptr;
    QToolButton *m_button;
    QTimer m_timer;
};

} // namespace dynascope
