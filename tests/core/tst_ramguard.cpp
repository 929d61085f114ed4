// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/poller.h"
#include "core/session/ramguard.h"
#include "core/session/watchplan.h"
#include "tests/support/builtincatalog.h"
#include "tests/support/testmain.h"
#include "tests/support/undoworld.h"

#include <QSignalSpy>

using namespace dynascope;
using namespace std::chrono_literals;
using namespace Qt::StringLiterals;
using dynascope::test::UndoWorld;

namespace {

constexpr int Rate = test::UndoRate;

/// A session that polls, in virtual time that passes when it is told to.
struct World : UndoWorld {
    explicit World(const Catalog &catalog,
                   const QString &servos = u"XM430-W350@57600:1,XL430-W250@57600:2,XM430-W350@57600:3"_s)
        : UndoWorld(catalog, servos), monitor(all.session), guard(all.session, monitor, all.commands, journal),
          restarts(&guard, &RamGuard::restarted)
    {
    }

    /// On the bus thread, between two exchanges: after this much time, with the servos as they are by then.
    void atWire(const std::function<void(sim::SimulatedBus &)> &what, std::chrono::milliseconds after = {})
    {
        bool isDone = false;
        all.line->bus().run<void>(
            Priority::Click, nullptr,
            [&](JobContext &context) {
                all.factory.passing += LineTime(after).count();
                all.factory.simulated.advanceTo(context.bus().line().now());
                what(all.factory.simulated);
                return Result<void>();
            },
            [&](const Result<void> &) { isDone = true; });
        QVERIFY(VirtualSession::waitFor([&] { return isDone; }));
    }
    /// What is due by then is polled, and heard of.
    void pass(std::chrono::milliseconds time)
    {
        QCoreApplication::processEvents(); // what is to be polled is known
        atWire([](sim::SimulatedBus &) {});
        atWire([](sim::SimulatedBus &) {}, time);
        for (int i = 0; i < 3; ++i) { // a poll, a look after it, and the frame in which they are heard
            QTest::qWait(20);
            atWire([](sim::SimulatedBus &) {});
        }
    }
    /// Past the journal.
    void writtenByAnother(int id, QStringView name, std::int64_t raw)
    {
        const Field &field = *device(id).table().find(name);
        const SpanData data{static_cast<std::uint8_t>(id), field.address, bytesFromRaw(field, raw)};
        QVERIFY(run([&](const Commands::Done &done) {
            all.line->bus().run<void>(
                Priority::Click, nullptr,
                [data](JobContext &context) -> Result<void> {
                    const auto written = dynascope::write(context.bus(), data);
                    return written ? Result<void>() : tl::unexpected(written.error());
                },
                done);
        }));
    }
    void cut(int id)
    {
        atWire([&](sim::SimulatedBus &bus) { bus.servo(id, Rate)->powerCycle(); });
        atWire([](sim::SimulatedBus &) {}, 1s); // it has started
    }
    int field(int id, QStringView name) { return device(id).table().indexOf(name); }
    RamState state(int id, QStringView name) { return guard.stateOf(device(id).key(), field(id, name)); }
    std::int64_t atServo(int id, QStringView name)
    {
        std::int64_t raw = 0;
        atWire([&](sim::SimulatedBus &bus) { raw = bus.servo(id, Rate)->value(name); });
        return raw;
    }
    Result<void> setAgain(int id)
    {
        return run([&](const auto &done) { guard.setAgain({device(id).key()}, done); });
    }

    Monitor monitor;
    RamGuard guard;
    QSignalSpy restarts;
};

} // namespace

/// What was set in this session, what becomes of it when the power goes, and setting it again.
class TestRamGuard : public QObject
{
    Q_OBJECT

private slots:
    void whatIsASetting_data()
    {
        QTest::addColumn<int>("model");
        QTest::addColumn<QString>("name");
        QTest::addColumn<bool>("isOne");
        const auto row = [](int model, const QString &name, bool isOne) {
            QTest::addRow("%d %s", model, qPrintable(name)) << model << name << isOne;
        };
        for (const char *name : {"Position P Gain", "Profile Velocity", "Bus Watchdog", "Status Return Level",
                                 "Indirect Address 1", "Feedforward 1st Gain"})
            row(1020, QLatin1String(name), true);
        for (const char *name : {"Torque Enable", "LED", "Goal Position", "Goal PWM", "Goal Current", "Goal Velocity",
                                 "Indirect Data 1", "Present Position", "Realtime Tick", "Operating Mode", "ID"})
            row(1020, QLatin1String(name), false);
        for (const char *name : {"P Gain", "Punch", "Torque Limit"})
            row(350, QLatin1String(name), true);
        for (const char *name : {"Moving Speed", "Goal Position", "LED"})
            row(350, QLatin1String(name), false);
        row(54024, u"LED Red"_s, false);
        row(54024, u"Goal Torque"_s, false);
        row(54024, u"Goal Acceleration"_s, false);
        row(54024, u"Velocity P Gain"_s, true);
        row(4000, u"Position P Gain"_s, true); // HYBRID
        row(4000, u"Hybrid Save"_s, false);
        row(4000, u"Velocity Offset"_s, false);
    }

    void whatIsASetting()
    {
        QFETCH(int, model);
        QFETCH(QString, name);
        const ControlTablePtr table = m_catalog.findOrRaw(model, 40);
        const Field *field = table->find(name);
        QVERIFY(field);
        QTEST(isLostAtPowerOff(*table, *field), "isOne");
    }

    void whatIsSetIsMarked()
    {
        World world(m_catalog);
        world.open();
        QVERIFY(world.write(1, u"Profile Velocity", 100));
        QVERIFY(world.write(1, u"Moving Threshold", 33)); // EEPROM
        QVERIFY(world.write(1, u"Goal PWM", 300));
        QVERIFY(world.write(1, u"LED", 1));
        QVERIFY(world.torque(1, true));
        QCOMPARE(world.state(1, u"Profile Velocity"), RamState::Set);
        QCOMPARE(world.guard.setValue(world.device(1).key(), world.field(1, u"Profile Velocity")), 100);
        for (const QStringView name : {u"Moving Threshold", u"Goal PWM", u"LED", u"Torque Enable", u"Position P Gain"})
            QCOMPARE(world.state(1, name), RamState::NotSet);
        QCOMPARE(world.state(3, u"Profile Velocity"), RamState::NotSet);
        QVERIFY(!world.write(1, u"Profile Velocity", -5)); // refused
        QCOMPARE(world.guard.setValue(world.device(1).key(), world.field(1, u"Profile Velocity")), 100);
    }

    void whatTakesAMarkOff()
    {
        World world(m_catalog);
        world.open();
        QVERIFY(world.write(1, u"Profile Velocity", 100));
        QVERIFY(world.write(1, u"Profile Velocity", 0)); // its initial value
        QCOMPARE(world.state(1, u"Profile Velocity"), RamState::NotSet);
        QVERIFY(world.write(1, u"Profile Velocity", 100));
        QCOMPARE(world.revert({world.last()}), QString());
        QCOMPARE(world.state(1, u"Profile Velocity"), RamState::NotSet);
        QCOMPARE(world.revert({world.last() - 1}, Direction::Redo), QString());
        QCOMPARE(world.state(1, u"Profile Velocity"), RamState::Set);
    }

    /// What it held when the session began is nothing that was set in it.
    void backToWhatWasThere()
    {
        World world(m_catalog);
        world.open();
        world.writtenByAnother(1, u"Profile Velocity", 50);
        QVERIFY(world.write(1, u"Profile Velocity", 100));
        QVERIFY(world.write(1, u"Profile Velocity", 200));
        QCOMPARE(world.state(1, u"Profile Velocity"), RamState::Set);
        QVERIFY(world.write(1, u"Profile Velocity", 50));
        QCOMPARE(world.state(1, u"Profile Velocity"), RamState::NotSet);
    }

    void aModeTakesWhatItResets()
    {
        World world(m_catalog);
        world.open();
        QVERIFY(world.write(1, u"Position P Gain", 111));
        QVERIFY(world.write(1, u"Profile Velocity", 222));
        QVERIFY(world.write(1, u"Bus Watchdog", 0));
        QVERIFY(world.write(1, u"Operating Mode", 1));
        QCOMPARE(world.state(1, u"Position P Gain"), RamState::NotSet);
        QCOMPARE(world.state(1, u"Profile Velocity"), RamState::NotSet);
        QCOMPARE(world.state(1, u"Velocity P Gain"), RamState::NotSet); // what the mode itself set
        QCOMPARE(world.revert({world.last()}), QString()); // and the gains with it
        QCOMPARE(world.atServo(1, u"Position P Gain"), 111);
        QCOMPARE(world.state(1, u"Position P Gain"), RamState::Set);
        QCOMPARE(world.state(1, u"Profile Velocity"), RamState::Set);
    }

    void aMarkFollowsItsDevice()
    {
        World world(m_catalog);
        world.open();
        QVERIFY(world.write(1, u"Profile Velocity", 100));
        QVERIFY(world.write(3, u"Profile Velocity", 300));
        QVERIFY(world.run([&](const auto &done) { world.all.commands.changeId(world.device(1), 7, false, done); }));
        QCOMPARE(world.state(7, u"Profile Velocity"), RamState::Set);
        QCOMPARE(world.guard.setValue(world.device(3).key(), world.field(3, u"Profile Velocity")), 300);
        QVERIFY(world.write(7, u"Profile Velocity", 0));
        QCOMPARE(world.state(7, u"Profile Velocity"), RamState::NotSet);
        QCOMPARE(world.state(3, u"Profile Velocity"), RamState::Set);
    }

    /// Nobody looks at the device: its tick is polled nevertheless.
    void aBrownOutBetweenTwoPolls()
    {
        World world(m_catalog);
        world.open();
        QVERIFY(world.write(1, u"Profile Velocity", 100));
        QVERIFY(world.write(1, u"Position P Gain", 700));
        QVERIFY(world.write(3, u"Profile Velocity", 300));
        world.pass(9s);
        world.pass(9s);
        world.cut(1);
        world.pass(9s);
        QTRY_COMPARE(world.restarts.count(), 1);
        QCOMPARE(world.guard.restarts().size(), std::size_t(1));
        const Restart restart = world.guard.restarts().front();
        QCOMPARE(restart.device, world.device(1).key());
        QCOMPARE(restart.sign, RestartSign::Tick);
        QCOMPARE(restart.lost, 2);
        QCOMPARE(world.state(1, u"Profile Velocity"), RamState::Lost);
        QCOMPARE(world.state(3, u"Profile Velocity"), RamState::Set); // of whom nothing is said
        QCOMPARE(world.atServo(1, u"Profile Velocity"), 0);           // nothing was written by itself
        world.pass(9s);
        QCOMPARE(world.restarts.count(), 1); // said once

        const qint64 before = world.last();
        QVERIFY(world.setAgain(1));
        QCOMPARE(world.atServo(1, u"Profile Velocity"), 100);
        QCOMPARE(world.atServo(1, u"Position P Gain"), 700);
        QCOMPARE(world.atServo(1, u"Torque Enable"), 0);
        QCOMPARE(world.last(), before + 2);
        QCOMPARE(world.journal.entry(before + 1)->changes.front().name, u"Profile Velocity"_s); // as they were set
        QVERIFY(world.guard.restarts().empty());
        QCOMPARE(world.state(1, u"Profile Velocity"), RamState::Set);
        world.pass(9s);
        world.cut(1); // and once more
        world.pass(9s);
        QTRY_COMPARE(world.restarts.count(), 2);
    }

    /// Nothing but what differs is written, and never a goal, torque or LED.
    void onlyWhatDiffersIsSetAgain()
    {
        World world(m_catalog);
        world.open();
        QVERIFY(world.torque(1, true));
        QVERIFY(world.write(1, u"Profile Velocity", 100));
        QVERIFY(world.write(1, u"Position P Gain", 700));
        QVERIFY(world.write(1, u"Goal Position", 2100));
        QVERIFY(world.write(1, u"LED", 1));
        world.pass(9s);
        world.cut(1);
        world.pass(9s);
        QTRY_COMPARE(world.restarts.count(), 1);
        world.device(1).takeReadBack(world.field(1, u"Position P Gain"), 700); // somebody was quicker
        std::vector<std::uint16_t> written;
        world.atWire([&](sim::SimulatedBus &) {
            world.all.factory.onPacket = [&](int, ByteView packet) {
                if (packet[7] == static_cast<std::uint8_t>(Instruction::Write))
                    written.push_back(static_cast<std::uint16_t>(packet[8] | packet[9] << 8));
            };
        });
        QVERIFY(world.setAgain(1));
        world.atWire([&](sim::SimulatedBus &) { world.all.factory.onPacket = {}; });
        QCOMPARE(written, std::vector<std::uint16_t>{112});
        QVERIFY(world.guard.restarts().empty());
        QCOMPARE(world.atServo(1, u"Torque Enable"), 0);
    }

    void withoutATick_data()
    {
        QTest::addColumn<QString>("servo");
        QTest::addColumn<QString>("name");
        QTest::addColumn<bool>("torque");
        QTest::newRow("XL-320 under torque") << u"XL-320@57600:1"_s << u"Punch"_s << true;
        QTest::newRow("XL-320") << u"XL-320@57600:1"_s << u"P Gain"_s << false;
        QTest::newRow("PRO under torque") << u"H54-200-S500-R@57600:1"_s << u"Velocity P Gain"_s << true;
    }

    void withoutATick()
    {
        QFETCH(QString, servo);
        QFETCH(QString, name);
        QFETCH(bool, torque);
        World world(m_catalog, servo);
        world.open();
        QVERIFY(!tickField(world.device(1).table()));
        const Field &field = *world.device(1).table().find(name);
        QVERIFY(world.write(1, name, *field.initial + 5));
        if (torque)
            QVERIFY(world.torque(1, true));
        world.pass(9s);
        if (torque)
            QVERIFY(world.torque(1, false)); // by somebody: no restart
        world.pass(9s);
        QCOMPARE(world.restarts.count(), 0);
        if (torque)
            QVERIFY(world.torque(1, true));
        world.pass(9s);
        world.cut(1);
        world.pass(9s);
        QTRY_COMPARE(world.restarts.count(), 1);
        QCOMPARE(world.guard.restarts().front().sign, RestartSign::Values);
        QVERIFY(world.setAgain(1));
        QCOMPARE(world.atServo(1, name), *field.initial + 5);
        QCOMPARE(world.atServo(1, u"Torque Enable"), 0);
    }

    /// The tick goes round meanwhile, more than once.
    void pauses_data()
    {
        QTest::addColumn<int>("seconds");
        QTest::addColumn<bool>("cut");
        for (const int seconds : {20, 32, 33, 40, 65, 3600}) {
            QTest::addRow("%d s, and it ran on", seconds) << seconds << false;
            QTest::addRow("%d s, and it restarted", seconds) << seconds << true;
        }
    }

    void pauses()
    {
        QFETCH(int, seconds);
        QFETCH(bool, cut);
        World world(m_catalog);
        world.open();
        QVERIFY(world.write(1, u"Profile Velocity", 100));
        world.pass(9s);
        world.monitor.setPaused(true);
        world.pass(1s);
        world.pass(std::chrono::seconds(seconds - 3));
        if (cut)
            world.cut(1);
        world.pass(2s);
        world.monitor.setPaused(false);
        world.pass(1s);
        world.pass(9s);
        if (cut)
            QTRY_COMPARE(world.restarts.count(), 1);
        else
            QCOMPARE(world.restarts.count(), 0);
        QCOMPARE(world.state(1, u"Profile Velocity"), cut ? RamState::Lost : RamState::Set);
    }

    void whoIsBackIsLookedAt()
    {
        World world(m_catalog);
        world.open();
        QVERIFY(world.write(1, u"Profile Velocity", 100));
        world.pass(9s);
        world.atWire([](sim::SimulatedBus &bus) { bus.servo(1, Rate)->setPower(false); });
        for (int i = 0; i < 6 && world.device(1).state() != Device::State::Silent; ++i)
            world.pass(1s);
        QCOMPARE(world.device(1).state(), Device::State::Silent);
        QCOMPARE(world.restarts.count(), 0);
        world.atWire([](sim::SimulatedBus &bus) { bus.servo(1, Rate)->setPower(true); });
        world.pass(1s);
        for (int i = 0; i < 8 && world.restarts.count() == 0; ++i)
            world.pass(1s);
        QCOMPARE(world.restarts.count(), 1);
    }

    void aLineThatWasClosedMeanwhile()
    {
        World world(m_catalog);
        world.open();
        QVERIFY(world.write(1, u"Profile Velocity", 100));
        QVERIFY(world.write(3, u"Profile Velocity", 100));
        world.all.close();
        world.all.factory.simulated.servo(1, Rate)->powerCycle();
        world.all.factory.simulated.advanceTo(world.all.factory.simulated.now() + 1s);
        world.all.open(Rate);
        QTRY_COMPARE(world.restarts.count(), 1);
        QCOMPARE(world.state(1, u"Profile Velocity"), RamState::Lost);
        QCOMPARE(world.state(3, u"Profile Velocity"), RamState::Set);
        QVERIFY(world.setAgain(1));
    }

    void ourOwnReboot_data()
    {
        QTest::addColumn<bool>("reset");
        QTest::newRow("Reboot") << false;
        QTest::newRow("Factory Reset") << true;
    }

    void ourOwnReboot()
    {
        QFETCH(bool, reset);
        World world(m_catalog);
        world.open();
        QVERIFY(world.write(1, u"Profile Velocity", 100));
        QVERIFY(world.write(2, u"Profile Velocity", 100));
        world.pass(9s);
        std::optional<Result<void>> done;
        const auto take = [&](const Result<void> &result) { done = result; };
        if (reset)
            world.all.commands.factoryReset(world.device(1), ResetOption::AllButIdAndBaud, take);
        else
            world.all.commands.reboot(world.device(1), take);
        QVERIFY(VirtualSession::waitFor([&] { return world.device(1).state() == Device::State::Rebooting; }));
        world.pass(2s);
        QVERIFY(VirtualSession::waitFor([&] { return done.has_value(); }));
        QVERIFY(*done);
        if (reset) { // those values are what was asked for
            QTRY_COMPARE(world.state(1, u"Profile Velocity"), RamState::NotSet);
            world.pass(9s);
            QCOMPARE(world.restarts.count(), 0);
            QVERIFY(world.guard.restarts().empty());
            QCOMPARE(world.state(2, u"Profile Velocity"), RamState::Set);
            return;
        }
        QTRY_COMPARE(world.restarts.count(), 1);
        const Restart restart = world.guard.restarts().front();
        QCOMPARE(restart.sign, RestartSign::Reboot);
        QCOMPARE(restart.lost, 1);
        world.pass(9s);
        QCOMPARE(world.restarts.count(), 1);
        world.guard.dismiss({world.device(1).key()});
        QVERIFY(world.guard.restarts().empty());
        QCOMPARE(world.state(1, u"Profile Velocity"), RamState::NotSet);
        QCOMPARE(world.state(2, u"Profile Velocity"), RamState::Set);
    }

    /// Nobody knows whether the write arrived: what was lost stays on offer.
    void anUnconfirmedWriteOfALostOne()
    {
        const ControlTablePtr table = m_catalog.findOrRaw(1020, 45);
        const Field &field = *table->find(u"Profile Velocity");
        const int index = table->indexOf(&field);
        RamMarks marks;
        JournalEntry entry;
        entry.state = JournalState::Done;
        entry.changes = {changeOf(field, 100)};
        QVERIFY(marks.take(*table, entry));
        PollValue value;
        value.address = field.address;
        value.data = bytesFromRaw(field, 0);
        QCOMPARE(marks.restarted(*table, std::span(&value, 1)), 1);
        entry.state = JournalState::Unconfirmed;
        marks.take(*table, entry);
        QVERIFY(marks.find(index)->isLost);
        entry.changes.front().shown = entry.changes.front().after;
        marks.take(*table, entry);
        QVERIFY(!marks.find(index)->isLost);
        entry.state = JournalState::Failed;
        entry.changes.front().after = entry.changes.front().shown = bytesFromRaw(field, 0);
        QVERIFY(!marks.take(*table, entry));
        QVERIFY(marks.find(index));
    }

    /// What somebody writes anew isn't lost any more.
    void aLostOneThatIsWritten()
    {
        World world(m_catalog);
        world.open();
        QVERIFY(world.write(1, u"Profile Velocity", 100));
        world.pass(9s);
        world.cut(1);
        world.pass(9s);
        QTRY_COMPARE(world.restarts.count(), 1);
        QVERIFY(world.write(1, u"Profile Velocity", 55));
        QVERIFY(world.guard.restarts().empty());
        QCOMPARE(world.state(1, u"Profile Velocity"), RamState::Set);
    }

    void settingAgainEndsWhereItFails()
    {
        World world(m_catalog);
        world.open();
        QVERIFY(world.write(1, u"Profile Velocity", 100));
        QVERIFY(world.write(1, u"Position P Gain", 700));
        world.pass(9s);
        world.cut(1);
        world.pass(9s);
        QTRY_COMPARE(world.restarts.count(), 1);
        world.monitor.setPaused(true);
        world.pass(1s);
        world.atWire([](sim::SimulatedBus &bus) { bus.servo(1, Rate)->setPower(false); });
        QVERIFY(!world.setAgain(1));
        QCOMPARE(world.state(1, u"Profile Velocity"), RamState::Lost);
        QCOMPARE(world.guard.restarts().front().lost, 2); // still offered
        world.all.close();
        std::optional<Result<void>> gone;
        world.guard.setAgain({world.guard.restarts().front().device}, [&](const auto &result) { gone = result; });
        QVERIFY(gone && !*gone);
    }

    /// One small exchange in 9 s, and nothing else of the cycles changes.
    void ridesInTheSlowestWatch()
    {
        VirtualBus world(m_catalog, u"XM430-W350@57600:1,XL-320@57600:2"_s);
        const Found found[]{{1, Rate, 1020, 45, false, {}}, {2, Rate, 350, 40, false, {}}};
        const Device with(1, nullptr, m_catalog.findOrRaw(1020, 45), found[0]);
        const Device without(2, nullptr, m_catalog.findOrRaw(350, 40), found[1]);
        const int tick = with.table().indexOf(u"Realtime Tick"), punch = without.table().indexOf(u"Punch");
        const int watched = with.table().indexOf(u"Present Position");
        const auto polled = [&](bool signs) {
            const std::set<int> none;
            const std::vector<DeviceWatches> watches{{&with, {}, false, {}, signs ? std::set{tick} : none},
                                                     {&without, {}, false, {}, signs ? std::set{punch} : none}};
            Poller poller(*world.bus);
            poller.setPlan(planWatches(watches, Rate));
            std::map<int, std::vector<LineTime>> at; // by address
            const LineTime end = world.line->now() + 60s;
            while (world.line->now() < end) {
                if (const LineTime due = poller.nextDue(); due > world.line->now())
                    world.line->advance(due - world.line->now());
                const auto batch = poller.runCycle();
                for (const PollValue &value : batch.value_or(Batch()).values) {
                    if (!value.data.empty())
                        at[static_cast<int>(value.device) * 1000 + value.address].push_back(value.at);
                }
            }
            return at;
        };
        auto before = polled(false);
        auto after = polled(true);
        for (const int sign : {1000 + with.table().fields()[std::size_t(tick)].address,
                               2000 + without.table().fields()[std::size_t(punch)].address}) {
            const std::vector<LineTime> times = after[sign];
            QVERIFY(times.size() == 7 || times.size() == 6);
            for (std::size_t i = 1; i < times.size(); ++i) {
                QVERIFY(times[i] - times[i - 1] <= 10s);
                QVERIFY(times[i] - times[i - 1] > 8s);
            }
            after.erase(sign);
        }
        QCOMPARE(after.size(), before.size());
        for (const auto &[where, times] : before)
            QVERIFY(std::abs(std::ssize(times) - std::ssize(after[where])) <= 1);
        // Watched, or on screen: it is read already.
        const std::vector<DeviceWatches> known{{&with, {tick, watched}, false, {}, {tick}}, {&without, {}, true, {}, {punch}}};
        for (const PollSpan &span : planWatches(known, Rate).spans)
            QVERIFY(span.interval < 9s);
    }

private:
    const Catalog m_catalog = test::builtInCatalog();
};

DYNASCOPE_CORE_TEST(TestRamGuard)
#include "tst_ramguard.moc"
