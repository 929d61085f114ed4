// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/reopener.h"
#include "core/session/scanner.h"
#include "core/session/session.h"
#include "ui/common/messagebar.h"
#include "ui/common/workbench.h"

#include <QMap>
#include <QSet>

namespace dynascope {

/// Opens and closes lines, scans a line when it first opens, and opens a lost one again once its adapter is back. One
/// line is scanned at a time; others wait for their turn, until STOP.
class Connector : public QObject
{
    Q_OBJECT

public:
    explicit Connector(const Workbench &workbench, QObject *parent = nullptr);

    void connectTo(const QString &port, int baudRate); ///< an open line of that name is left as it is
    void disconnectFrom(LineSession &line);
    void reconnect(LineSession &line);
    void scan(LineSession &line, const ScanRange &range);
    void cancelScan();
    void setReopening(bool byItself); ///< whether lost lines are opened again unasked; remembered

    LineSession *line(const QString &port) const; ///< nullptr where none of that name is open
    LineSession *scannedLine() const { return m_scanned; }

    /// @name What was opened last, for the next start
    /// @{
    static QString lastPort();
    static int lastBaudRate(const QString &port); ///< 57 600, on the simulated bus 1 M, where it never was open
    static QStringList recentPorts(); ///< newest first
    static bool isReopening();
    /// @}

signals:
    void changed(); ///< a line came, went, or is in another state
    void posted(const dynascope::Message &message);
    void retracted(const QString &text);                        ///< what this message said is no longer so
    void retractedTopic(const QString &topic);                  ///< nor is any trouble said of this
    void portsChanged();                                        ///< something was plugged in or pulled out
    void moved(const QString &formerPort, const QString &port); ///< a line's adapter has come back elsewhere

private:
    void follow(LineSession *line);
    void onState(LineSession *line);
    void onOpen(LineSession *line);
    void onLost(LineSession *line);
    void onRefused(LineSession *line);
    void onScanned(int found, const QString &trouble);
    void reportScan(int found, const QString &trouble);
    QString ratesText() const;
    void scanNext();
    void forget(LineSession *line);
    void onBack(LineSession *line, const QString &formerPort);
    static void remember(const QString &port, int baudRate);

    Workbench m_workbench;
    QPointer<LineSession> m_scanned;
    std::vector<int> m_rates; ///< at which it is scanned
    struct Waiting {
        QPointer<LineSession> line;
        ScanRange range;
    };
    std::vector<Waiting> m_waiting;       ///< to be scanned when it is their turn
    QSet<LineSession *> m_opened;         ///< have been open at least once
    QMap<LineSession *, QString> m_lost;  ///< wait for their port, with the words that said they are gone
    QMap<QString, QString> m_refused;     ///< ports that couldn't be opened, with the words that said why
    Reopener m_reopener;
};

} // namespace dynascope
