// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QElapsedTimer>
#include <QPointer>
#include <QWidget>

#include <optional>

class QLabel;

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

protected:
    void changeEvent(QEvent *event) override;

private:
    QLabel *addFigure(const QString &name, const QString &caption, const QString &widest, const QString &tip);
    void update();
    void countDevices();
    void measure(); ///< how much of the time since the last call the wire carried bytes
    void updateErrors();

    QPointer<LineSession> m_line;
    QElapsedTimer m_sinceMeasured;
    quint64 m_bytes = 0; ///< then
    std::optional<double> m_load;
    ElidedLabel *m_name;
    QLabel *m_devices;
    QLabel *m_rate;
    QLabel *m_loadText;
    QLabel *m_errors = nullptr;
};

} // namespace dynascope
