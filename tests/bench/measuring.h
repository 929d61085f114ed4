// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QApplication>
#include <QByteArray>
#include <QElapsedTimer>
#include <QFile>
#include <QMetaObject>
#include <QTemporaryDir>

#include <algorithm>
#include <ctime>

/// What the benchmarks of the window measure by.
namespace dynascope::bench {

/// Where the program keeps what it remembers, while this lives: an empty place, or what another benchmark left would be
/// measured, too. To be made before anything reads settings.
class OwnSettings
{
public:
    OwnSettings()
    {
        if (!m_folder.isValid())
            qFatal("no folder for settings: %s", qPrintable(m_folder.errorString()));
        for (const char *place : {"XDG_CONFIG_HOME", "XDG_DATA_HOME", "XDG_STATE_HOME"})
            qputenv(place, QFile::encodeName(m_folder.path()));
    }

private:
    QTemporaryDir m_folder;
};

/// CPU time so far, ms: CLOCK_THREAD_CPUTIME_ID of the calling thread, CLOCK_PROCESS_CPUTIME_ID of all.
inline double cpuMilliseconds(clockid_t clock = CLOCK_THREAD_CPUTIME_ID)
{
    timespec now{};
    clock_gettime(clock, &now);
    return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
}

inline double memoryMegabytes(const char *key)
{
    QFile status(QStringLiteral("/proc/self/status"));
    if (!status.open(QIODevice::ReadOnly))
        return 0;
    for (const QByteArray &line : status.readAll().split('\n')) {
        if (line.startsWith(key))
            return line.simplified().split(' ').value(1).toDouble() / 1024;
    }
    return 0;
}

/// Events of the GUI thread while it was looked at, by the CPU time their handling took there, ms.
struct EventFigures {
    double longest = 0;
    double longestWall = 0;
    QString longestName;
    quint64 events = 0, over4 = 0, over16 = 0;

    void add(double cpu, double wall, int type, const char *receiver)
    {
        ++events;
        over4 += cpu > 4 ? 1 : 0;
        over16 += cpu > 16 ? 1 : 0;
        longestWall = std::max(longestWall, wall);
        if (cpu > longest) {
            longest = cpu;
            longestName = QStringLiteral("event %1 of %2").arg(type).arg(QString::fromLatin1(receiver));
        }
    }
};

/// Measures each outermost event.
class MeasuringApplication : public QApplication
{
public:
    using QApplication::QApplication;

    bool notify(QObject *receiver, QEvent *event) override
    {
        if (m_depth > 0) {
            const bool handled = QApplication::notify(receiver, event);
            sawInner(receiver, event);
            return handled;
        }
        ++m_depth;
        const int type = event->type();
        const char *name = receiver->metaObject()->className();
        const double begin = cpuMilliseconds();
        QElapsedTimer wall;
        wall.start();
        const bool handled = QApplication::notify(receiver, event);
        const double took = cpuMilliseconds() - begin;
        --m_depth;
        if (type == QEvent::Paint && !firstPaint.isValid())
            firstPaint.start();
        if (measuring)
            figures.add(took, static_cast<double>(wall.nsecsElapsed()) * 1e-6, type, name);
        return handled;
    }

    bool measuring = false;
    EventFigures figures;
    QElapsedTimer firstPaint;

protected:
    virtual void sawInner(QObject *, QEvent *) { } ///< an event was handled within another

private:
    int m_depth = 0;
};

} // namespace dynascope::bench
