// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/commissioning/commissionjournal.h"
#include "core/session/commissioning/identify.h"
#include "tests/support/builtincatalog.h"
#include "tests/support/commissionworld.h"
#include "tests/support/testmain.h"

using namespace dynascope;
using namespace Qt::StringLiterals;
using test::CommissionWorld;

namespace {

const QString ThreeNew = u"XM430-W350@57600:1,XM430-W350@1000000:1,XM430-W350@3000000:1"_s;

} // namespace

/// New servos plugged in one after the other, on a simulated bus in virtual time.
class TestCommissioning : public QObject
{
    Q_OBJECT

private slots:
    void oneAfterTheOther_data()
    {
        QTest::addColumn<bool>("chain");
        QTest::newRow("the chain grows") << true;
        QTest::newRow("one at a time") << false;
    }
    void oneAfterTheOther()
    {
        QFETCH(bool, chain);
        CommissionWorld world(m_catalog, ThreeNew);
        world.want(u"XM430-W350"_s, 11, 3, 1'000'000, {{u"Position P Gain"_s, 640}, {u"Return Delay Time"_s, 0}});
        auto round = world.round();
        QVERIFY2(round, qPrintable(world.problem(round)));
        QVERIFY(round->heard.empty());
        for (std::size_t i = 0; i < 3; ++i) {
            QCOMPARE(world.list.next(), i);
            world.plug(i);
            round = world.round();
            QVERIFY2(round, qPrintable(world.problem(round)));
            QCOMPARE(round->problem, QString());
            QCOMPARE(round->ticked, std::vector{i});
            const int id = 11 + static_cast<int>(i);
            QCOMPARE(world.servo(i).id(), id);
            QCOMPARE(world.servo(i).baudRate(), 1'000'000);
            QCOMPARE(world.servo(i).value(u"Position P Gain"), 640);
            QCOMPARE(world.servo(i).value(u"Return Delay Time"), 0);
            QCOMPARE(world.list.facts(i).place, (MovePlace{1'000'000, id}));
            QCOMPARE(world.list.facts(i).foundAt.id, 1);
            QVERIFY(!world.list.facts(i).wasSo);
            if (!chain)
                world.unplug(i);
            round = world.round(); // nobody is touched again
            QVERIFY2(round, qPrintable(world.problem(round)));
            QCOMPARE(round->problem, QString());
            QCOMPARE(world.writes(), 0);
        }
        QVERIFY(world.list.isOver());
        QVERIFY(!world.plan().file.exists());
        QCOMPARE(labelsCsv(world.list, m_catalog).count('\n'), 4);
    }

    void nothingIsWritten_data()
    {
        QTest::addColumn<QString>("servos");
        QTest::addColumn<int>("first"); ///< so many are ticked off or there before
        QTest::addColumn<QString>("says");
        QTest::newRow("two alike") << u"XM430-W350@57600:1,XM430-W350@57600:1"_s << 0 << u"two servos at once"_s;
        QTest::newRow("two models under one ID")
            << u"XM430-W350@57600:1,XL430-W250@57600:1"_s << 0 << u"two servos at once"_s;
        QTest::newRow("two IDs") << u"XM430-W350@57600:1,XM430-W350@57600:2"_s << 0 << u"2 new servos at once"_s;
        QTest::newRow("two baud rates") << u"XM430-W350@57600:1,XM430-W350@2000000:1"_s << 0
                                        << u"2 new servos at once"_s;
        QTest::newRow("three") << u"XM430-W350@57600:1,XM430-W350@57600:1,XM430-W350@57600:1"_s << 0
                               << u"two servos at once"_s;
        QTest::newRow("one with the place of one ticked off")
            << u"XM430-W350@57600:1,XM430-W350@1000000:11"_s << 1 << u"two servos at once"_s;
        QTest::newRow("wrong model") << u"XL430-W250@57600:1"_s << 0
                                     << u"this is model XL430-W250, and joint0 (ID 11) shall be model XM430-W350"_s;
        QTest::newRow("firmware too old") << u"XM430-W350/41@57600:1"_s << 0 << u"has firmware 41"_s;
    }
    void nothingIsWritten()
    {
        QFETCH(QString, servos);
        QFETCH(int, first);
        QFETCH(QString, says);
        CommissionWorld world(m_catalog, servos);
        world.want(u"XM430-W350"_s, 11, 3, 1'000'000, {}, 44);
        QVERIFY(world.round());
        for (std::size_t i = 0; i < world.all.size(); ++i) {
            world.plug(i);
            if (static_cast<int>(i) < first)
                QCOMPARE(world.problem(world.round()), QString());
        }
        const auto round = world.round();
        QVERIFY2(round, qPrintable(world.problem(round)));
        QVERIFY2(round->problem.contains(says), qPrintable(round->problem));
        QVERIFY2(round->problem.endsWith(u"nothing was written"), qPrintable(round->problem));
        QCOMPARE(world.writes(), 0);
        QCOMPARE(round->ticked, std::vector<std::size_t>());
        QVERIFY(!round->hasWritten);
        // One of them is taken away again: it goes on.
        for (std::size_t i = world.all.size(); i-- > static_cast<std::size_t>(first) + 1;)
            world.unplug(i);
        const auto after = world.round();
        const bool isWrong = world.all.size() == 1;
        const bool wasTicked = first == 1;
        if (wasTicked)
            world.unplug(1);
        QCOMPARE(after && !after->ticked.empty(), !isWrong && !wasTicked);
    }

    void anIdThatIsTaken()
    {
        CommissionWorld world(m_catalog, u"XL430-W250@1000000:11,XM430-W350@57600:1"_s);
        world.want(u"XM430-W350"_s, 11, 2, 1'000'000);
        world.plug(0); // of the robot, before commissioning begins
        auto round = world.round();
        QCOMPARE(world.problem(round), QString());
        QCOMPARE(world.memory.bystanders.size(), std::size_t(1));
        world.plug(1);
        round = world.round();
        QVERIFY(world.problem(round).contains(u"would both have ID 11 at 1000000 bps"));
        QCOMPARE(world.writes(), 0);
        QCOMPARE(world.servo(1).id(), 1);
    }

    void whoWasThereBeforeIsLeftAlone()
    {
        CommissionWorld world(m_catalog, u"XM430-W350@57600:1"_s);
        world.want(u"XM430-W350"_s, 11, 1, 1'000'000);
        world.plug(0);
        for (int i = 0; i < 2; ++i) {
            QCOMPARE(world.problem(world.round()), QString());
            QCOMPARE(world.writes(), 0);
        }
        QCOMPARE(world.memory.bystanders.size(), std::size_t(1));
        world.unplug(0); // and plugged in again it is the new one
        QVERIFY(world.round());
        world.plug(0);
        QCOMPARE(world.problem(world.round()), QString());
        QVERIFY(world.list.isOver());

        CommissionWorld at(m_catalog, u"XM430-W350@57600:1"_s);
        at.want(u"XM430-W350"_s, 11, 1, 1'000'000);
        at.options.takesPresent = true;
        at.plug(0);
        QCOMPARE(at.problem(at.round()), QString());
        QVERIFY(at.list.isOver());
    }

    void onceMoreWithTheSameList()
    {
        CommissionWorld world(m_catalog, ThreeNew);
        world.want(u"XM430-W350"_s, 11, 3, 1'000'000, {{u"Position P Gain"_s, 640}});
        const CommissionList fresh = world.list;
        QVERIFY(world.round());
        for (std::size_t i = 0; i < 3; ++i) {
            world.plug(i);
            QCOMPARE(world.problem(world.round()), QString());
        }
        QVERIFY(world.list.isOver());
        world.servo(1).write(u"Position P Gain", 100);
        world.list = fresh;
        world.restart();
        const auto round = world.round();
        QCOMPARE(world.problem(round), QString());
        QCOMPARE(round->ticked.size(), std::size_t(3));
        QVERIFY(world.list.facts(0).wasSo);
        QVERIFY(!world.list.facts(1).wasSo);
        QCOMPARE(world.writes(), 1);
        QCOMPARE(world.servo(1).value(u"Position P Gain"), 640);
    }

    void underTorque()
    {
        CommissionWorld world(m_catalog, u"XM430-W350@57600:1"_s);
        world.want(u"XM430-W350"_s, 11, 1, 1'000'000);
        QVERIFY(world.round());
        world.plug(0);
        world.servo(0).write(u"Torque Enable", 1);
        QVERIFY(world.problem(world.round()).contains(u"under torque"));
        QCOMPARE(world.writes(), 0);
        world.options.mayTurnTorqueOff = true;
        QCOMPARE(world.problem(world.round()), QString());
        QVERIFY(world.list.isOver());
        QCOMPARE(world.servo(0).value(u"Torque Enable"), 0);
    }

    void aPortThatCantDoTheRate()
    {
        CommissionWorld world(m_catalog, u"XM430-W350@57600:1"_s);
        world.want(u"XM430-W350"_s, 11, 1, 4'000'000);
        world.line->refuse(4'000'000);
        const auto round = world.round();
        QVERIFY(!round);
        QCOMPARE(round.error().kind, ErrorKind::PortUnsuitable);
        world.want(u"XM430-W350"_s, 11, 1, 1'000'000); // not wanted: not looked at
        QVERIFY(world.round());
    }

    void movesThatWereLeft()
    {
        CommissionWorld world(m_catalog, u"XM430-W350@57600:1"_s);
        world.want(u"XM430-W350"_s, 11, 1, 1'000'000);
        QVERIFY(world.plan().file.save(othersMove()));
        const auto round = world.round();
        QVERIFY(!round);
        QVERIFY2(round.error().text.contains(u"XL430-W250 #3 is at ID 3"), qPrintable(round.error().text));
        QVERIFY(world.plan().file.exists());
    }

    /// By another program, or another part of this one: their plan is neither replaced nor thrown away.
    void movesThatBeginMeanwhile_data()
    {
        QTest::addColumn<QString>("servo");
        QTest::addColumn<QString>("says");
        QTest::newRow("one that would have to move") << u"XM430-W350@57600:1"_s << u"XL430-W250 #3 is at ID 3"_s;
        QTest::newRow("one that stands as wanted") << u"XM430-W350@1000000:11"_s << QString();
    }
    void movesThatBeginMeanwhile()
    {
        QFETCH(QString, servo);
        QFETCH(QString, says);
        CommissionWorld world(m_catalog, servo);
        world.want(u"XM430-W350"_s, 11, 1, 1'000'000);
        QVERIFY(world.round());
        QVERIFY(world.plan().file.save(othersMove()));
        world.plug(0);
        const QString problem = world.problem(world.round());
        QVERIFY2(says.isEmpty() ? problem.isEmpty() : problem.contains(says), qPrintable(problem));
        QCOMPARE(world.list.next().has_value(), !says.isEmpty());
        QCOMPARE(world.writes(), 0);
        const auto left = world.plan().file.load();
        QVERIFY(left && left->devices.front().place.id == 3);
        world.plan().file.remove();
        QCOMPARE(world.problem(world.round()), QString());
        QVERIFY(!world.list.next());
    }

    void theJournalKnowsEachWrite()
    {
        CommissionWorld world(m_catalog, u"XM430-W350@57600:1"_s);
        world.want(u"XM430-W350"_s, 11, 1, 1'000'000, {{u"Position P Gain"_s, 640}});
        QVERIFY(world.round());
        world.plug(0);
        Journal journal;
        const auto round = world.round(noted(&journal, JournalAuthor::Window, u"simulated"_s, m_catalog));
        QCOMPARE(world.problem(round), QString());
        QStringList said;
        for (const JournalEntry &entry : journal.entries())
            said << registerText(entry.changes.front());
        QCOMPARE(said, (QStringList{u"ID"_s, u"Baud Rate"_s, u"Position P Gain"_s}));
        QCOMPARE(static_cast<int>(said.size()), world.writes());
    }

    /// Or the next new one would answer together with it.
    void whereNewOnesAnswerComesLast()
    {
        CommissionWorld world(m_catalog, u"XM430-W350@57600:1,XM430-W350@57600:1"_s);
        world.want(u"XM430-W350"_s, 1, 2, 57600);
        QVERIFY(world.round());
        for (std::size_t i = 0; i < 2; ++i) {
            QCOMPARE(world.list.next(), 1 - i);
            world.plug(i);
            QCOMPARE(world.problem(world.round()), QString());
        }
        QCOMPARE(world.servo(0).id(), 2);
        QCOMPARE(world.servo(1).id(), 1);
        QVERIFY(world.list.facts(0).wasSo);
        QVERIFY(world.list.isOver());
    }

    void theLed_data()
    {
        QTest::addColumn<QString>("model");
        QTest::addColumn<bool>("has");
        QTest::addColumn<QStringList>("lights");
        QTest::newRow("X") << u"XM430-W350"_s << true << QStringList{u"LED=1"_s, u"LED=0"_s};
        QTest::newRow("PRO, in colours")
            << u"H54-200-S500-R"_s << true
            << QStringList{u"LED Red=255"_s, u"LED Green=255"_s, u"LED Blue=255"_s,
                           u"LED Red=0"_s,   u"LED Green=0"_s,   u"LED Blue=0"_s};
        QTest::newRow("waterproof") << u"XW540-T260"_s << false << QStringList();
    }
    void theLed()
    {
        QFETCH(QString, model);
        QFETCH(bool, has);
        QFETCH(QStringList, lights);
        const Catalog::ModelInfo *info = m_catalog.model(model);
        QVERIFY(info);
        const ControlTablePtr table = m_catalog.find(info->modelNumber, info->newestFirmware);
        QCOMPARE(hasLed(*table), has);
        CommissionWorld world(m_catalog, model + u"@57600:1"_s);
        world.plug(0);
        DirectContext context(*world.program);
        QStringList lit;
        CommissionHooks hooks;
        hooks.ended = [&](const CommissionWrite &write, const CommissionWritten &outcome) {
            QVERIFY(!outcome.error);
            lit << u"%1=%2"_s.arg(write.change.name).arg(world.servo(0).value(write.change.name));
        };
        const Found found{1, 57600, info->modelNumber, static_cast<std::uint8_t>(info->newestFirmware), false, {}};
        const auto shown = identifyByLed(context, found, *table, hooks);
        QCOMPARE(shown.has_value(), has);
        QCOMPARE(lit, lights);
    }

private:
    /// Of a servo that is no concern of the list.
    static MovePlan othersMove()
    {
        MovePlan plan;
        MoveDevice device;
        device.place.id = 3;
        device.place.modelNumber = 1060;
        device.place.name = u"XL430-W250 #3"_s;
        device.goal = {57600, 4};
        plan.devices = {device};
        plan.steps = {{0, {57600, 3}, {57600, 4}, false}};
        return plan;
    }

    const Catalog m_catalog = test::builtInCatalog();
};

DYNASCOPE_CORE_TEST(TestCommissioning)
#include "tst_commissioning.moc"
