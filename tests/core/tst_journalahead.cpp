// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/settingscommands.h"
#include "tests/support/builtincatalog.h"
#include "tests/support/settingsworld.h"
#include "tests/support/testmain.h"

#include <QDir>
#include <QSemaphore>
#include <QTemporaryDir>

#include <set>

using namespace dynascope;
using namespace Qt::StringLiterals;
using namespace std::chrono_literals;

namespace {

constexpr int Rate = 57600;

bool isWrite(ByteView packet)
{
    return packet.size() > 7 && packet[7] == 0x03;
}

/// The files as a program that is killed now leaves them: its locks count no more.
void copyFiles(const QString &from, const QString &to)
{
    QDir().mkpath(to);
    for (const QString &name : QDir(from).entryList({u"*.jsonl"_s}, QDir::Files))
        QFile::copy(from + u'/' + name, to + u'/' + name);
}

QStringList aheadFiles(const QString &folder)
{
    return QDir(folder).entryList({u"ahead-*"_s}, QDir::Files);
}

JournalEntry writeTo(int id, std::uint8_t raw)
{
    JournalEntry entry;
    entry.device = {u"virtual"_s, {}, u"XM430-W350"_s, 1020, 45, id, Rate};
    entry.changes = {{u"Return Delay Time"_s, 9, false, {250}, {raw}, {}}};
    return entry;
}

/// A session whose device gets four settings in one job, and the journal in a folder.
struct JobWorld {
    explicit JobWorld(const Catalog &catalog)
        : journal(folder.path()), all(catalog, u"XM430-W350@57600:1"_s, &journal), settings(all.session, all.commands)
    {
        journal.setPatience(0ms);
        all.open(Rate);
        device = all.line->deviceAt(1, Rate);
        std::optional<Result<void>> read;
        all.commands.readAll(*device, [&](const Result<void> &result) { read = result; });
        VirtualSession::waitFor([&] { return read.has_value(); });
    }
    void start()
    {
        const test::Wanted wanted{{u"Return Delay Time"_s, 10},
                                  {u"Homing Offset"_s, 77},
                                  {u"Moving Threshold"_s, 11},
                                  {u"Profile Velocity"_s, 40}};
        settings.apply(*device, test::wantedOf(device->table(), wanted), {},
                       [this](const Result<SettingsOutcome> &result) { outcome = result; });
    }
    bool waitForEnd()
    {
        return VirtualSession::waitFor([this] { return outcome.has_value(); });
    }

    static constexpr int Writes = 4;
    QTemporaryDir folder;
    Journal journal;
    VirtualSession all;
    SettingsCommands settings;
    Device *device = nullptr;
    std::optional<Result<SettingsOutcome>> outcome;
};

} // namespace

/// Writes of a job are in a file before they are on the wire, though the GUI thread hears of them later.
class TestJournalAhead : public QObject
{
    Q_OBJECT

private slots:
    /// The GUI thread hears of nothing until all is over: whenever the program is killed, the next start knows what it
    /// wrote, and what that replaced.
    void killedAtEveryWrite()
    {
        JobWorld world(m_catalog);
        QTemporaryDir killed;
        QSemaphore written;
        int count = 0;
        world.all.factory.onPacket = [&](int, ByteView packet) {
            if (!isWrite(packet))
                return;
            ++count;
            copyFiles(world.folder.path(), killed.filePath(QString::number(count)));
            written.release();
        };
        world.start();
        QVERIFY(written.tryAcquire(JobWorld::Writes, 10'000));
        for (int writes = 1; writes <= JobWorld::Writes; ++writes) {
            const QString folder = killed.filePath(QString::number(writes));
            const Journal next(folder);
            QCOMPARE(next.entries().size(), std::size_t(writes));
            const JournalEntry &last = next.entries().back();
            QCOMPARE(last.state, JournalState::Begun);
            QCOMPARE(last.number, writes);
            QCOMPARE(last.device.id, 1);
            QVERIFY(!last.changes.front().before.empty());
            QVERIFY(last.changes.front().before != last.changes.front().after);
            QVERIFY(aheadFiles(folder).isEmpty());
            QCOMPARE(Journal(folder).entries().size(), std::size_t(writes)); // taken in once
        }
        QVERIFY(world.waitForEnd());
    }

    void everyWriteOnceInTheEnd()
    {
        JobWorld world(m_catalog);
        world.start();
        QVERIFY(world.waitForEnd());
        QVERIFY(*world.outcome && (*world.outcome)->isDone());
        QCOMPARE(world.journal.entries().size(), std::size_t(JobWorld::Writes));
        for (const JournalEntry &entry : world.journal.entries())
            QCOMPARE(entry.state, JournalState::Done);
        world.outcome.reset();
        const Journal other(world.folder.path()); // beside a program that lives
        QCOMPARE(other.entries().size(), std::size_t(JobWorld::Writes));
        world.journal.begin(writeTo(1, 5)); // the job is over: its file goes with the next entry
        QCOMPARE(aheadFiles(world.folder.path()).filter(u".jsonl"_s), QStringList());
    }

    /// What another program has under way is that one's to note.
    void aLivingProgramKeepsItsOwn()
    {
        QTemporaryDir folder;
        Journal first(folder.path());
        const auto ahead = first.ahead();
        JournalEntry entry = writeTo(1, 7);
        entry.ahead = ahead->append(entry);
        QVERIFY(Journal(folder.path()).entries().empty());
        first.begin(entry);
        Journal second(folder.path());
        QCOMPARE(second.entries().size(), std::size_t(1));
    }

    /// Two lines, and `dxl` beside them, at once: each writes to a file of its own.
    void twoJobsAndAnotherProgram()
    {
        QTemporaryDir folder, killed;
        Journal window(folder.path());
        Journal other(folder.path(), Journal::Reading::Newest);
        const auto one = window.ahead(), two = window.ahead();
        JournalEntry noted = writeTo(1, 1);
        noted.ahead = one->append(noted);
        window.begin(noted);
        two->append(writeTo(2, 2));
        other.begin(writeTo(3, 3));
        one->append(writeTo(1, 4));
        copyFiles(folder.path(), killed.path());
        QFile half(QDir(killed.path()).filePath(QFileInfo(two->path()).fileName()));
        QVERIFY(half.open(QIODevice::Append));
        half.write("{\"v\":1,\"n\":2,\"ru"); // the computer's power failed
        half.close();
        const Journal next(killed.path(), Journal::Reading::Newest);
        std::multiset<int> ids;
        for (const JournalEntry &entry : next.entries())
            ids.insert(entry.device.id);
        QCOMPARE(ids, (std::multiset<int>{1, 1, 2, 3}));
        QVERIFY(aheadFiles(killed.path()).isEmpty());
    }

    /// Its line was closed before the GUI thread heard of it.
    void aJobThatNobodyHeardOf()
    {
        QTemporaryDir folder;
        {
            Journal journal(folder.path());
            journal.ahead()->append(writeTo(1, 7));
            journal.begin(writeTo(2, 8));
            QCOMPARE(journal.entries().size(), std::size_t(2));
            const auto held = journal.ahead();
            held->append(writeTo(3, 9));
        }
        QVERIFY(aheadFiles(folder.path()).isEmpty());
        QCOMPARE(Journal(folder.path()).entries().size(), std::size_t(3));
    }

private:
    const Catalog m_catalog = test::builtInCatalog();
};

DYNASCOPE_CORE_TEST(TestJournalAhead)
#include "tst_journalahead.moc"
