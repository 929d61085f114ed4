// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/journal/journal.h"
#include "tests/support/testmain.h"

#include <QDir>
#include <QFile>
#include <QSignalSpy>

using namespace dynascope;
using namespace Qt::StringLiterals;

namespace {

JournalEntry writeEntry(const QString &name, int address, Bytes before, Bytes after)
{
    JournalEntry entry;
    entry.device = {u"/dev/ttyUSB0"_s, u"0403:6014:AB"_s, u"XM430-W350"_s, 1020, 45, 1, 57600};
    entry.changes = {{name, static_cast<std::uint16_t>(address), false, std::move(before), std::move(after), {}}};
    return entry;
}

JournalEntry doneWith(const JournalEntry &entry)
{
    JournalEntry outcome = entry;
    outcome.state = JournalState::Done;
    outcome.changes.front().shown = outcome.changes.front().after;
    return outcome;
}

qint64 note(Journal &journal, const JournalEntry &entry)
{
    const qint64 number = journal.begin(entry);
    journal.finish(number, doneWith(entry));
    return number;
}

QStringList filesIn(const QString &folder)
{
    return QDir(folder).entryList({u"journal-*"_s}, QDir::Files, QDir::Name);
}

void append(const QString &path, const QByteArray &text)
{
    QFile file(path);
    QVERIFY(file.open(QIODevice::Append));
    file.write(text);
}

} // namespace

/// Entries as lines, and the files that hold them.
class TestJournal : public QObject
{
    Q_OBJECT

private slots:
    void anEntryIsALine()
    {
        JournalEntry entry = writeEntry(u"Homing Offset"_s, 20, {0, 0, 0, 0}, {0xFE, 0xFF, 0xFF, 0xFF});
        entry.number = 17;
        entry.run = u"r1"_s;
        entry.at = QDateTime::fromString(u"2026-01-02T03:04:05.678Z"_s, Qt::ISODateWithMs);
        entry.by = JournalAuthor::CommandLine;
        entry.state = JournalState::Done;
        entry.changes.front().isSigned = true;
        entry.changes.front().shown = entry.changes.front().after;
        entry.changes.push_back({{}, 224, false, {}, {1, 2, 3, 4, 5}, {}}); // no register, old value not known
        entry.movedTo = JournalPlace{5, 1'000'000};
        entry.note = u"why: \"so\"\n"_s;
        entry.undoes = 3;
        const QByteArray line = toJson(entry);
        QVERIFY(!line.contains('\n'));
        QVERIFY2(line.contains("\"old\":0") && line.contains("\"new\":-2") && line.contains("\"0102030405\""),
                 line.constData());
        const auto read = journalEntryFromJson(line);
        QVERIFY2(read, read ? "" : qPrintable(read.error().text));
        QCOMPARE(*read, entry);
    }

    void badLinesAreRefused_data()
    {
        QTest::addColumn<QByteArray>("line");
        const QByteArray good = goodLine();
        QVERIFY(journalEntryFromJson(good));
        const auto changed = [&good](const char *from, const char *to) {
            QByteArray line = good;
            Q_ASSERT(line.contains(from));
            return line.replace(from, to);
        };
        QTest::newRow("empty") << QByteArray();
        QTest::newRow("noise") << QByteArray("\xFF\x00{}[]", 6);
        QTest::newRow("an array") << QByteArray("[1]");
        QTest::newRow("cut off") << good.left(good.size() / 2);
        QTest::newRow("too long") << QByteArray(good).replace("\"run\":\"", "\"run\":\"" + QByteArray(40'000, 'x'));
        QTest::newRow("deep") << QByteArray(20'000, '[');
        QTest::newRow("another format") << changed("\"v\":1", "\"v\":2");
        QTest::newRow("no number") << changed("\"n\":1", "\"n\":0");
        QTest::newRow("a number beyond all") << changed("\"n\":1", "\"n\":1e18");
        QTest::newRow("half a number") << changed("\"n\":1", "\"n\":1.5");
        QTest::newRow("no known kind") << changed("\"what\":\"write\"", "\"what\":\"burn\"");
        QTest::newRow("no time") << changed("2026-", "20x6-");
        QTest::newRow("an ID beyond all") << changed("\"id\":1", "\"id\":300");
        QTest::newRow("a value beyond its size") << changed("\"new\":3", "\"new\":256");
        QTest::newRow("no value") << changed("\"new\":3", "\"newer\":3");
        QTest::newRow("a size of nothing") << changed("\"size\":1", "\"size\":0");
        QTest::newRow("a size beyond all") << changed("\"size\":1", "\"size\":1e9");
        QTest::newRow("a write of nothing") << changed("\"changes\":", "\"others\":");
        QByteArray many;
        for (int i = 0; i < 200; ++i)
            many += "{\"address\":1,\"size\":1,\"new\":1},";
        QTest::newRow("too many registers") << QByteArray(good).replace("\"changes\":[", "\"changes\":[" + many);
    }
    void badLinesAreRefused()
    {
        QFETCH(QByteArray, line);
        const auto read = journalEntryFromJson(line);
        QVERIFY(!read);
        QCOMPARE(read.error().kind, ErrorKind::BadFile);
    }

    void itSurvivesTheProgram()
    {
        const QTemporaryDir folder;
        std::deque<JournalEntry> kept;
        {
            Journal journal(folder.path());
            QCOMPARE(note(journal, writeEntry(u"LED"_s, 65, {0}, {1})), 1);
            QCOMPARE(journal.begin(writeEntry(u"Operating Mode"_s, 11, {3}, {1})), 2); // and then it was killed
            kept = journal.entries();
        }
        Journal journal(folder.path());
        QCOMPARE(journal.entries(), kept);
        QCOMPARE(journal.entry(2)->state, JournalState::Begun);
        QCOMPARE(note(journal, writeEntry(u"LED"_s, 65, {1}, {0})), 3);
    }

    void aDamagedTailCostsOneLine()
    {
        const QTemporaryDir folder;
        {
            Journal journal(folder.path());
            note(journal, writeEntry(u"LED"_s, 65, {0}, {1}));
        }
        const QString file = folder.filePath(filesIn(folder.path()).constFirst());
        append(file, "{\"v\":1,\"n\":2,\"wh");
        {
            Journal journal(folder.path());
            QCOMPARE(journal.entries().size(), std::size_t(1));
            QCOMPARE(note(journal, writeEntry(u"LED"_s, 65, {1}, {0})), 2);
        }
        append(file, QByteArray("\0\xFF\n\n", 4) + QByteArray(100'000, 'x') + '\n');
        Journal journal(folder.path());
        QCOMPARE(journal.entries().size(), std::size_t(2));
        QCOMPARE(journal.entry(2)->state, JournalState::Done);
        QCOMPARE(note(journal, writeEntry(u"LED"_s, 65, {1}, {0})), 3);
        QCOMPARE(Journal(folder.path()).entries().size(), std::size_t(3));
    }

    void itsSizeIsBounded()
    {
        const QTemporaryDir folder;
        const JournalFile::Bounds bounds{4096, 3, 2048};
        Journal journal(folder.path(), Journal::Reading::All, bounds);
        for (int i = 0; i < 100; ++i)
            note(journal, writeEntry(u"LED"_s, 65, {0}, {1}));
        const QStringList files = filesIn(folder.path());
        QCOMPARE(files.size(), 3);
        for (const QString &file : files)
            QVERIFY(QFile(folder.filePath(file)).size() < 4096 + 2048);
        Journal again(folder.path(), Journal::Reading::All, bounds);
        QCOMPARE(again.entries().back(), journal.entries().back());
        QCOMPARE(again.entries().back().number, 100);
        QVERIFY(again.entries().size() < 40);
    }

    void whoOnlyAddsReadsLittle()
    {
        const QTemporaryDir folder;
        {
            Journal journal(folder.path());
            for (int i = 0; i < 300; ++i)
                note(journal, writeEntry(u"LED"_s, 65, {0}, {1}));
        }
        Journal dxl(folder.path(), Journal::Reading::Newest);
        QVERIFY(dxl.entries().size() < 200);
        QCOMPARE(note(dxl, writeEntry(u"LED"_s, 65, {1}, {0})), 301);
        QCOMPARE(Journal(folder.path()).entries().size(), std::size_t(301));
    }

    void muchNoiseIsPassedOver()
    {
        const QTemporaryDir folder;
        {
            QFile noise(folder.filePath(u"journal-000001.jsonl"_s));
            QVERIFY(noise.open(QIODevice::WriteOnly));
            QVERIFY(noise.resize(100'000'000)); // one line of it
            noise.seek(noise.size());
            noise.write("\n" + goodLine() + "\n");
        }
        QFile::copy(folder.filePath(u"journal-000001.jsonl"_s), folder.filePath(u"journal-elephant.jsonl"_s));
        Journal journal(folder.path());
        QCOMPARE(journal.entries().size(), std::size_t(1));
        QCOMPARE(note(journal, writeEntry(u"LED"_s, 65, {0}, {1})), 2);
        QVERIFY(filesIn(folder.path()).contains(u"journal-000002.jsonl"_s));
    }

    void programsShareIt()
    {
        const QTemporaryDir folder;
        Journal window(folder.path()), dxl(folder.path());
        QVERIFY(window.run() != dxl.run());
        QCOMPARE(note(window, writeEntry(u"LED"_s, 65, {0}, {1})), 1);
        QCOMPARE(note(dxl, writeEntry(u"LED"_s, 65, {1}, {0})), 2);
        QCOMPARE(note(window, writeEntry(u"LED"_s, 65, {0}, {1})), 3);
        dxl.refresh();
        QCOMPARE(dxl.entries(), window.entries());
    }

    void aFolderThatCantBeWritten()
    {
        const QTemporaryDir folder;
        append(folder.filePath(u"file"_s), "x");
        Journal journal(folder.filePath(u"file/below"_s));
        const QSignalSpy failed(&journal, &Journal::failed);
        note(journal, writeEntry(u"LED"_s, 65, {0}, {1}));
        note(journal, writeEntry(u"LED"_s, 65, {1}, {0}));
        QCOMPARE(failed.size(), 1);
        QVERIFY(journal.problem().contains(u"can't be written"_s));
        QCOMPARE(journal.entries().size(), std::size_t(2)); // for as long as the program runs
    }

    /// XL-320: what it follows as a wheel isn't called a goal.
    void aDragOfAWheelIsOneEntry()
    {
        const QTemporaryDir folder;
        Journal journal(folder.path());
        for (std::uint8_t speed = 0; speed < 5; ++speed)
            note(journal, writeEntry(u"Moving Speed"_s, 32, {speed, 0}, {std::uint8_t(speed + 1), 0}));
        QCOMPARE(journal.entries().size(), std::size_t(1));
        QCOMPARE(journal.entry(1)->changes.front().before, Bytes({0, 0}));
    }

    void aDragIsOneEntry()
    {
        const QTemporaryDir folder;
        QDateTime now = QDateTime::fromString(u"2026-01-02T03:04:05.000Z"_s, Qt::ISODateWithMs);
        Journal journal(folder.path());
        journal.setClock([&now] { return now; });
        const auto goal = [&](int from, int to) {
            return writeEntry(u"Goal Position"_s, 116, {std::uint8_t(from), 0, 0, 0}, {std::uint8_t(to), 0, 0, 0});
        };
        QVERIFY(!journal.continues(goal(1, 2).device, goal(1, 2).changes.front()));
        for (int i = 0; i < 60; ++i) {
            note(journal, goal(i, i + 1));
            now = now.addMSecs(33);
        }
        QCOMPARE(journal.entries().size(), std::size_t(1));
        QCOMPARE(journal.entry(1)->changes.front().before, Bytes({0, 0, 0, 0}));
        QCOMPARE(journal.entry(1)->changes.front().after, Bytes({60, 0, 0, 0}));
        QCOMPARE(journal.entry(1)->changes.front().shown, Bytes({60, 0, 0, 0}));
        QVERIFY(QFile(folder.filePath(filesIn(folder.path()).constFirst())).size() < 6 * 500); // not 60 lines
        QVERIFY(Journal(folder.path()).entry(1)->changes.front().after[0] >= 30); // killed now: a second is lost
        JournalEntry refused = goal(60, 200);
        const qint64 number = journal.begin(refused);
        refused.state = JournalState::Failed;
        journal.finish(number, refused);
        QCOMPARE(journal.entry(1)->changes.front().after[0], 60);
        QCOMPARE(journal.entry(1)->state, JournalState::Done);

        note(journal, writeEntry(u"LED"_s, 65, {0}, {1})); // another register: the end of the drag
        QCOMPARE(Journal(folder.path()).entry(1)->changes.front().after[0], 60);
        note(journal, goal(60, 61));
        QCOMPARE(journal.entries().size(), std::size_t(3));
        now = now.addSecs(2);
        note(journal, goal(61, 62)); // another order
        QCOMPARE(journal.entries().size(), std::size_t(4));
        note(journal, goal(62, 63));
        QTRY_COMPARE(Journal(folder.path()).entries().back().changes.front().after[0], 63); // by itself, after a while
    }

    void aDragThatIsInterruptedInFlight_data()
    {
        QTest::addColumn<int>("inFlight");
        QTest::newRow("one write") << 1;
        QTest::newRow("two writes") << 2;
    }
    void aDragThatIsInterruptedInFlight()
    {
        QFETCH(int, inFlight);
        const QTemporaryDir folder;
        Journal journal(folder.path());
        const auto goal = [](std::uint8_t from, std::uint8_t to) {
            return writeEntry(u"Goal Position"_s, 116, {from, 0, 0, 0}, {to, 0, 0, 0});
        };
        note(journal, goal(0, 1));
        for (int i = 1; i <= inFlight; ++i)
            QCOMPARE(journal.begin(goal(std::uint8_t(i), std::uint8_t(i + 1))), 1);
        const qint64 other = journal.begin(writeEntry(u"LED"_s, 65, {0}, {1})); // STOP, another device, a click
        for (int i = 1; i <= inFlight; ++i)
            journal.finish(1, doneWith(goal(std::uint8_t(i), std::uint8_t(i + 1))));
        journal.finish(other, doneWith(writeEntry(u"LED"_s, 65, {0}, {1})));
        QCOMPARE(journal.entry(1)->changes.front().before, Bytes({0, 0, 0, 0}));
        QCOMPARE(journal.entry(1)->changes.front().after[0], inFlight + 1);
        QCOMPARE(Journal(folder.path()).entries(), journal.entries());
    }

    void aLeapOfNumbersIsDamage()
    {
        const QTemporaryDir folder;
        Journal journal(folder.path());
        note(journal, writeEntry(u"LED"_s, 65, {0}, {1}));
        append(folder.filePath(u"journal-000001.jsonl"_s), goodLine().replace("\"n\":1", "\"n\":1000000000") + '\n');
        QCOMPARE(note(journal, writeEntry(u"LED"_s, 65, {1}, {0})), 2);
        QCOMPARE(Journal(folder.path()).entries(), journal.entries());
    }

    void whatWasRemovedIsReadAnew_data()
    {
        QTest::addColumn<bool>("isRemoved");
        QTest::newRow("removed") << true;
        QTest::newRow("cut off") << false;
    }
    void whatWasRemovedIsReadAnew()
    {
        QFETCH(bool, isRemoved);
        const QTemporaryDir folder;
        const JournalFile::Bounds bounds{2048, 3, 2048};
        Journal window(folder.path(), Journal::Reading::All, bounds);
        for (int i = 0; i < 10; ++i)
            note(window, writeEntry(u"LED"_s, 65, {0}, {1}));
        for (const QString &file : filesIn(folder.path())) {
            QVERIFY(isRemoved ? QFile::remove(folder.filePath(file)) : QFile::resize(folder.filePath(file), 0));
        }
        append(folder.filePath(isRemoved ? u"journal-000001.jsonl"_s : filesIn(folder.path()).constLast()),
               goodLine().replace("\"n\":1", "\"n\":11") + '\n');
        window.refresh();
        QCOMPARE(window.entries().size(), std::size_t(11));
    }

private:
    static QByteArray goodLine()
    {
        JournalEntry entry = writeEntry(u"Operating Mode"_s, 11, {1}, {3});
        entry.number = 1;
        entry.at = QDateTime::fromString(u"2026-01-02T03:04:05.678Z"_s, Qt::ISODateWithMs);
        return toJson(entry);
    }
};

DYNASCOPE_CORE_TEST(TestJournal)
#include "tst_journal.moc"
