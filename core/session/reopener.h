// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/session.h"

#include <QTimer>

#include <map>

namespace dynascope {

/// Watches which ports there are, and opens a lost line again once its adapter is back: known by its serial number, so
/// that it is found under another name, and another adapter under the old name is left alone. One without a serial
/// number is known by name and kind only: another of its kind is taken for it. A server on the network is asked again
/// after 1, 2, 4... s, then every 30 s. STOP stays as it is. GUI thread.
class Reopener : public QObject
{
    Q_OBJECT

public:
    /// Both outlive this.
    Reopener(Session &session, PortList &ports, QObject *parent = nullptr);

    const std::vector<PortInfo> &ports() const { return m_seen; } ///< as of the last look
    void look();                                                  ///< done by itself once a second

    /// Whether lost lines are opened without being asked; true at first.
    void setAutomatic(bool automatic) { m_automatic = automatic; }
    bool isAutomatic() const { return m_automatic; }

    bool isLost(const LineSession &line) const { return m_lost.contains(&line); }
    /// The name under which this line's adapter is there now. Fails with PortNotFound; with PortUnsuitable where
    /// another adapter has taken its name.
    Result<QString> whereIs(const LineSession &line) const;
    /// At whereIs(). The line's state tells how it went.
    Result<void> reopen(LineSession &line);

signals:
    void portsChanged();
    void lineBack(dynascope::LineSession *line, const QString &formerName);
    /// Its adapter is there, and yet the line can't be opened, again and again: told once.
    void lineRefused(dynascope::LineSession *line, const dynascope::Error &why);

private:
    struct Lost {
        QString name; ///< that it had
        int refusals = 0;
        int looksLeft = 0; ///< until a server on the network is asked again
        int looksNext = 1;
    };
    /// What a line was opened on.
    struct Adapter {
        QString identity;
        QString description;
        bool isLink = false; ///< its name follows the adapter by itself: /dev/serial/by-id/...
    };

    void take(std::vector<PortInfo> ports);
    void follow(LineSession *line);
    void onState(LineSession *line);
    void onRefused(LineSession *line);
    PortInfo infoOf(const QString &name) const;
    bool isSame(const Adapter &adapter, const QString &name) const;
    bool isTurn(const LineSession &line);
    bool isOpenElsewhere(const LineSession &line, const QString &name) const;

    Session &m_session;
    PortList &m_ports;
    std::vector<PortInfo> m_seen;
    std::map<const LineSession *, Adapter> m_adapters; ///< of lines that are or were open
    std::map<const LineSession *, Lost> m_lost;
    bool m_automatic = true;
    QTimer m_timer;
};

} // namespace dynascope
