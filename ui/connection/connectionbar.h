// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/common/workbench.h"

#include <QToolBar>

class QLabel;
class QProgressBar;
class QPushButton;
class QStackedWidget;
class QToolButton;

namespace dynascope {

class BaudCombo;
class Connector;
class ElidedLabel;
class LineSession;
class PortCombo;
class ScanOptions;
class StopButton;

/// Port, baud, connect, scan, the state in words; at the right STOP, always.
class ConnectionBar : public QToolBar
{
    Q_OBJECT

public:
    ConnectionBar(const Workbench &workbench, Connector &connector, QWidget *parent = nullptr);

    /// The line of the port that is chosen; nullptr where it isn't open.
    LineSession *currentLine() const;
    void setPort(const QString &port, int baudRate);
    void showLine(LineSession &line); ///< chooses its port, unless another is being typed
    void choosePort(); ///< the port is typed over; Return connects
    void showPorts();  ///< opens the list
    QWidget *stopButton() const;

public slots:
    void toggleConnection(); ///< a broken line is opened again
    void disconnectLine();   ///< gives up a broken one too
    void startScan();
    void showScanOptions();

signals:
    void currentLineChanged();

protected:
    void changeEvent(QEvent *event) override;

private:
    void makeButtons();
    void addAll();
    void update();
    QString stateText(const LineSession *line) const;
    void updateScan();
    void onBaudChosen(int bitsPerSecond);
    void onMoved(const QString &formerPort, const QString &port);

    Workbench m_workbench;
    Connector &m_connector;
    PortCombo *m_port;
    QStackedWidget *m_rate; ///< m_baud, or words where it is a server's
    BaudCombo *m_baud;
    QPushButton *m_connect;
    QToolButton *m_disconnect; ///< there while the line is broken, and m_connect says Reconnect
    QPushButton *m_scan;
    QToolButton *m_scanMore;
    QStackedWidget *m_status;
    ElidedLabel *m_state;
    QLabel *m_stateIcon;
    QProgressBar *m_progress;
    QLabel *m_progressText;
    QToolButton *m_cancel;
    ScanOptions *m_options;
    StopButton *m_stop;
    LineSession *m_shown = nullptr; ///< whose baud rate the combo shows; compared only
    int m_shownBaud = 0;
    bool m_isBaudByHand = false; ///< since a port was last picked from the list
};

} // namespace dynascope
