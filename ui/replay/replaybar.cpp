// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/replay/replaybar.h"

#include "core/replay/replayer.h"
#include "ui/common/icons.h"
#include "ui/common/theme.h"
#include "ui/replay/replaytexts.h"
#include "ui/replay/timeline.h"

#include <QAction>
#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QLocale>
#include <QMenu>
#include <QSignalBlocker>
#include <QToolButton>

#include <algorithm>
#include <array>

namespace dynascope {
namespace {

using namespace std::chrono_literals;

constexpr std::array Speeds{0.1, 0.25, 0.5, 1.0, 2.0, 5.0, 10.0, 50.0};
constexpr LineTime Longest = 24h * 24; ///< whose milliseconds are an int

int milliseconds(LineTime time)
{
    return static_cast<int>(std::chrono::duration_cast<std::chrono::milliseconds>(std::clamp(time, 0ns, Longest)).count());
}

/// Its key is told, too.
void setLook(QAction &action, const QString &iconName, const QString &text)
{
    action.setIcon(icon(iconName));
    action.setText(text);
    action.setToolTip(QStringLiteral("%1 (%2)").arg(QString(text).remove(u'&'),
                                                    action.shortcut().toString(QKeySequence::NativeText)));
}

} // namespace

ReplayBar::ReplayBar(Replayer &replayer, QWidget *parent)
    : QWidget(parent)
    , m_replayer(replayer)
    , m_begin(add(QStringLiteral("toBeginAction"), QStringLiteral("to-begin"), tr("Back to the &begin"),
                  QStringLiteral("Ctrl+Home")))
    , m_back(add(QStringLiteral("stepBackAction"), QStringLiteral("step-back"), tr("One reading bac&k"),
                 QStringLiteral("Ctrl+Left")))
    , m_play(add(QStringLiteral("playAction"), QStringLiteral("play"), tr("&Play"), QStringLiteral("Ctrl+Space")))
    , m_forward(add(QStringLiteral("stepForwardAction"), QStringLiteral("step-forward"), tr("One reading &on"),
                    QStringLiteral("Ctrl+Right")))
    , m_timeline(new Timeline(this))
    , m_time(new QLabel(this))
    , m_length(new QLabel(this))
    , m_wall(new QLabel(this))
    , m_speed(new QComboBox(this))
{
    setObjectName(QStringLiteral("replayBar"));
    auto *layout = new QHBoxLayout(this);
    layout->setContentsMargins(8, 4, 12, 4);
    layout->setSpacing(4);
    for (QAction *action : {m_begin, m_back, m_play, m_forward}) {
        auto *button = new QToolButton(this);
        button->setDefaultAction(action);
        button->setObjectName(action->objectName().chopped(6) + QStringLiteral("Button"));
        button->setAccessibleName(action->text().remove(u'&'));
        button->setAutoRaise(true);
        button->setIconSize(QSize(18, 18));
        button->setFixedSize(30, 30);
        layout->addWidget(button);
    }
    m_back->setAutoRepeat(true);
    m_forward->setAutoRepeat(true);
    for (QLabel *label : {m_time, m_length, m_wall})
        label->setFont(numberFont(font()));
    m_time->setObjectName(QStringLiteral("replayTime"));
    m_length->setForegroundRole(QPalette::PlaceholderText);
    m_wall->setForegroundRole(QPalette::PlaceholderText);
    m_wall->setToolTip(tr("What the clock on the wall said then"));
    layout->addSpacing(4);
    layout->addWidget(m_time);
    layout->addWidget(m_timeline, 1);
    layout->addWidget(m_length);
    layout->addSpacing(8);
    layout->addWidget(m_wall);
    layout->addSpacing(8);
    makeSpeeds();
    layout->addWidget(m_speed);

    connect(m_begin, &QAction::triggered, this, [this] { m_replayer.seek(m_replayer.clock().begin()); });
    connect(m_back, &QAction::triggered, this, [this] { m_replayer.step(-1); });
    connect(m_forward, &QAction::triggered, this, [this] { m_replayer.step(1); });
    connect(m_play, &QAction::triggered, this,
            [this] { m_replayer.clock().isPlaying() ? m_replayer.pause() : m_replayer.play(); });
    connect(m_timeline, &QAbstractSlider::valueChanged, this, [this](int value) {
        const ReplayClock &clock = m_replayer.clock();
        const bool isEnd = value == m_timeline->maximum(); // less than a millisecond before it
        m_replayer.seek(isEnd ? clock.end() : clock.begin() + std::chrono::milliseconds(value));
    });
    connect(&replayer, &Replayer::moved, this, &ReplayBar::showPosition);
    connect(&replayer, &Replayer::stateChanged, this, &ReplayBar::showState);
    connect(&replayer, &Replayer::loadProgressed, this, &ReplayBar::showRecording);
    connect(&replayer, &Replayer::loaded, this, &ReplayBar::showRecording);
    showRecording();
    showState();
}

QAction *ReplayBar::add(const QString &name, const QString &iconName, const QString &text, const QString &keys)
{
    auto *action = new QAction(this);
    action->setObjectName(name);
    action->setShortcut(QKeySequence(keys));
    action->setAutoRepeat(false);
    setLook(*action, iconName, text);
    return action;
}

void ReplayBar::makeSpeeds()
{
    m_speed->setObjectName(QStringLiteral("replaySpeed"));
    m_speed->setAccessibleName(tr("Speed"));
    m_speed->setToolTip(tr("Seconds of the recording that pass in one"));
    for (const double speed : Speeds)
        m_speed->addItem(speedText(speed), speed);
    connect(m_speed, &QComboBox::activated, this,
            [this](int index) { m_replayer.setSpeed(m_speed->itemData(index).toDouble()); });
}

void ReplayBar::fill(QMenu &menu)
{
    for (QAction *action : {m_play, m_back, m_forward, m_begin})
        menu.addAction(action);
}

void ReplayBar::showRecording()
{
    const ReplayClock &clock = m_replayer.clock();
    const LineTime length = clock.end() - clock.begin();
    {
        const QSignalBlocker blocker(m_timeline);
        m_timeline->setLength(milliseconds(length));
        m_timeline->setLoaded(m_replayer.percentLoaded());
    }
    m_length->setText(replayTimeText(length));
    m_time->setMinimumWidth(m_length->sizeHint().width()); // nothing moves while it ticks
    std::vector<int> marks;
    for (const LoggedEvent &event : m_replayer.events())
        marks.push_back(milliseconds(event.at - clock.begin()));
    m_timeline->setMarks(std::move(marks));
    for (QAction *action : {m_begin, m_back, m_play, m_forward})
        action->setEnabled(m_replayer.isLoaded());
    m_timeline->setEnabled(m_replayer.isLoaded());
    showPosition();
}

void ReplayBar::showPosition()
{
    const ReplayClock &clock = m_replayer.clock();
    const LineTime at = clock.position() - clock.begin();
    const QSignalBlocker blocker(m_timeline);
    if (!m_timeline->isSliderDown())
        m_timeline->setValue(milliseconds(at));
    m_timeline->update(); // its signals would have told it
    m_time->setText(replayTimeText(at));
    m_wall->setText(QLocale().toString(m_replayer.wallTime(clock.position()), QStringLiteral("yyyy-MM-dd  HH:mm:ss")));
}

void ReplayBar::showState()
{
    const bool isPlaying = m_replayer.clock().isPlaying();
    setLook(*m_play, isPlaying ? QStringLiteral("pause") : QStringLiteral("play"), isPlaying ? tr("&Pause") : tr("&Play"));
    const auto speed = std::ranges::find(Speeds, m_replayer.clock().speed());
    m_speed->setCurrentIndex(static_cast<int>(speed - Speeds.begin()));
}

} // namespace dynascope
