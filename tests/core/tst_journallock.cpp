// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/journal/journal.h"
#include "tests/support/testmain.h"

#include <QDir>
#include <QFile>
#include <QLockFile>
#include <QSignalSpy>

#include <thread>

using namespace dynascope;
using namespace Qt::StringLiterals;
using namespace std::chrono_literals;

namespace {

JournalEntry goal(int device, int from, int to)
{
    JournalEntry entry;
    entry.device = {u"/dev/ttyUSB0"_s, u"0403:6014:AB"_s, u"XM430-W350"_s, 1020, 45, device, 57600};
    entry.changes = {{u"Goal Position"_s, 116, false, {std::uint8_t(from), 0, 0, 0}, {std::uint8_t(to), 0, 0, 0}, {}}};
    return entry;
}

JournalEntry led(int to)
{
    JournalEntry entry = goal(1, 0, 0);
    entry.changes = {{u"LED"_s, 65, false, {std::uint8_t(1 - to)}, {std::uint8_t(to)}, {}}};
    return entry;
}

void end(Journal &journal, qint64 number, JournalEntry entry)
{
    entry.state = JournalState::Done;
    entry.changes.front().shown = entry.changes.front().after;
    journal.finish(number, entry);
}

qint64 note(Journal &journal, const JournalEntry &entry)
{
    const qint64 number = journal.begin(entry);
    end(journal, number, entry);
    return number;
}

/// Another program that writes just then, or hangs.
class Holder
{
public:
    explicit Holder(const QString &folder) : m_lock(folder + u"/journal.lock"_s)
    {
        QDir().mkpath(folder);
        if (!m_lock.tryLock(1000))
            qFatal("nobody else holds it");
    }
    void release() { m_lock.unlock(); }

private:
    QLockFile m_lock;
};

std::deque<JournalEntry> onDisk(const QString &folder)
{
    return Journal(folder).entries();
}

} // namespace

/// The journal's file while others have it, and drags of several devices.
class TestJournalLock : public QObject
{
    Q_OBJECT

private slots:
    void severalDraggedTogetherAreOneEntryEach()
    {
        const QTemporaryDir folder;
        Journal journal(folder.path());
        for (int i = 0; i < 20; ++i) {
            const bool isFirst = i == 0;
            for (int device = 1; device <= 3; ++device) {
                QCOMPARE(journal.continues(goal(device, i, i + 1).device, goal(device, i, i + 1).changes.front()),
                         !isFirst);
                note(journal, goal(device, i, i + 1));
            }
        }
        QCOMPARE(journal.entries().size(), 3u);
        for (int device = 1; device <= 3; ++device) {
            QCOMPARE(journal.entry(device)->changes.front().before[0], 0);
            QCOMPARE(journal.entry(device)->changes.front().after[0], 20);
        }
        note(journal, led(1)); // the end of all of them
        QCOMPARE(onDisk(folder.path()), journal.entries());
        for (int device = 1; device <= 2; ++device)
            note(journal, goal(device, 20, 21));
        QCOMPARE(journal.entries().size(), 6u);
    }

    void aLockThatWasHeldOnceIsForgotten()
    {
        const QTemporaryDir folder;
        QDateTime now = QDateTime::fromString(u"2026-01-02T03:04:05.000Z"_s, Qt::ISODateWithMs);
        Journal journal(folder.path());
        journal.setClock([&now] { return now; });
        journal.setPatience(1ms);
        QSignalSpy failed(&journal, &Journal::failed);
        Holder holder(folder.path());
        note(journal, led(1));
        note(journal, led(0));
        QCOMPARE(failed.size(), 1);
        QVERIFY2(journal.problem().contains(u"journal.lock"_s), qPrintable(journal.problem()));
        holder.release();
        now = now.addSecs(6);
        note(journal, led(1));
        QCOMPARE(journal.problem(), QString());
        QCOMPARE(onDisk(folder.path()), journal.entries()); // with what had waited
        QCOMPARE(journal.entries().size(), 3u);
    }

    void whatWaitsIsWrittenAtTheEnd()
    {
        const QTemporaryDir folder;
        Holder holder(folder.path());
        {
            Journal journal(folder.path());
            journal.setPatience(1ms);
            note(journal, led(1));
            holder.release();
        }
        QCOMPARE(onDisk(folder.path()).size(), 1u);
    }

    void whoMayNotWaitWritesAMomentLater()
    {
        const QTemporaryDir folder;
        Journal window(folder.path());
        window.setPatience(0ms);
        const QSignalSpy failed(&window, &Journal::failed);
        Holder holder(folder.path());
        const qint64 number = window.begin(led(1));
        QCOMPARE(number, 1);
        QVERIFY(onDisk(folder.path()).empty());
        holder.release();
        QTRY_COMPARE(onDisk(folder.path()).size(), 1u); // by itself
        end(window, number, led(1));
        QCOMPARE(onDisk(folder.path()), window.entries());
        QVERIFY(failed.isEmpty()); // nothing was lost, nobody is told
    }

    /// Two programs may give the same number where one of them could not look.
    void aNumberThatAnotherProgramTookMeanwhile()
    {
        const QTemporaryDir folder;
        Journal window(folder.path()), dxl(folder.path());
        window.setPatience(0ms);
        Holder holder(folder.path());
        const qint64 mine = window.begin(goal(1, 0, 1)), undo = [&] {
            JournalEntry entry = led(1);
            entry.undoes = mine;
            return window.begin(entry);
        }();
        holder.release();
        note(dxl, led(1)); // before the window comes to it
        QTRY_COMPARE(onDisk(folder.path()).size(), 3u);
        end(window, mine, goal(1, 0, 1));
        JournalEntry outcome = led(1);
        outcome.undoes = mine;
        end(window, undo, outcome);
        QCOMPARE(onDisk(folder.path()), window.entries());
        QCOMPARE(window.entry(1)->run, dxl.run());
        QCOMPARE(window.entry(2)->run, window.run());
        QCOMPARE(window.entry(2)->state, JournalState::Done);
        QCOMPARE(window.entry(2)->changes.front().name, u"Goal Position"_s);
        QCOMPARE(window.entry(3)->undoes, 2);
        dxl.refresh();
        QCOMPARE(dxl.entries(), window.entries());
    }

    /// Even without the lock: the file is only ever added to.
    void twoWritersOverwriteNothing()
    {
        const QTemporaryDir folder;
        constexpr int Lines = 3000;
        const auto write = [&folder](char letter) {
            JournalFile file(folder.path(), {});
            for (int i = 0; i < Lines; ++i)
                (void)file.append(QByteArray(40, letter));
        };
        std::thread other([&] { write('b'); });
        write('a');
        other.join();
        QFile file(folder.filePath(u"journal-000001.jsonl"_s));
        QVERIFY(file.open(QIODevice::ReadOnly));
        QList<QByteArray> lines = file.readAll().split('\n');
        lines.removeAll(QByteArray());
        QCOMPARE(lines.size(), 2 * Lines);
        QCOMPARE(lines.count(QByteArray(40, 'a')), Lines);
        QCOMPARE(lines.count(QByteArray(40, 'b')), Lines);
    }
};

DYNASCOPE_CORE_TEST(TestJournalLock)
#include "tst_journallock.moc"
