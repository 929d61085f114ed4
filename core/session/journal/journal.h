// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/journal/journalahead.h"
#include "core/session/journal/journalentry.h"
#include "core/session/journal/journalfile.h"

#include <QObject>
#include <QTimer>

#include <chrono>
#include <deque>
#include <functional>
#include <map>

namespace dynascope {

/// Every write of this program, and of others that use the same folder: in memory, and in files that survive all of
/// them. An entry is noted before the packet goes out, and again with what became of it. Made by app, handed to whoever
/// writes; one thread (the GUI's, or that of `dxl`). A file that can't be written keeps nothing from being written to a
/// device: failed() says so, once, it is tried again after some seconds, and then gets what has waited.
class Journal : public QObject
{
    Q_OBJECT

public:
    static constexpr std::size_t MostEntries = 20'000; ///< kept in memory, the newest

    enum class Reading {
        All,
        Newest, ///< enough to go on from, for who only adds to it
    };
    /// `folder` empty: in memory only.
    explicit Journal(const QString &folder = {}, Reading reading = Reading::All, const JournalFile::Bounds &bounds = {},
                     QObject *parent = nullptr);
    ~Journal() override;

    /// Where all programs of this project keep theirs, in the user's data.
    static QString usualFolder();

    const std::deque<JournalEntry> &entries() const { return m_entries; } ///< by number
    const JournalEntry *entry(qint64 number) const;
    const QString &run() const { return m_run; }         ///< of this program
    const QString &problem() const { return m_problem; } ///< why the file isn't written now; empty: it is
    /// So long a call may wait for another program that writes just then. 0 where STOP and a screen must not wait: what
    /// finds the file locked is written a moment later.
    void setPatience(std::chrono::milliseconds patience) { m_patience = patience; }
    void refresh();                                      ///< takes in what other programs have noted meanwhile

    /// Notes what is about to be written and gives it its number and time. A goal that is written again soon after,
    /// with nothing but other such goals between, continues its entry: a drag is one, from the first old value to the
    /// last new one, also of several devices at once.
    qint64 begin(JournalEntry entry);
    /// Will begin() continue an entry? Then the old value is known.
    bool continues(const JournalDevice &device, const RegisterChange &change) const;
    /// What became of it: state, changes, movedTo and note are taken from `outcome`.
    void finish(qint64 number, const JournalEntry &outcome);
    /// For one job of a bus thread whose writes are noted here later; what it leaves there is taken in. May be null.
    std::shared_ptr<JournalAhead> ahead() { return m_ahead ? m_ahead->begin() : nullptr; }
    void flush(); ///< the newest values of drags, which else wait for their end

    void setClock(std::function<QDateTime()> now) { m_now = std::move(now); } ///< for tests

signals:
    void entriesChanged();
    void ended(qint64 number); ///< of this program's: what became of it is known now
    void failed(const QString &why);

private:
    struct Drag { ///< an entry that may be continued
        QDateTime at, saved;
        bool isUnsaved = false;
    };
    struct Line { ///< to be written
        qint64 number = 0;
        bool isFresh = false; ///< it is in no file yet: its number may be another program's, too
    };

    void take(const QByteArray &line);
    bool readOthers();
    void renumber(qint64 old, qint64 now);
    void place(JournalEntry entry);
    JournalEntry *find(qint64 number);
    qint64 nowOf(qint64 number) const; ///< of one that begin() gave
    void store(JournalEntry &entry, bool isNew);
    void write(std::chrono::milliseconds patience);
    void writeWaiting();
    void takeIn(const JournalAheadFiles::Over &over);
    void complain(const Error &error);
    bool isOpen(qint64 number) const; ///< a drag that may be continued
    /// The number of the entry that such a write continues; 0: none.
    qint64 dragOf(const JournalDevice &device, const RegisterChange &change) const;
    void dropOldDrags();
    qint64 nextNumber() const { return m_entries.empty() ? 1 : m_entries.back().number + 1; }

    std::function<QDateTime()> m_now;
    QString m_run;
    QString m_problem;
    std::unique_ptr<JournalFile> m_file; ///< nullptr: in memory only
    std::unique_ptr<JournalAheadFiles> m_ahead;
    JournalAheadFiles::Over m_over; ///< to be taken in, or removed once all of it is written
    std::deque<JournalEntry> m_entries;
    std::map<qint64, Drag> m_drags; ///< by the number of their entry
    QTimer m_dragEnd;
    std::chrono::milliseconds m_patience{300}; ///< a line takes less than one
    std::vector<Line> m_waiting;
    std::map<qint64, qint64> m_renumbered; ///< what begin() gave, and another program had taken: what it is now
    QDateTime m_waitingSince, m_triedAt;
    QTimer m_retry;
};

} // namespace dynascope
