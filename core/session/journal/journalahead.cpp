// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/journal/journalahead.h"

#include <QDir>
#include <QFile>

#include <map>

namespace dynascope {
namespace {

constexpr qint64 LargestAhead = 16 * 1024 * 1024; ///< a job writes a few hundred lines

} // namespace

JournalAhead::JournalAhead(const QString &folder, const QString &run, int job)
    : m_path(QStringLiteral("%1/ahead-%2-%3.jsonl").arg(folder, run).arg(job)), m_run(run), m_job(job)
{
}

QString JournalAhead::append(JournalEntry entry)
{
    entry.number = ++m_count; // the journal gives it another
    entry.run = m_run;
    entry.at = QDateTime::currentDateTimeUtc();
    entry.ahead = QStringLiteral("%1.%2").arg(m_job).arg(m_count);
    QFile file(m_path);
    if (file.open(QIODevice::WriteOnly | QIODevice::Append | QIODevice::Unbuffered))
        file.write(toJson(entry) + '\n');
    return entry.ahead;
}

JournalAheadFiles::JournalAheadFiles(QString folder, QString run) : m_folder(std::move(folder)), m_run(std::move(run))
{
}

QString JournalAheadFiles::lockPath(const QString &run) const
{
    return QStringLiteral("%1/ahead-%2.lock").arg(m_folder, run);
}

std::shared_ptr<JournalAhead> JournalAheadFiles::begin()
{
    if (!m_lock && QDir().mkpath(m_folder)) {
        m_lock = std::make_unique<QLockFile>(lockPath(m_run));
        m_lock->setStaleLockTime(0); // however long we live
        m_lock->tryLock(0);
    }
    m_jobs.push_back(std::make_shared<JournalAhead>(m_folder, m_run, ++m_count));
    return m_jobs.back();
}

JournalAheadFiles::Over JournalAheadFiles::left() const
{
    std::map<QString, QStringList> byRun;
    const QDir folder(m_folder);
    for (const QString &name : folder.entryList({QStringLiteral("ahead-*-*.jsonl")}, QDir::Files)) {
        const QString run = name.section(QLatin1Char('-'), 1, 1);
        if (run != m_run)
            byRun[run] << folder.filePath(name);
    }
    Over over;
    for (const auto &[run, paths] : byRun) {
        auto lock = std::make_unique<QLockFile>(lockPath(run));
        lock->setStaleLockTime(0);
        if (!lock->tryLock(0))
            continue; // it lives
        over.paths += paths;
        over.locks.push_back(std::move(lock));
    }
    return over;
}

JournalAheadFiles::Over JournalAheadFiles::ended()
{
    return takeOut([](const std::shared_ptr<JournalAhead> &job) { return job.use_count() == 1; });
}

JournalAheadFiles::Over JournalAheadFiles::all()
{
    return takeOut([](const std::shared_ptr<JournalAhead> &) { return true; });
}

JournalAheadFiles::Over
JournalAheadFiles::takeOut(const std::function<bool(const std::shared_ptr<JournalAhead> &)> &isOver)
{
    Over over;
    std::erase_if(m_jobs, [&](const std::shared_ptr<JournalAhead> &job) {
        const bool ended = isOver(job);
        if (ended && QFile::exists(job->path()))
            over.paths << job->path();
        return ended;
    });
    return over;
}

void JournalAheadFiles::read(const Over &over, const std::function<void(JournalEntry)> &take)
{
    for (const QString &path : over.paths) {
        QFile file(path);
        if (!file.open(QIODevice::ReadOnly))
            continue;
        const QList<QByteArray> lines = file.read(LargestAhead).split('\n');
        for (const QByteArray &line : lines) {
            if (auto entry = journalEntryFromJson(line); entry && !entry->ahead.isEmpty())
                take(std::move(*entry));
        }
    }
}

void JournalAheadFiles::remove(const Over &over)
{
    for (const QString &path : over.paths)
        QFile::remove(path);
}

} // namespace dynascope
