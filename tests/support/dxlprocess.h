// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QProcess>
#include <QStringList>
#include <QTemporaryDir>

namespace dynascope::test {

/// How a run of `dxl` ended.
struct Outcome {
    int code = -1; ///< −1: it didn't start, hung, or was killed
    QString out;
    QString err;
};

/// Runs build/bin/dxl until it ends.
Outcome dxl(const QStringList &arguments);

/// `dxl` while it runs; killed where nobody waited for its end.
class RunningDxl
{
public:
    explicit RunningDxl(const QStringList &arguments);
    ~RunningDxl();

    qint64 processId() const { return m_process.processId(); } ///< 0: it ended
    bool hasEnded();
    Outcome interrupt(); ///< as Ctrl-C does; waits for the end
    Outcome finish();    ///< waits for the end

private:
    QProcess m_process;
};

/// `dxl sim` in a process of its own, for as long as this lives.
class SimProcess
{
public:
    /// Returns when the terminal's path has been printed; path() is empty where that didn't happen.
    explicit SimProcess(const QString &devices, const QString &link = {});
    ~SimProcess();

    QString path() const { return m_path; }
    QString errors();

    Outcome dxl(const QStringList &arguments) const; ///< with --port PATH in front
    Outcome interrupt();                             ///< as Ctrl-C does; waits for the end
    void kill();                                     ///< without a chance to tidy up; waits for the end

private:
    Outcome finish();

    QProcess m_process;
    QString m_path;
};

} // namespace dynascope::test
