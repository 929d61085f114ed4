// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/result.h"

#include <QByteArray>

#include <memory>

/// The local socket of a served bus's control channel. For one user alone: mode 0600, and who connects is asked for.
namespace dynascope::sim {

/// Where the socket of this line is: LINK.ctl beside a link; for a bare terminal (/dev/pts/7) pts-7.ctl in the user's
/// runtime folder, or /tmp/dynascope-UID where there is none.
QString controlSocketPath(const QString &linkOrTerminal);

/// The server's end. Removed with it; one that nobody answers at any more is replaced.
class ControlSocket
{
public:
    static Result<std::unique_ptr<ControlSocket>> listen(const QString &path);
    ~ControlSocket();

    int descriptor() const { return m_descriptor; } ///< readable: somebody wants in
    int accept();                                   ///< −1: nobody, or not this user

private:
    ControlSocket() = default;
    QByteArray m_path;
    int m_descriptor = -1;
};

/// Connects to the control channel of a line, sends a line, brings the answer, without its end.
Result<QByteArray> askControl(const QString &linkOrTerminal, const QByteArray &line);

} // namespace dynascope::sim
