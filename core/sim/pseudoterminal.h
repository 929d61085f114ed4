// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bytes.h"
#include "core/result.h"

#include <memory>

namespace dynascope::sim {

/// The master's side of a raw pseudo-terminal. Keeps the client's side open as well, so that the terminal outlives its
/// clients, and cleans up behind one that is gone. Any one thread.
class PseudoTerminal
{
public:
    /// `link`: see PtyServer::start().
    static Result<std::unique_ptr<PseudoTerminal>> open(const QString &link);
    ~PseudoTerminal(); ///< a client sees the end of its terminal

    const QString &path() const { return m_path; }
    int descriptor() const { return m_master; }      ///< readable: the client has written
    int watchDescriptor() const { return m_watch; }  ///< readable: a client came or went; −1 where nobody tells

    int baudRate() const; ///< the client's
    Bytes read();         ///< what there is, perhaps nothing
    void write(ByteView bytes); ///< what the terminal has no room for is lost, as in a port that nobody reads
    /// Looks who came and went. True where the last client has gone.
    bool noticeClients();
    bool hasClient() const { return m_watch < 0 || m_clients > 0; }

private:
    PseudoTerminal() = default;
    Result<void> openBoth();
    Result<void> makeLink(const QString &link);

    QString m_path, m_link;
    int m_master = -1, m_slave = -1, m_watch = -1;
    int m_clients = 0;
};

} // namespace dynascope::sim
