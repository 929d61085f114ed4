// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>

class QAction;
class QComboBox;
class QLabel;
class QMenu;

namespace dynascope {

class Replayer;
class Timeline;

/// Play, step, speed, and where in the recording it stands.
class ReplayBar : public QWidget
{
    Q_OBJECT

public:
    explicit ReplayBar(Replayer &replayer, QWidget *parent = nullptr); ///< which outlives this

    void fill(QMenu &menu); ///< what stands here, with its keys

private:
    QAction *add(const QString &name, const QString &iconName, const QString &text, const QString &keys);
    void makeSpeeds();
    void showRecording();
    void showPosition();
    void showState();

    Replayer &m_replayer;
    QAction *m_begin, *m_back, *m_play, *m_forward;
    Timeline *m_timeline;
    QLabel *m_time, *m_length, *m_wall;
    QComboBox *m_speed;
};

} // namespace dynascope
