// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/builtincatalog.h"
#include "tests/support/moveworld.h"
#include "tests/support/testmain.h"

using namespace dynascope;
using namespace Qt::StringLiterals;
using test::MortalLine, test::MoveWorld;

/// New IDs and baud rates for many, with the servos' power cut anywhere, and with answers that go wrong.
class TestMoveFaults : public QObject
{
    Q_OBJECT

private slots:
    void powerCutAtEachWrite_data()
    {
        QTest::addColumn<std::vector<MovePlace>>("goals");
        QTest::addColumn<bool>("all");
        QTest::addColumn<int>("behind"); // ms; 0: before
        std::vector<MovePlace> fast, ring;
        for (int id = 1; id <= 12; ++id) {
            fast.push_back({4'000'000, id});
            ring.push_back({57600, id % 12 + 1});
        }
        for (const bool all : {true, false}) {
            for (const int behind : {0, 1, 40}) { // before, in its EEPROM's middle, once that is over
                const char *who = all ? "all go off" : "that one blinks", *when = behind == 0 ? "before" : behind == 1 ? "during" : "behind";
                QTest::addRow("57 600 to 4 M, %s %s it", who, when) << fast << all << behind;
                QTest::addRow("renumbering ring, %s %s it", who, when) << ring << all << behind;
            }
        }
    }
    /// The servos lose their power at a write, before it, in its middle or behind it: the same plan once more
    /// ends well.
    void powerCutAtEachWrite()
    {
        QFETCH(std::vector<MovePlace>, goals);
        QFETCH(bool, all);
        QFETCH(int, behind);
        for (int at = 0; at < 100; ++at) {
            MoveWorld world(m_catalog, goals);
            MovePlan plan = world.plan();
            bool wasReached = false;
            {
                MortalLine line(world.bus, 57600, at);
                std::size_t moving = 0;
                MoveHooks hooks;
                hooks.begun = [&moving](const MoveStep &step) { moving = step.device; };
                const auto cut = [&] {
                    line.advance(std::chrono::milliseconds(behind));
                    world.bus.advanceTo(line.now());
                    if (!all)
                        return world.servos[moving]->powerCycle();
                    for (sim::Servo *servo : world.servos)
                        servo->setPlugged(false);
                };
                if (behind > 0)
                    line.setBehind(cut);
                else
                    line.setBefore(cut);
                const Result<void> moved = world.move(line, plan, hooks);
                wasReached = line.wasReached();
                QVERIFY2(moved || wasReached, moved ? "" : qPrintable(moved.error().text));
                QVERIFY(moved || !moved.error().text.isEmpty());
                if (moved)
                    QCOMPARE(world.wrong(), QStringList());
            }
            for (sim::Servo *servo : world.servos)
                servo->setPlugged(true);
            world.settle();
            QCOMPARE(world.strange(plan), QStringList());
            QCOMPARE(world.again(plan), QString());
            QCOMPARE(world.wrong(), QStringList());
            if (!wasReached) {
                QVERIFY(at >= static_cast<int>(goals.size()));
                return;
            }
        }
        QFAIL("it never came to its end");
    }

    void disturbed_data()
    {
        QTest::addColumn<sim::ReplyFault>("fault");
        QTest::addColumn<std::vector<MovePlace>>("goals");
        using Kind = sim::ReplyFault::Kind;
        const std::vector<MovePlace> fast{{4'000'000, 1}, {4'000'000, 2}, {4'000'000, 3}};
        const std::vector<MovePlace> ring{{57600, 2}, {57600, 3}, {57600, 1}};
        const std::vector<MovePlace> both{{1'000'000, 2}, {1'000'000, 1}};
        for (const int times : {1, 3}) {
            for (const auto &[name, fault] : std::vector<std::pair<const char *, sim::ReplyFault>>{
                     {"lost", {.kind = Kind::Lost}},
                     {"damaged", {.kind = Kind::Damaged}},
                     {"late", {.kind = Kind::Late, .time = std::chrono::milliseconds(30)}},
                     {"cut", {.kind = Kind::Cut, .amount = 5}},
                     {"twice", {.kind = Kind::Twice, .time = std::chrono::milliseconds(1)}},
                     {"reboots instead", {.kind = Kind::Reboot}}}) {
                sim::ReplyFault some = fault;
                some.times = times;
                QTest::addRow("57 600 to 4 M, %s, %d of them", name, times) << some << fast;
                QTest::addRow("ring, %s, %d of them", name, times) << some << ring;
                QTest::addRow("swap and new rate, %s, %d of them", name, times) << some << both;
            }
        }
    }
    /// Answers go wrong, each in turn: done, or an error that says what; nobody is lost, and the same plan on a good
    /// line ends well.
    void disturbed()
    {
        QFETCH(sim::ReplyFault, fault);
        QFETCH(std::vector<MovePlace>, goals);
        int done = 0, replies = 0;
        {
            MoveWorld good(m_catalog, goals);
            MovePlan plan = good.plan();
            good.bus.setLogging(true);
            QCOMPARE(good.again(plan), QString());
            replies = good.replies();
        }
        QVERIFY2(replies > 10, qPrintable(QString::number(replies)));
        for (int at = 0; at < replies; ++at) {
            MoveWorld world(m_catalog, goals);
            MovePlan plan = world.plan();
            fault.skip = at;
            world.bus.setFaults({.replies = {fault}});
            {
                MortalLine line(world.bus, 57600);
                const Result<void> moved = world.move(line, plan, {});
                QCOMPARE(line.baudRate(), 57600);
                if (moved)
                    QCOMPARE(world.wrong(), QStringList());
                else
                    QVERIFY(!moved.error().text.isEmpty());
                done += moved ? 1 : 0;
            }
            world.bus.setFaults({});
            world.settle();
            QCOMPARE(world.strange(plan), QStringList());
            const QString again = world.again(plan);
            QVERIFY2(again.isEmpty(), qPrintable(u"behind answer %1: %2"_s.arg(at).arg(again)));
            QCOMPARE(world.wrong(), QStringList());
        }
        if (fault.times == 1 && fault.kind != sim::ReplyFault::Kind::Late && fault.kind != sim::ReplyFault::Kind::Reboot)
            QVERIFY2(2 * done > replies, qPrintable(u"%1 of %2"_s.arg(done).arg(replies)));
    }

private:
    const Catalog m_catalog = test::builtInCatalog();
};

DYNASCOPE_CORE_TEST(TestMoveFaults)
#include "tst_movefaults.moc"
