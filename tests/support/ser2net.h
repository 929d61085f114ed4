// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QProcess>
#include <QTemporaryDir>

namespace dynascope::test {

/// Debian's ser2net in front of a serial port, at 57 600 bps until told otherwise, listening on loopback for as long as
/// this lives.
class Ser2net
{
public:
    enum class Kind { Raw, Rfc2217 };

    Ser2net(const QString &device, Kind kind);
    ~Ser2net() { kill(); }

    QString address() const;            ///< "tcp://127.0.0.1:40123"
    void start();                       ///< after kill(), at the same address
    void kill();                        ///< as a crash or a power cut would; waits for the end
    void moveTo(const QString &device); ///< what the next start() serves

private:
    QTemporaryDir m_directory;
    Kind m_kind;
    quint16 m_port;
    QString m_device;
    QProcess m_process;
};

} // namespace dynascope::test
