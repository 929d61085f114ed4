// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/commissioning/commissionround.h"
#include "tests/support/builtincatalog.h"
#include "tests/support/commissionworld.h"
#include "tests/support/testmain.h"

using namespace dynascope;
using namespace Qt::StringLiterals;
using test::CommissionWorld;

namespace {

const QString ThreeNew = u"XM430-W350@57600:1,XM430-W350@1000000:1,XM430-W350@3000000:1"_s;

} // namespace

/// Commissioning that is ended in the middle, or goes on over a bad line, in virtual time.
class TestCommissionFaults : public QObject
{
    Q_OBJECT

private slots:
    void killedAtEachWrite_data()
    {
        QTest::addColumn<bool>("lastGoesOut");
        QTest::newRow("its last packet arrives") << true;
        QTest::newRow("its last packet is lost") << false;
    }
    void killedAtEachWrite()
    {
        QFETCH(bool, lastGoesOut);
        for (int at = 0; at < 20; ++at) {
            CommissionWorld world(m_catalog, u"XM430-W350@57600:1"_s);
            world.want(u"XM430-W350"_s, 11, 2, 1'000'000, {{u"Position P Gain"_s, 640}, {u"Return Delay Time"_s, 0}});
            world.restart(at);
            world.line->setLastGoesOut(lastGoesOut);
            QVERIFY(world.round());
            world.plug(0);
            const auto round = world.round();
            const bool wasKilled = world.line->isDead();
            QCOMPARE(round.has_value(), !wasKilled);
            if (!wasKilled) {
                QVERIFY(at >= 4);
                return;
            }
            world.restart();
            for (int again = 0; again < 3 && world.list.state(0) == CommissionState::Waiting; ++again) {
                const auto next = world.round();
                QVERIFY2(world.problem(next).isEmpty(),
                         qPrintable(u"killed at write %1: %2"_s.arg(at).arg(world.problem(next))));
            }
            QVERIFY2(world.list.state(0) == CommissionState::Done, qPrintable(u"killed at write %1"_s.arg(at)));
            QCOMPARE(world.servo(0).id(), 11);
            QCOMPARE(world.servo(0).baudRate(), 1'000'000);
            QCOMPARE(world.servo(0).value(u"Position P Gain"), 640);
            QCOMPARE(world.servo(0).value(u"Return Delay Time"), 0);
            QVERIFY(!world.plan().file.exists());
        }
        QFAIL("it never came to its end");
    }

    void onABadLine_data()
    {
        QTest::addColumn<sim::LineFaults>("faults");
        using Kind = sim::ReplyFault::Kind;
        const auto add = [](const char *name, Kind kind) {
            sim::LineFaults faults;
            faults.replies = {{.kind = kind, .times = -1, .time = std::chrono::milliseconds(30), .share = 0.05}};
            QTest::newRow(name) << faults;
        };
        add("answers are lost", Kind::Lost);
        add("answers come late", Kind::Late);
        add("answers come damaged", Kind::Damaged);
        add("answers come twice", Kind::Twice);
        add("devices reboot instead of answering", Kind::Reboot);
    }
    void onABadLine()
    {
        QFETCH(sim::LineFaults, faults);
        for (std::uint64_t seed = 1; seed <= 5; ++seed) {
            CommissionWorld world(m_catalog, ThreeNew);
            faults.seed = seed;
            world.bus.setFaults(faults);
            world.want(u"XM430-W350"_s, 11, 3, 1'000'000, {{u"Return Delay Time"_s, 100}});
            while (!world.memory.hasLooked)
                QVERIFY(world.round());
            for (std::size_t i = 0; i < 3; ++i) {
                world.plug(i);
                for (int again = 0; again < 20 && world.list.next() == i; ++again) {
                    const auto round = world.round();
                    QVERIFY2(round, qPrintable(world.problem(round)));
                    for (sim::Servo *servo : world.all)
                        QVERIFY(servo->id() == 1 || (servo->id() >= 11 && servo->id() <= 13));
                }
                QVERIFY2(world.list.next() != i, qPrintable(u"seed %1, joint %2"_s.arg(seed).arg(i)));
                QCOMPARE(world.servo(i).id(), 11 + static_cast<int>(i));
                QCOMPARE(world.servo(i).value(u"Return Delay Time"), 100);
            }
        }
    }

    /// Its plug comes out as it is written to, and goes in again.
    void pulledOutAtEachWrite()
    {
        for (int at = 0; at < 20; ++at) {
            CommissionWorld world(m_catalog, u"XM430-W350@57600:1"_s);
            world.want(u"XM430-W350"_s, 11, 2, 1'000'000, {{u"Position P Gain"_s, 640}, {u"Return Delay Time"_s, 0}});
            world.restart(at);
            world.line->setBefore([&world] { world.servo(0).setPlugged(false); });
            QVERIFY(world.round());
            world.plug(0);
            const auto round = world.round();
            QVERIFY2(round, qPrintable(world.problem(round)));
            if (!world.line->wasReached()) {
                QCOMPARE(round->problem, QString());
                QVERIFY(at >= 4);
                return;
            }
            QVERIFY(!round->problem.isEmpty());
            QVERIFY(world.round()); // nobody is there
            world.plug(0);
            QCOMPARE(world.problem(world.round()), QString());
            QVERIFY2(world.list.state(0) == CommissionState::Done, qPrintable(u"at write %1"_s.arg(at)));
            QCOMPARE(world.servo(0).id(), 11);
            QCOMPARE(world.servo(0).baudRate(), 1'000'000);
            QCOMPARE(world.servo(0).value(u"Position P Gain"), 640);
        }
        QFAIL("it never came to its end");
    }

    /// What can't be set up is tried three times, then left until it was unplugged.
    void triedNoMoreThanThreeTimes()
    {
        CommissionWorld world(m_catalog, u"XM430-W350@57600:1"_s);
        world.want(u"XM430-W350"_s, 11, 1, 1'000'000);
        QVERIFY(world.round());
        world.plug(0);
        world.bus.setFaults({.replies = {{.kind = sim::ReplyFault::Kind::Lost, .times = -1, .share = 0}}});
        int tried = 0;
        for (int i = 0; i < 6; ++i) {
            CommissionHooks hooks;
            hooks.begun = [&](const CommissionWrite &) {
                ++tried;
                world.servo(0).write(u"Torque Enable", 1); // as somebody else's program might
            };
            const auto round = world.round(hooks);
            QVERIFY(round);
            QVERIFY(!round->problem.isEmpty());
            world.servo(0).write(u"Torque Enable", 0);
        }
        QCOMPARE(tried, 3);
        QCOMPARE(world.servo(0).id(), 1);
        world.unplug(0);
        QCOMPARE(world.problem(world.round()), QString());
        world.plug(0);
        QCOMPARE(world.problem(world.round()), QString());
        QVERIFY(world.list.isOver());
    }

    void stopAndCancel()
    {
        CommissionWorld world(m_catalog, u"XM430-W350@57600:1"_s);
        world.want(u"XM430-W350"_s, 11, 1, 1'000'000);
        QVERIFY(world.round());
        world.plug(0);
        world.line->advance(std::chrono::milliseconds(1));
        CommissionHooks hooks;
        hooks.begun = [&world](const CommissionWrite &) { world.stop = true; };
        auto round = world.round(hooks);
        QVERIFY(!round);
        QCOMPARE(round.error().kind, ErrorKind::Stopped);
        QVERIFY(world.writes() <= 1);
        world.stop = false;
        QCOMPARE(world.problem(world.round()), QString());
        QVERIFY(world.list.isOver());
    }

private:
    const Catalog m_catalog = test::builtInCatalog();
};

DYNASCOPE_CORE_TEST(TestCommissionFaults)
#include "tst_commissionfaults.moc"
