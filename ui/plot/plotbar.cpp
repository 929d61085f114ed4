// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/plot/plotbar.h"

#include "ui/common/icons.h"
#include "ui/plot/timewindow.h"

#include <QLabel>
#include <QMenu>
#include <QSignalBlocker>
#include <QToolButton>

#include <algorithm>
#include <array>

namespace dynascope {

namespace {

constexpr std::array RoundSpans{1, 2, 5, 10, 20, 30, 60, 120, 300, 600};

int inSeconds(LineTime time)
{
    return static_cast<int>(std::chrono::duration_cast<std::chrono::seconds>(time).count());
}

} // namespace

SpanBox::SpanBox(QWidget *parent) : QSpinBox(parent)
{
    setRange(inSeconds(TimeWindow::ShortestSpan), inSeconds(TimeWindow::LongestSpan));
    setSuffix(tr(" s"));
    setValue(10);
    setKeyboardTracking(false);
    setAlignment(Qt::AlignRight);
    setToolTip(tr("How much time the plots show, 1 to 600 seconds (also the wheel over a plot)"));
    setAccessibleName(tr("Time span"));
}

std::chrono::seconds SpanBox::stepped(std::chrono::nanoseconds span, int steps)
{
    int value = inSeconds(span);
    for (; steps > 0; --steps) {
        const auto *next = std::ranges::upper_bound(RoundSpans, value);
        value = next == RoundSpans.end() ? RoundSpans.back() : *next;
    }
    for (; steps < 0; ++steps) {
        const auto *next = std::ranges::lower_bound(RoundSpans, value);
        value = next == RoundSpans.begin() ? RoundSpans.front() : *(next - 1);
    }
    return std::chrono::seconds(value);
}

void SpanBox::stepBy(int steps)
{
    setValue(static_cast<int>(stepped(std::chrono::seconds(value()), steps).count()));
}

/// More digits than fit are taken and brought into range at the end: refused one by one they would make 70 of 700.
QValidator::State SpanBox::validate(QString &text, int &position) const
{
    const QValidator::State state = QSpinBox::validate(text, position);
    return state == QValidator::Invalid && isDigits(text) ? QValidator::Intermediate : state;
}

void SpanBox::fixup(QString &text) const
{
    if (isDigits(text))
        text = QString::number(std::clamp(digitsOf(text).toInt(), minimum(), maximum()));
    else
        QSpinBox::fixup(text);
}

QString SpanBox::digitsOf(const QString &text) const
{
    return QString(text).remove(suffix()).trimmed();
}

bool SpanBox::isDigits(const QString &text) const
{
    const QString digits = digitsOf(text);
    return !digits.isEmpty() && digits.size() <= 6
        && std::ranges::all_of(digits, [](QChar letter) { return letter >= u'0' && letter <= u'9'; });
}

PlotBar::PlotBar(QWidget *parent) : QToolBar(parent), m_span(new SpanBox(this))
{
    setIconSize({16, 16});
    setMovable(false);
    m_pause =
        add(QStringLiteral("pause"), tr("Pause"), tr("Hold the plots still; drag and wheel then move and zoom them (Shift+drag: a box, also while live)"));
    m_pause->setCheckable(true);
    connect(m_pause, &QAction::toggled, this, [this](bool paused) {
        showLive(!paused);
        emit liveChanged(!paused);
    });
    addWidget(m_span);
    connect(m_span, &QSpinBox::valueChanged, this, &PlotBar::spanChanged);
    m_autoscale = add(QStringLiteral("fit"), tr("Autoscale"),
        tr("Let the value axes follow what is seen (the wheel over an axis, or Ctrl+wheel, zooms by hand)"));
    m_autoscale->setCheckable(true);
    m_autoscale->setChecked(true);
    connect(m_autoscale, &QAction::toggled, this, &PlotBar::autoscaleChanged);
    m_cursors = add(QStringLiteral("cursor"), tr("Cursors"),
        tr("Measure between two cursors: drag them, or place them in a plot with the keys A and B; "
           "Shift+arrows move the last one, C hides them"));
    m_cursors->setCheckable(true);
    connect(m_cursors, &QAction::toggled, this, &PlotBar::cursorsChanged);
    m_trigger = add(QStringLiteral("trigger"), tr("Trigger"),
        tr("Let the plots stand where a trace crosses a level, or something happens; the arrow asks for when"));
    m_trigger->setCheckable(true);
    connect(m_trigger, &QAction::toggled, this, &PlotBar::triggerChanged);
    auto *menu = new QMenu(this);
    connect(menu->addAction(tr("Trigger &settings…")), &QAction::triggered, this, &PlotBar::triggerSettingsRequested);
    if (auto *button = qobject_cast<QToolButton *>(widgetForAction(m_trigger))) {
        button->setMenu(menu);
        button->setPopupMode(QToolButton::MenuButtonPopup);
    }
    addSeparator();
    m_clear = add(QStringLiteral("trash"), tr("Clear"), tr("Forget all samples; the traces stay"));
    connect(m_clear, &QAction::triggered, this, &PlotBar::clearRequested);
    auto *saveMenu = new QMenu(this);
    const auto addSave = [this, saveMenu](const char *name, const QString &iconName, const QString &text, const QString &tip,
                             const QString &shortcut) {
        QAction *action = saveMenu->addAction(icon(iconName), text);
        action->setObjectName(QLatin1String(name));
        action->setToolTip(tip);
        action->setAutoRepeat(false);
        action->setShortcut(QKeySequence(shortcut));
        m_save.push_back(action);
        return action;
    };
    connect(addSave("saveCsvAction", QStringLiteral("csv"), tr("Save plots as CSV…"),
                tr("Save the samples in sight as a CSV file (Ctrl+S)"), QStringLiteral("Ctrl+S")),
        &QAction::triggered, this, &PlotBar::csvRequested);
    connect(addSave("savePictureAction", QStringLiteral("camera"), tr("Save plots as a picture…"),
                tr("Save the plots as a PNG picture (Ctrl+Shift+S)"), QStringLiteral("Ctrl+Shift+S")),
        &QAction::triggered, this, &PlotBar::pictureRequested);
    connect(addSave("saveDrawingAction", QStringLiteral("chart"), tr("Save plots as SVG…"),
                tr("Save the plots as a drawing that stays sharp at any size"), {}),
        &QAction::triggered, this, &PlotBar::drawingRequested);
    addMenu(QStringLiteral("save"), tr("Save"), tr("Save what is seen: samples as CSV, a picture, a drawing"), *saveMenu);
    m_layouts = new QMenu(this);
    addMenu(QStringLiteral("layouts"), tr("Layouts"),
        tr("Arrangements of the plots by name: panels, traces, axes, trigger"), *m_layouts);
    addSeparator();
    QAction *panel =
        add(QStringLiteral("plus"), tr("Add panel"), tr("One more plot below; fields go to the one clicked last"));
    connect(panel, &QAction::triggered, this, &PlotBar::panelRequested);
    m_needTraces = {m_pause, m_cursors, m_trigger, m_clear};
    for (QAction *action : m_save)
        m_needTraces.append(action);
    setHasTraces(false);
}

QAction *PlotBar::add(const QString &iconName, const QString &text, const QString &tip)
{
    QAction *action = addAction(icon(iconName), text);
    action->setToolTip(tip);
    action->setAutoRepeat(false);
    return action;
}

QAction *PlotBar::addMenu(const QString &iconName, const QString &text, const QString &tip, QMenu &menu)
{
    QAction *action = add(iconName, text, tip);
    action->setMenu(&menu);
    if (auto *button = qobject_cast<QToolButton *>(widgetForAction(action)))
        button->setPopupMode(QToolButton::InstantPopup);
    return action;
}

void PlotBar::beOfRecording()
{
    m_pause->setVisible(false);
    m_clear->setVisible(false);
}

void PlotBar::showLive(bool live)
{
    m_pause->setIcon(icon(live ? QStringLiteral("pause") : QStringLiteral("play")));
    m_pause->setText(live ? tr("Pause") : tr("Live"));
    m_pause->setToolTip(live ? tr("Hold the plots still; drag and wheel then move and zoom them (Shift+drag: a box, also while live)")
                             : tr("Follow the newest values again"));
}

void PlotBar::setLive(bool live)
{
    const QSignalBlocker blocker(m_pause);
    m_pause->setChecked(!live);
    showLive(live);
}

void PlotBar::setAutoscale(bool on)
{
    const QSignalBlocker blocker(m_autoscale);
    m_autoscale->setChecked(on);
}

void PlotBar::setCursors(bool on)
{
    const QSignalBlocker blocker(m_cursors);
    m_cursors->setChecked(on);
}

void PlotBar::setTrigger(bool on)
{
    const QSignalBlocker blocker(m_trigger);
    m_trigger->setChecked(on);
}

void PlotBar::setSpan(int seconds)
{
    m_span->setValue(seconds);
}

void PlotBar::setHasTraces(bool has)
{
    for (QAction *action : m_needTraces)
        action->setEnabled(has);
}

} // namespace dynascope
