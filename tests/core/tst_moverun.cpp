// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/moverun.h"
#include "tests/support/builtincatalog.h"
#include "tests/support/sessionfixture.h"
#include "tests/support/testmain.h"

using namespace dynascope;
using namespace Qt::StringLiterals;

namespace {

constexpr int Slow = 57600, Fast = 1'000'000;

/// A program on a bus that outlives it.
struct Program {
    Program(VirtualFactory &factory, const Catalog &catalog, const QString &folder,
            const QString &portName = u"virtual"_s)
        : journal(folder + u"/journal"_s)
        , session(factory, catalog)
        , commands(session, &journal)
        , stop(session, commands)
    {
        std::vector<Found> found;
        for (const auto &servo : factory.simulated.servos())
            found.push_back({static_cast<std::uint8_t>(servo->id()),
                             servo->baudRate(),
                             static_cast<std::uint16_t>(servo->table().modelNumber()),
                             static_cast<std::uint8_t>(servo->firmware()),
                             false,
                             {}});
        line = &session.open(portName, Slow);
        for (const Found &each : found)
            line->heard(each);
        run = std::make_unique<MoveRun>(session, commands, *line, folder + u"/moves"_s);
        if (!VirtualSession::waitFor([this] { return line->state() == BusThread::State::Open; }))
            qFatal("it did not open");
    }
    ~Program() { run.reset(); } // what its jobs come to is told nobody: as if it had been killed

    Device &at(int id, int baudRate = Slow)
    {
        Device *device = line->deviceAt(static_cast<std::uint8_t>(id), baudRate);
        if (!device)
            qFatal("no device %d at %d", id, baudRate);
        return *device;
    }
    bool rest()
    {
        return VirtualSession::waitFor([this] { return !run->isBusy(); });
    }
    bool survey()
    {
        run->survey();
        return rest() && run->isSurveyed();
    }
    Result<MovePlan> plan(const std::map<DeviceKey, MovePlace> &wishes) { return run->planFor(wishes); }

    Journal journal;
    Session session;
    Commands commands;
    StopControl stop;
    LineSession *line = nullptr;
    std::unique_ptr<MoveRun> run;
};

bool isWrite(ByteView packet)
{
    return packet[7] == static_cast<std::uint8_t>(Instruction::Write);
}

} // namespace

/// A plan of moves as the window carries it out: the devices follow, the file and the journal know.
class TestMoveRun : public QObject
{
    Q_OBJECT

private slots:
    void aSwap()
    {
        VirtualFactory factory(m_catalog, u"XM430-W350@57600:1,XL430-W250@57600:2"_s);
        const QTemporaryDir folder;
        Program program(factory, m_catalog, folder.path());
        QVERIFY(program.survey());
        const DeviceKey one = program.at(1).key(), two = program.at(2).key();
        const auto plan = program.plan({{one, {Slow, 2}}, {two, {Slow, 1}}});
        QVERIFY2(plan, plan ? "" : qPrintable(plan.error().text));
        QCOMPARE(plan->steps.size(), 3u);
        program.run->start(*plan);
        QVERIFY(program.rest());
        QVERIFY2(program.run->state() == MoveRun::State::Over, qPrintable(program.run->problem()));
        QCOMPARE(program.session.device(one)->id(), 2); // the same devices, so traces and tables follow
        QCOMPARE(program.session.device(two)->id(), 1);
        QVERIFY(!program.run->file().exists());
        QCOMPARE(program.journal.entries().size(), 3u);
        for (const JournalEntry &entry : program.journal.entries()) {
            QCOMPARE(entry.state, JournalState::Done);
            QVERIFY(entry.movedTo);
        }
        QVERIFY(VirtualSession::waitFor([&] { return program.session.device(one)->raw(u"ID") == 2; }));
        QCOMPARE(program.session.devices().size(), 2u);
    }

    void theLineFollowsWhereAllWent_data()
    {
        QTest::addColumn<bool>("all");
        QTest::newRow("all") << true;
        QTest::newRow("one stays, and the others are parked") << false;
    }
    void theLineFollowsWhereAllWent()
    {
        QFETCH(bool, all);
        VirtualFactory factory(m_catalog, u"XM430-W350@57600:1,XL430-W250@57600:2,XL330-M288@57600:3"_s);
        const QTemporaryDir folder;
        Program program(factory, m_catalog, folder.path());
        QVERIFY(program.survey());
        QVERIFY(program.run->offers(Fast));
        std::map<DeviceKey, MovePlace> wishes{{program.at(1).key(), {Fast, 1}}, {program.at(2).key(), {Fast, 2}}};
        if (all)
            wishes[program.at(3).key()] = {Fast, 3};
        program.run->start(*program.plan(wishes));
        QVERIFY(program.rest());
        QCOMPARE(program.run->state(), MoveRun::State::Over);
        QCOMPARE(program.line->baudRate(), all ? Fast : Slow);
        QCOMPARE(program.at(1, Fast).state(), all ? Device::State::Present : Device::State::Parked);
        QCOMPARE(program.at(3, all ? Fast : Slow).state(), Device::State::Present);
    }

    void refusedBeforeTheFirstWrite_data()
    {
        QTest::addColumn<QString>("servos");
        QTest::addColumn<std::vector<MovePlace>>("goals"); // of the first devices
        QTest::addColumn<QString>("says");
        const QString two = u"XM430-W350@57600:1,XL430-W250@57600:2"_s;
        QTest::newRow("an ID that is taken") << two << std::vector<MovePlace>{{Slow, 2}} << u"would both have ID 2"_s;
        QTest::newRow("a rate that a model lacks")
            << u"XL430-W250@57600:1"_s << std::vector<MovePlace>{{10'500'000, 1}} << u"10500000 bps"_s;
        QTest::newRow("an ID that nobody can have")
            << u"XM430-W350@57600:1"_s << std::vector<MovePlace>{{Slow, 300}} << u"an ID is 0 to 252"_s;
    }
    void refusedBeforeTheFirstWrite()
    {
        QFETCH(QString, servos);
        QFETCH(std::vector<MovePlace>, goals);
        QFETCH(QString, says);
        VirtualFactory factory(m_catalog, servos);
        const QTemporaryDir folder;
        Program program(factory, m_catalog, folder.path());
        QVERIFY(program.survey());
        std::map<DeviceKey, MovePlace> wishes;
        for (std::size_t i = 0; i < goals.size(); ++i)
            wishes[program.line->devices()[i]->key()] = goals[i];
        const auto plan = program.plan(wishes);
        QVERIFY(!plan);
        QVERIFY2(plan.error().text.contains(says), qPrintable(plan.error().text));
    }

    /// Nobody answers a Ping by its Secondary ID: who wants to know must read it.
    void aSecondaryIdThatWasNeverReadIsInTheWay()
    {
        VirtualFactory factory(m_catalog, u"XM430-W350@57600:1,XL430-W250@57600:2"_s);
        factory.simulated.servo(2, Slow)->write(u"Secondary ID", 9);
        const QTemporaryDir folder;
        Program program(factory, m_catalog, folder.path());
        QVERIFY(program.survey());
        const auto plan = program.plan({{program.at(1).key(), {Slow, 9}}});
        QVERIFY(!plan);
        QVERIFY2(plan.error().text.contains(u"Secondary ID of XL430-W250"_s), qPrintable(plan.error().text));
    }

    void aFirstStepThatIsRefusedLeavesNothing()
    {
        VirtualFactory factory(m_catalog, u"XM430-W350@57600:1"_s);
        factory.simulated.servo(1, Slow)->write(u"Torque Enable", 1);
        const QTemporaryDir folder;
        Program program(factory, m_catalog, folder.path());
        QVERIFY(program.survey());
        auto plan = program.plan({{program.at(1).key(), {Slow, 9}}});
        program.run->start(*plan);
        QVERIFY(program.rest());
        QCOMPARE(program.run->state(), MoveRun::State::Idle);
        QVERIFY2(program.run->problem().contains(u"under torque"_s), qPrintable(program.run->problem()));
        QVERIFY(!program.run->file().exists());
        plan->turnTorqueOff = true;
        program.run->start(*plan);
        QVERIFY(program.rest());
        QCOMPARE(program.run->state(), MoveRun::State::Over);
        QCOMPARE(program.at(9).id(), 9);
    }

    void stopEndsIt()
    {
        VirtualFactory factory(m_catalog, u"XM430-W350@57600:1,XL430-W250@57600:2"_s);
        const QTemporaryDir folder;
        Program program(factory, m_catalog, folder.path());
        QVERIFY(program.survey());
        const DeviceKey one = program.at(1).key(), two = program.at(2).key();
        const auto plan = program.plan({{one, {Slow, 11}}, {two, {Slow, 12}}});
        connect(program.run.get(), &MoveRun::changed, this, [&, pressed = false]() mutable {
            if (!std::exchange(pressed, pressed || program.run->plan().next == 1) && program.run->plan().next == 1)
                program.stop.press();
        });
        program.run->start(*plan);
        QVERIFY(program.rest());
        QCOMPARE(program.run->state(), MoveRun::State::Halted);
        QVERIFY2(program.run->problem().contains(u"STOP"_s), qPrintable(program.run->problem()));
        QCOMPARE(program.run->plan().next, 1u);
        QVERIFY(program.run->file().exists());
        program.run->goOn(false);
        QVERIFY(program.run->problem().contains(u"STOP is held"_s));
        program.stop.release();
        QVERIFY(VirtualSession::waitFor([&] { return !program.line->bus().isStopped(); }));
        program.run->goOn(false);
        QVERIFY(program.rest());
        QVERIFY2(program.run->state() == MoveRun::State::Over, qPrintable(program.run->problem()));
        QCOMPARE(program.session.device(one)->id(), 11);
        QCOMPARE(program.session.device(two)->id(), 12);
    }

    /// The device has it and nobody heard so: what STOP ended is in the journal where it was found, and once only.
    void stopWithTheWriteInFlight()
    {
        VirtualFactory factory(m_catalog, u"XM430-W350@57600:1,XL430-W250@57600:2"_s);
        const QTemporaryDir folder;
        Program program(factory, m_catalog, folder.path());
        QVERIFY(program.survey());
        const DeviceKey one = program.at(1).key(), two = program.at(2).key();
        const auto plan = program.plan({{one, {Slow, 11}}, {two, {Slow, 12}}});
        std::atomic<bool> pressed = false;
        factory.onPacket = [&](int, ByteView packet) {
            if (isWrite(packet) && !pressed.exchange(true))
                QMetaObject::invokeMethod(
                    &program.stop, [&] { program.stop.press(); }, Qt::BlockingQueuedConnection);
        };
        program.run->start(*plan);
        QVERIFY(program.rest());
        QCOMPARE(program.run->state(), MoveRun::State::Halted);
        QCOMPARE(program.session.device(one)->id(), 11);
        QCOMPARE(program.journal.entries().front().movedTo, (JournalPlace{11, Slow}));
        program.stop.release();
        QVERIFY(VirtualSession::waitFor([&] { return !program.line->bus().isStopped(); }));
        program.run->goOn(false);
        QVERIFY(program.rest());
        QVERIFY2(program.run->state() == MoveRun::State::Over, qPrintable(program.run->problem()));
        const auto &entries = program.journal.entries();
        QCOMPARE(std::ranges::count_if(entries, [](const JournalEntry &entry) { return entry.movedTo.has_value(); }), 2);
        QCOMPARE(program.session.device(two)->id(), 12);
    }

    void cancelledBetweenTwoSteps()
    {
        VirtualFactory factory(m_catalog, u"XM430-W350@57600:1,XL430-W250@57600:2"_s);
        const QTemporaryDir folder;
        Program program(factory, m_catalog, folder.path());
        QVERIFY(program.survey());
        const auto plan = program.plan({{program.at(1).key(), {Slow, 11}}, {program.at(2).key(), {Slow, 12}}});
        connect(program.run.get(), &MoveRun::changed, this, [&] {
            if (program.run->plan().next == 1 && program.run->state() == MoveRun::State::Moving)
                program.run->cancel();
        });
        program.run->start(*plan);
        QVERIFY(program.rest());
        QCOMPARE(program.run->state(), MoveRun::State::Halted);
        QCOMPARE(program.run->file().load()->next, 1u);
        QCOMPARE(program.at(2).id(), 2);
        program.run->forget();
        QVERIFY(!program.run->file().exists());
        QCOMPARE(program.run->state(), MoveRun::State::Idle);
    }

    /// Where the line's own name is all there is, the next program finds the plan by it.
    void killedAtEachWrite_data()
    {
        QTest::addColumn<bool>("lastArrives");
        QTest::newRow("its last packet arrives") << true;
        QTest::newRow("its last packet is lost") << false;
    }
    void killedAtEachWrite()
    {
        QFETCH(bool, lastArrives);
        for (int at = 1; at < 20; ++at) {
            VirtualFactory factory(m_catalog, u"XM430-W350@57600:1,XL430-W250@57600:2,XM430-W350@57600:3"_s);
            std::atomic<int> writes = 0;
            std::atomic<bool> dead = false;
            factory.isLost = [&](ByteView packet) {
                if (dead)
                    return true;
                dead = isWrite(packet) && ++writes == at;
                return dead && !lastArrives;
            };
            const QTemporaryDir folder;
            std::size_t begun = 0;
            {
                Program program(factory, m_catalog, folder.path());
                QVERIFY(program.survey());
                const std::map<DeviceKey, MovePlace> ring{{program.at(1).key(), {Fast, 2}},
                                                          {program.at(2).key(), {Fast, 3}},
                                                          {program.at(3).key(), {Fast, 1}}};
                program.run->start(*program.plan(ring));
                QVERIFY(VirtualSession::waitFor([&] { return dead || !program.run->isBusy(); }));
                begun = program.journal.entries().size();
            }
            const bool wasKilled = dead;
            dead = false;
            writes = 100;
            Program next(factory, m_catalog, folder.path());
            QCOMPARE(next.run->takeLeft().has_value(), wasKilled);
            if (wasKilled) {
                QVERIFY(unfinishedText(next.run->plan()).contains(u"a move of 3 devices was interrupted"_s));
                next.run->goOn(false);
                QVERIFY(next.rest());
                QVERIFY2(next.run->state() == MoveRun::State::Over,
                         qPrintable(u"killed at write %1: %2"_s.arg(at).arg(next.run->problem())));
            }
            const std::map<int, int> models{{1, 1020}, {2, 1020}, {3, 1060}};
            for (const auto &[id, model] : models)
                QCOMPARE(next.at(id, Fast).modelNumber(), model);
            // The step that was under way is told of once more, and where it led.
            for (std::size_t i = begun; i < next.journal.entries().size(); ++i)
                QVERIFY(next.journal.entries()[i].movedTo);
            if (!wasKilled) {
                QCOMPARE(at, 7); // six writes: at the new rate nobody is in the way
                return;
            }
        }
        QFAIL("it never came to its end");
    }

private:
    const Catalog m_catalog = test::builtInCatalog();
};

DYNASCOPE_CORE_TEST(TestMoveRun)
#include "tst_moverun.moc"
