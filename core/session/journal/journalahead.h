// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/journal/journalentry.h"

#include <QLockFile>

#include <functional>
#include <memory>

namespace dynascope {

/// What a job of the bus thread is about to write, noted by that thread itself in a file of its own beside the journal:
/// the journal hears of it by way of the GUI thread, and the program may be killed before. Made by Journal, handed to
/// one job.
class JournalAhead
{
public:
    JournalAhead(const QString &folder, const QString &run, int job);

    /// Gives it its key, by which the journal knows it again. With the system when this returns, so that killing the
    /// program loses nothing; the power of the computer may take what it has not put on the disk yet. Waits for nobody.
    /// Where it can't be written the job goes on: the journal says so. The job's thread.
    QString append(JournalEntry entry);

    const QString &path() const { return m_path; } ///< there once something was appended

private:
    QString m_path, m_run;
    int m_job = 0;
    int m_count = 0;
};

/// Such files in the journal's folder. Each program holds a lock while it lives, so that the next one knows whose
/// nobody will put into the journal any more. The journal's thread.
class JournalAheadFiles
{
public:
    struct Over { ///< nobody adds to them
        QStringList paths;
        std::vector<std::unique_ptr<QLockFile>> locks; ///< of programs that have died
    };
    JournalAheadFiles(QString folder, QString run);

    std::shared_ptr<JournalAhead> begin();
    Over left() const; ///< by programs that have died
    Over ended();      ///< of this program's jobs: nobody else has what begin() gave
    Over all();        ///< of this program, at its end

    static void read(const Over &over, const std::function<void(JournalEntry entry)> &take);
    static void remove(const Over &over);

private:
    Over takeOut(const std::function<bool(const std::shared_ptr<JournalAhead> &)> &isOver);
    QString lockPath(const QString &run) const;

    QString m_folder, m_run;
    std::unique_ptr<QLockFile> m_lock; ///< from the first job on
    std::vector<std::shared_ptr<JournalAhead>> m_jobs;
    int m_count = 0;
};

} // namespace dynascope
