// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/journal/undosequence.h"
#include "core/session/settings/settingsjournal.h"
#include "tests/support/builtincatalog.h"
#include "tests/support/servoimage.h"
#include "tests/support/settingsworld.h"
#include "tests/support/testmain.h"
#include "tests/support/undoworld.h"

#include <QTemporaryDir>

using namespace dynascope;
using namespace Qt::StringLiterals;
using namespace std::chrono_literals;
using test::MortalLine, test::SettingsWorld;

namespace {

constexpr int Rate = 57600;

/// One servo with gains of its own, writes to it that a journal notes, and their undo.
struct UndoBench : SettingsWorld {
    explicit UndoBench(const Catalog &tables) : SettingsWorld(tables, u"XM430-W350@57600:1"_s), catalog(tables)
    {
        servo().write(u"Position P Gain", 111);
        servo().write(u"Position D Gain", 33);
        servo().write(u"Profile Velocity", 222);
        servo().write(u"Moving Threshold", 44);
        settle();
        before = test::imageOf(bus);
        as.device = journalDevice({1, Rate, static_cast<std::uint16_t>(servo().table().modelNumber()),
                                   static_cast<std::uint8_t>(servo().firmware()), false, {}},
                                  servo().model(), u"sim"_s);
    }

    void settle() { bus.advanceTo(bus.now() + 1s); }
    /// Gains are put back behind a new mode.
    SettingsPlan safeMode(std::int64_t mode) const
    {
        SettingsOptions options;
        options.keepResets = true;
        return *test::planFor(*all.front(), {{u"Operating Mode"_s, mode}}, options);
    }
    SettingsHooks notedIn(Journal &journal) const
    {
        return noted(&journal, as, catalog.find(as.device.modelNumber, as.device.firmware));
    }
    void note(Journal &journal, const QString &name, const Bytes &from, const Bytes &to, std::optional<JournalPlace> moved)
    {
        JournalEntry entry = as;
        const Field *field = servo().table().find(name);
        entry.changes = {changeOf(*field, to)};
        entry.changes.front().before = from;
        const qint64 number = journal.begin(entry);
        entry.state = JournalState::Done;
        entry.movedTo = moved;
        journal.finish(number, entry);
    }
    QString undo(Journal &journal, std::vector<qint64> numbers) ///< empty: done
    {
        MortalLine line(bus, Rate);
        Bus program(line);
        DirectContext context(program);
        UndoSequence sequence(std::move(numbers), Direction::Undo, {true, true});
        while (const auto step = sequence.next(journal.entries(), catalog)) {
            const qint64 number = journal.begin(step->entry);
            const auto result = carryOut(context, *step);
            journal.finish(number, outcomeOf(*step, result));
            sequence.take(*step, result);
        }
        settle();
        return sequence.outcome() ? QString() : sequence.outcome().error().text;
    }
    QString undoAll(Journal &journal)
    {
        std::vector<qint64> numbers;
        for (const JournalEntry &entry : journal.entries()) {
            if (whyNot(journal.entries(), entry.number, Direction::Undo).isEmpty())
                numbers.push_back(entry.number);
        }
        return undo(journal, numbers);
    }
    QStringList changed() const ///< goals follow torque and mode
    {
        QStringList list = test::differences(before, test::imageOf(bus));
        list.removeIf([](const QString &text) { return text.contains(u", Goal "); });
        return list;
    }

    const Catalog &catalog;
    test::ServoImage before;
    JournalEntry as;
};

} // namespace

/// What is undone after the program was killed, and on a line on which answers go wrong.
class TestUndoFaults : public QObject
{
    Q_OBJECT

private slots:
    void aSafeModeChangeKilledAtEachWrite_data()
    {
        QTest::addColumn<QString>("end");
        for (const char *end : {"killed, its last packet arrives", "killed, its last packet is lost",
                                "killed, and the power goes", "the port is lost"})
            QTest::newRow(end) << QString::fromLatin1(end);
    }
    /// Between the new mode and the putting back of what it reset the old gains are nowhere but in the journal.
    void aSafeModeChangeKilledAtEachWrite()
    {
        QFETCH(QString, end);
        for (int at = 0; at < 40; ++at) {
            const QTemporaryDir folder;
            UndoBench bench(m_catalog);
            bool wasKilled = false;
            {
                Journal journal(folder.path());
                MortalLine line(bench.bus, Rate, at);
                line.setLastGoesOut(!end.endsWith(u"lost") || end == u"the port is lost");
                SettingsHooks hooks = bench.notedIn(journal);
                hooks.ended = [&, ended = hooks.ended](const auto &write, const auto &before, const auto &after) {
                    if (!line.isDead() || end == u"the port is lost")
                        ended(write, before, after);
                };
                (void)bench.apply(line, bench.safeMode(1), hooks);
                wasKilled = line.isDead();
                bench.bus.advanceTo(line.now() + 1s);
            }
            if (end.endsWith(u"power goes"))
                bench.servo().powerCycle();
            bench.settle();
            if (at == 0 && !end.endsWith(u"packet is lost"))
                QCOMPARE(bench.servo().value(u"Position P Gain"), 800);
            Journal next(folder.path());
            QCOMPARE(bench.undoAll(next), QString());
            QVERIFY2(bench.changed().isEmpty(),
                     qPrintable(u"killed at write %1: %2"_s.arg(at).arg(bench.changed().join(u"; "))));
            if (!wasKilled) {
                QVERIFY(at > 2);
                return;
            }
        }
        QFAIL("it never came to its end");
    }

    void whatWasWrittenSinceStays()
    {
        const QTemporaryDir folder;
        UndoBench bench(m_catalog);
        {
            Journal journal(folder.path());
            MortalLine line(bench.bus, Rate, 0);
            SettingsHooks hooks = bench.notedIn(journal);
            hooks.ended = {};
            (void)bench.apply(line, bench.safeMode(1), hooks);
            bench.settle();
        }
        Journal next(folder.path());
        QCOMPARE(next.entries().size(), 1U);
        QCOMPARE(next.entries().front().state, JournalState::Begun);
        QVERIFY(bench.apply(*test::planFor(bench.servo(), {{u"Position P Gain"_s, 640}}), bench.notedIn(next)));
        QCOMPARE(bench.undo(next, {1}), QString());
        QCOMPARE(bench.servo().value(u"Operating Mode"), 3);
        QCOMPARE(bench.servo().value(u"Position P Gain"), 640);
        QCOMPARE(bench.servo().value(u"Position D Gain"), 33);
        QCOMPARE(bench.undo(next, {2}), QString()); // to what it was then
        QCOMPARE(bench.servo().value(u"Position P Gain"), 800);
    }

    /// The window, too, notes what a new mode will reset before its packet goes out, and forgets it once it has looked.
    void aWindowsWriteKnowsTheGains()
    {
        test::UndoWorld world(m_catalog, u"XM430-W350@57600:1"_s);
        world.open();
        QVERIFY(world.write(1, u"Position P Gain", 111));
        std::optional<JournalEntry> begun;
        connect(&world.journal, &Journal::entriesChanged, this, [&] {
            if (!begun)
                begun = world.journal.entries().back();
        });
        QVERIFY(world.write(1, u"Operating Mode", 1));
        QVERIFY(begun && begun->state == JournalState::Begun);
        const auto gain = std::ranges::find(begun->changes, u"Position P Gain"_s, &RegisterChange::name);
        QVERIFY(gain != begun->changes.end());
        QCOMPARE(gain->before, (Bytes{111, 0}));
        QVERIFY(gain->after.empty());
        const auto read = journalEntryFromJson(toJson(*begun));
        QVERIFY(read);
        QCOMPARE(read->changes, begun->changes);
        for (const RegisterChange &change : world.journal.entries().back().changes)
            QVERIFY(!change.after.empty());
    }

    void disturbed_data()
    {
        QTest::addColumn<sim::ReplyFault>("fault");
        QTest::addColumn<QString>("what");
        using Kind = sim::ReplyFault::Kind;
        for (const int times : {1, 3}) {
            for (const auto &[name, fault] : std::vector<std::pair<const char *, sim::ReplyFault>>{
                     {"lost", {.kind = Kind::Lost}},
                     {"damaged", {.kind = Kind::Damaged}},
                     {"late", {.kind = Kind::Late, .time = 30ms}},
                     {"cut", {.kind = Kind::Cut, .amount = 5}},
                     {"twice", {.kind = Kind::Twice, .time = 1ms}}}) {
                sim::ReplyFault some = fault;
                some.times = times;
                for (const char *what : {"mode", "ID", "baud rate"})
                    QTest::addRow("%s, %s, %d of them", what, name, times) << some << QString::fromLatin1(what);
            }
        }
    }
    /// Each answer in turn: undone, or an error; no register is at a third value, and the same once more ends well.
    void disturbed()
    {
        QFETCH(sim::ReplyFault, fault);
        QFETCH(QString, what);
        int done = 0, replies = 0;
        {
            UndoBench good(m_catalog);
            Journal journal;
            change(good, journal, what);
            good.bus.setLogging(true);
            good.bus.clearLog();
            QCOMPARE(good.undo(journal, {1}), QString());
            replies = static_cast<int>(std::ranges::count_if(
                good.bus.log(), [](const sim::WireEntry &entry) { return !entry.fromController; }));
        }
        for (int at = 0; at < replies; ++at) {
            UndoBench bench(m_catalog);
            Journal journal;
            change(bench, journal, what);
            const test::ServoImage changed = test::imageOf(bench.bus);
            fault.skip = at;
            bench.bus.setFaults({.replies = {fault}});
            const QString problem = bench.undo(journal, {1});
            done += problem.isEmpty() ? 1 : 0;
            if (problem.isEmpty())
                QCOMPARE(bench.changed(), QStringList());
            for (const auto &[where, raw] : test::imageOf(bench.bus)) {
                QVERIFY2(raw == bench.before.at(where) || raw == changed.at(where),
                         qPrintable(u"%1 is %2 behind answer %3"_s.arg(where.second).arg(raw).arg(at)));
            }
            bench.bus.setFaults({});
            const QString again = problem.isEmpty() ? QString() : bench.undo(journal, {1});
            QVERIFY2(again.isEmpty(), qPrintable(u"behind answer %1: %2; %3"_s.arg(QString::number(at), problem, again)));
            QCOMPARE(bench.changed(), QStringList());
        }
        QVERIFY2(replies > 3, qPrintable(QString::number(replies)));
        QVERIFY(done > 0 || fault.times > 1);
    }

private:
    /// Entry 1 of the journal.
    static void change(UndoBench &bench, Journal &journal, const QString &what)
    {
        if (what == u"mode") {
            SettingsPlan plan = *test::planFor(bench.servo(), {{u"Operating Mode"_s, 1}});
            if (!bench.apply(plan, bench.notedIn(journal)))
                qFatal("the mode");
        } else if (what == u"ID") {
            bench.servo().write(u"ID", 7);
            bench.note(journal, u"ID"_s, {1}, {7}, JournalPlace{7, Rate});
        } else {
            bench.servo().write(u"Baud Rate", 3);
            bench.note(journal, u"Baud Rate"_s, {1}, {3}, JournalPlace{1, 1'000'000});
        }
        bench.settle();
    }

    const Catalog m_catalog = test::builtInCatalog();
};

DYNASCOPE_CORE_TEST(TestUndoFaults)
#include "tst_undofaults.moc"
