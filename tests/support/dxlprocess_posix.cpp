// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/dxlprocess.h"

#include <csignal>

namespace dynascope::test {

namespace {

constexpr int Patience = 30'000; ///< ms; long enough for a loaded machine, and only a hang takes it

QString program()
{
    return QStringLiteral(DYNASCOPE_BIN_DIR "/dxl");
}

Outcome outcomeOf(QProcess &process)
{
    Outcome outcome;
    if (process.state() != QProcess::NotRunning && !process.waitForFinished(Patience)) {
        process.kill();
        process.waitForFinished(Patience);
    } else if (process.exitStatus() == QProcess::NormalExit) {
        outcome.code = process.exitCode();
    }
    outcome.out = QString::fromUtf8(process.readAllStandardOutput());
    outcome.err = QString::fromUtf8(process.readAllStandardError());
    return outcome;
}

} // namespace

Outcome dxl(const QStringList &arguments)
{
    QProcess process;
    process.start(program(), arguments);
    Outcome outcome;
    if (process.waitForFinished(Patience) && process.exitStatus() == QProcess::NormalExit)
        outcome.code = process.exitCode();
    else
        process.kill();
    outcome.out = QString::fromUtf8(process.readAllStandardOutput());
    outcome.err = QString::fromUtf8(process.readAllStandardError());
    process.waitForFinished(Patience);
    return outcome;
}

RunningDxl::RunningDxl(const QStringList &arguments)
{
    m_process.start(program(), arguments);
    m_process.waitForStarted(Patience);
}

RunningDxl::~RunningDxl()
{
    if (m_process.state() == QProcess::NotRunning)
        return;
    m_process.kill();
    m_process.waitForFinished(Patience);
}

bool RunningDxl::hasEnded()
{
    return m_process.state() == QProcess::NotRunning || m_process.waitForFinished(0);
}

Outcome RunningDxl::interrupt()
{
    ::kill(static_cast<pid_t>(m_process.processId()), SIGINT);
    return finish();
}

Outcome RunningDxl::finish()
{
    return outcomeOf(m_process);
}

SimProcess::SimProcess(const QString &devices, const QString &link)
{
    QStringList arguments{QStringLiteral("sim"), QStringLiteral("--devices"), devices};
    if (!link.isEmpty())
        arguments << QStringLiteral("--link") << link;
    m_process.start(program(), arguments);
    while (!m_process.canReadLine() && m_process.waitForReadyRead(Patience))
        continue;
    if (m_process.canReadLine())
        m_path = QString::fromUtf8(m_process.readLine()).trimmed();
}

SimProcess::~SimProcess()
{
    if (m_process.state() != QProcess::NotRunning)
        interrupt();
}

QString SimProcess::errors()
{
    return QString::fromUtf8(m_process.readAllStandardError());
}

Outcome SimProcess::dxl(const QStringList &arguments) const
{
    return test::dxl(QStringList{QStringLiteral("--port"), m_path} + arguments);
}

Outcome SimProcess::interrupt()
{
    ::kill(static_cast<pid_t>(m_process.processId()), SIGINT);
    return finish();
}

void SimProcess::kill()
{
    m_process.kill();
    finish();
}

Outcome SimProcess::finish()
{
    return outcomeOf(m_process);
}

} // namespace dynascope::test
