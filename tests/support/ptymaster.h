// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bytes.h"

#include <QString>

/// The other end of a pseudo-terminal: what a serial port's wire is to SerialLine. POSIX.
class PtyMaster
{
public:
    PtyMaster();
    ~PtyMaster() { close(); }
    PtyMaster(const PtyMaster &) = delete;
    PtyMaster &operator=(const PtyMaster &) = delete;

    const QString &path() const { return m_path; } ///< of the port
    void write(const dynascope::Bytes &bytes);
    dynascope::Bytes read(std::size_t bytes); ///< waits for as many, 5 s at most
    int baudRate() const;                     ///< what the port was set to
    void close();                             ///< pulls the plug

    /// What PortGuard says to a program without rights: -1 fine, else the ErrorKind. Needs root.
    int openAsNobody() const;
    void letEverybodyIn();
    void markExclusive(); ///< as a program that is not ours and holds the port
    static bool isRoot();

private:
    int m_master = -1;
    int m_slave = -1; ///< holds marks that end with the last descriptor
    QString m_path;
};
