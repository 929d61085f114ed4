// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/session.h"

#include <QTimer>
#include <QWidget>

class QLabel;
class QPushButton;
class QVBoxLayout;

namespace dynascope {

/// What the window shows while no line is open: the ports there are now, or the simulated bus.
class WelcomePage : public QWidget
{
    Q_OBJECT

public:
    explicit WelcomePage(PortList &ports, QWidget *parent = nullptr);

signals:
    void choosePortRequested();
    void connectRequested(const QString &port);
    void libraryRequested();

protected:
    void showEvent(QShowEvent *event) override;
    void hideEvent(QHideEvent *event) override;

private:
    void refresh(); ///< looks again while it is shown: a plug makes its port appear
    QPushButton *makeButton(const QString &name, const QString &iconName, const QString &text);

    PortList &m_ports;
    QTimer m_timer;
    QVBoxLayout *m_portButtons;
    std::vector<PortInfo> m_shown;
    QLabel *m_hint;
    QPushButton *m_connect;
    QPushButton *m_simulate;
};

} // namespace dynascope
