// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QPointer>
#include <QWidget>

class QLabel;
class QToolButton;

namespace dynascope {

class ElidedLabel;
class LineSession;

/// What one line achieves: cycle rate, bus load, errors by kind. Figures have fixed places, so nothing moves.
class StatusView : public QWidget
{
    Q_OBJECT

public:
    explicit StatusView(QWidget *parent = nullptr);

    void setLine(LineSession *line); ///< nullptr: none

signals:
    void ratesRequested(dynascope::LineSession *line, QWidget *over); ///< more of how often is read what

protected:
    void changeEvent(QEvent *event) override;

private:
    QLabel *addFigure(const QString &name, const QString &caption, const QString &widest, const QString &tip);
    void update();
    void countDevices();
    void updateErrors();
    void addRateButton();
    QString rateToolTip() const;

    QPointer<LineSession> m_line;
    ElidedLabel *m_name;
    QLabel *m_devices;
    QLabel *m_rate;
    QToolButton *m_rateButton;
    QLabel *m_load;
    QLabel *m_errors = nullptr;
};

} // namespace dynascope
