// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QSpinBox>
#include <QToolBar>

#include <chrono>
#include <vector>

class QMenu;

namespace dynascope {

/// Whole seconds; the arrows go to the next round number.
class SpanBox : public QSpinBox
{
    Q_OBJECT

public:
    explicit SpanBox(QWidget *parent = nullptr);

    void stepBy(int steps) override;
    /// The round span so many steps away.
    static std::chrono::seconds stepped(std::chrono::nanoseconds span, int steps);
    QValidator::State validate(QString &text, int &position) const override;
    void fixup(QString &text) const override;

private:
    QString digitsOf(const QString &text) const; ///< without the unit
    bool isDigits(const QString &text) const;
};

/// The tool bar above the plots. Announces what the person wants; shows what it is told.
class PlotBar : public QToolBar
{
    Q_OBJECT

public:
    explicit PlotBar(QWidget *parent = nullptr);

    void setLive(bool live);
    void setAutoscale(bool on);
    int span() const { return m_span->value(); }
    void setSpan(int seconds);
    void stepSpan(int steps) { m_span->stepBy(steps); }
    void setCursors(bool on);
    void setTrigger(bool on);
    void setHasTraces(bool has);
    void beOfRecording(); ///< nothing is live, and nothing to be forgotten
    const std::vector<QAction *> &saveActions() const { return m_save; }
    QMenu &layouts() const { return *m_layouts; } ///< filled by who knows them

signals:
    void liveChanged(bool live);
    void spanChanged(int seconds);
    void autoscaleChanged(bool on);
    void cursorsChanged(bool on);
    void triggerChanged(bool on);
    void triggerSettingsRequested();
    void clearRequested();
    void csvRequested();
    void pictureRequested();
    void drawingRequested();
    void panelRequested();

private:
    QAction *add(const QString &iconName, const QString &text, const QString &tip);
    QAction *addMenu(const QString &iconName, const QString &text, const QString &tip, QMenu &menu);
    void showLive(bool live);

    SpanBox *m_span;
    QMenu *m_layouts;
    QAction *m_pause;
    QAction *m_clear;
    QAction *m_autoscale;
    QAction *m_cursors;
    QAction *m_trigger;
    std::vector<QAction *> m_save;
    QList<QAction *> m_needTraces;
};

} // namespace dynascope
