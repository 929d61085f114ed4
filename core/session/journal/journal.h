// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/journal/journalentry.h"
#include "core/session/journal/journalfile.h"

#include <QObject>
#include <QTimer>

#include <deque>
#include <functional>

namespace dynascope {

/// Every write of this program, and of others that use the same folder: in memory, and in files that survive all of
/// them. An entry is noted before the packet goes out, and again with what became of it. Made by app, handed to whoever
/// writes; one thread (the GUI's, or that of `dxl`). A file that can't be written keeps nothing from being written to a
/// device: failed() says so, once.
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
    const QString &problem() const { return m_problem; } ///< why the file isn't written; empty: it is
    void refresh();                                      ///< takes in what other programs have noted meanwhile

    /// Notes what is about to be written and gives it its number and time. A goal that is written again soon after,
    /// with nothing between, continues its entry: a drag is one, from the first old value to the last new one.
    qint64 begin(JournalEntry entry);
    /// Will begin() continue an entry? Then the old value is known.
    bool continues(const JournalDevice &device, const RegisterChange &change) const;
    /// What became of it: state, changes, movedTo and note are taken from `outcome`.
    void finish(qint64 number, const JournalEntry &outcome);
    void flush(); ///< a drag's newest value, which else waits for its end

    void setClock(std::function<QDateTime()> now) { m_now = std::move(now); } ///< for tests

signals:
    void entriesChanged();
    void ended(qint64 number); ///< of this program's: what became of it is known now
    void failed(const QString &why);

private:
    void take(const QByteArray &line);
    void place(JournalEntry entry);
    JournalEntry *find(qint64 number);
    void store(JournalEntry &entry, bool isNew);
    void complain(const Error &error);
    qint64 nextNumber() const { return m_entries.empty() ? 1 : m_entries.back().number + 1; }

    std::function<QDateTime()> m_now;
    QString m_run;
    QString m_problem;
    std::unique_ptr<JournalFile> m_file; ///< nullptr: in memory only
    std::deque<JournalEntry> m_entries;
    qint64 m_drag = 0; ///< the entry that may be continued; 0: none
    bool m_dragUnsaved = false;
    QDateTime m_dragSaved, m_dragAt;
    QTimer m_dragEnd;
};

} // namespace dynascope
