// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/ser2net.h"

#include "tests/support/loopbackserver.h"

#include <QDeadlineTimer>
#include <QFile>
#include <QStandardPaths>

#include <csignal>
#ifdef __linux__
#include <sys/prctl.h>
#endif

namespace dynascope::test {

namespace {

constexpr int Patience = 20'000; ///< ms; only a hang takes it

/// It is in a folder that is not everybody's path.
QString program()
{
    const QString here = QStandardPaths::findExecutable(QStringLiteral("ser2net"));
    return here.isEmpty() ? QStandardPaths::findExecutable(
               QStringLiteral("ser2net"), {QStringLiteral("/usr/sbin"), QStringLiteral("/usr/local/sbin")})
                          : here;
}

} // namespace

Ser2net::Ser2net(const QString &device, Kind kind) : m_kind(kind), m_port(LoopbackServer::freePort()), m_device(device)
{
    start();
}

QString Ser2net::address() const
{
    return QStringLiteral("%1://127.0.0.1:%2")
        .arg(m_kind == Kind::Raw ? QStringLiteral("tcp") : QStringLiteral("rfc2217"))
        .arg(m_port);
}

void Ser2net::moveTo(const QString &device)
{
    m_device = device;
}

void Ser2net::start()
{
    if (program().isEmpty())
        qFatal("there is no ser2net; ./dev setup installs it");
    QFile file(m_directory.filePath(QStringLiteral("ser2net.yaml")));
    if (!file.open(QIODevice::WriteOnly))
        qFatal("ser2net has nowhere to read from");
    file.write(QStringLiteral("%YAML 1.1\n---\nconnection: &servos\n  accepter: %1tcp,127.0.0.1,%2\n"
                              "  connector: serialdev(nouucplock=true),%3,57600n81,local\n")
                   .arg(m_kind == Kind::Raw ? QString() : QStringLiteral("telnet(rfc2217),"))
                   .arg(m_port)
                   .arg(m_device)
                   .toUtf8());
    file.close();
    m_process.setStandardErrorFile(QProcess::nullDevice()); // it misses mDNS, which nobody wants here
#ifdef __linux__
    m_process.setChildProcessModifier([] { ::prctl(PR_SET_PDEATHSIG, SIGKILL); }); // also where a test ends badly
#endif
    m_process.start(program(), {QStringLiteral("-n"), QStringLiteral("-c"), file.fileName()});
    if (!m_process.waitForStarted(Patience))
        qFatal("ser2net does not start");
    const QDeadlineTimer limit(Patience);
    while (!LoopbackServer::isListenedAt(m_port)) {
        if (m_process.waitForFinished(10) || limit.hasExpired())
            qFatal("ser2net does not listen");
    }
}

void Ser2net::kill()
{
    m_process.kill();
    m_process.waitForFinished(Patience);
}

} // namespace dynascope::test
