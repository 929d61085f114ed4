// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/procedures/movedevices.h"
#include "core/session/settings/settingsjournal.h"
#include "tests/support/builtincatalog.h"
#include "tests/support/profileworld.h"
#include "tests/support/sanitized.h"
#include "tests/support/testmain.h"

using namespace dynascope;
using namespace dynascope::test;
using namespace Qt::StringLiterals;
using namespace std::chrono_literals;

namespace {

QByteArray oneJoint(const QByteArray &registers)
{
    return "profile: 1\njoints:\n  - name: a\n    model: XM430-W350\n    id: 1\n    baud: 1000000\n    registers:\n"
           + registers;
}

} // namespace

/// A profile carried out on simulated servos, in virtual time, and stopped wherever it can be.
class TestProfileApply : public QObject
{
    Q_OBJECT

private slots:
    void writesExactlyWhatDiffers()
    {
        ProfileWorld world(m_catalog, servosOf(8), profileOf(8));
        world.setUp(twelveDeviations());
        const ProfileOutcome outcome = world.apply();
        QVERIFY2(world.isDone, qPrintable(world.why));
        QCOMPARE(world.wrong(), QStringList());
        // A new mode resets gains and profile (manual: "Operating Mode"): first it, then what it has reset.
        QCOMPARE(world.writes(), QStringList({u"1:11"_s, u"1:80"_s, u"1:84"_s, u"1:108"_s, u"1:112"_s, u"2:9"_s, u"2:48"_s,
                                              u"3:63"_s, u"3:112"_s, u"4:31"_s, u"5:44"_s, u"6:10"_s, u"6:80"_s, u"7:38"_s,
                                              u"8:36"_s}));
        QCOMPARE(outcome.written(), 15U);
        (void)world.apply();
        QVERIFY(world.isDone);
        QCOMPARE(world.writes(), QStringList());
        const auto check = world.check();
        QVERIFY(check && check->isAsWanted());
    }

    /// The program ends at its n-th write, or a servo loses its power there: every register holds one of its two values
    /// (what a new mode has reset: that), and the same once more ends the same.
    void stoppedAnywhere_data()
    {
        QTest::addColumn<int>("how");
        QTest::newRow("killed, its last packet arrives") << 0;
        QTest::newRow("killed, its last packet is lost") << 1;
        QTest::newRow("power cut before the write") << 2;
        QTest::newRow("power cut behind the write") << 3;
    }
    void stoppedAnywhere()
    {
        QFETCH(int, how);
        for (int at = 0; at < 40; ++at) {
            ProfileWorld world(m_catalog, servosOf(8), profileOf(8));
            world.setUp(twelveDeviations());
            std::vector<std::vector<std::int64_t>> before;
            for (const auto &servo : world.bus.servos())
                before.push_back(valuesOf(*servo));
            bool wasReached = false;
            {
                MortalLine line(world.bus, ProfileRate, at);
                line.setLastGoesOut(how == 0);
                const auto cut = [&world] {
                    for (const auto &servo : world.bus.servos())
                        servo->setPlugged(false);
                };
                if (how == 2)
                    line.setBefore(cut);
                if (how == 3)
                    line.setBehind(cut);
                (void)world.apply(line);
                wasReached = line.wasReached();
                QCOMPARE(world.isDone, !wasReached);
            }
            if (how >= 2) {
                for (const auto &servo : world.bus.servos())
                    servo->setPlugged(true);
                world.bus.advanceTo(world.bus.now() + 1s);
            }
            for (std::size_t i = 0; i < before.size(); ++i)
                checkOldOrNew(*world.bus.servos()[i], world.profile.joints[i], before[i], how >= 2);
            (void)world.apply();
            QVERIFY2(world.isDone, qPrintable(u"stopped at write %1: %2"_s.arg(at).arg(world.why)));
            QCOMPARE(world.wrong(), QStringList());
            (void)world.apply();
            QCOMPARE(world.writes(), QStringList());
            if (!wasReached) {
                QVERIFY(at >= 15);
                return;
            }
        }
        QFAIL("it never came to its end");
    }

    void disturbed_data()
    {
        QTest::addColumn<sim::ReplyFault>("fault");
        using Kind = sim::ReplyFault::Kind;
        QTest::newRow("lost") << sim::ReplyFault{.kind = Kind::Lost};
        QTest::newRow("damaged") << sim::ReplyFault{.kind = Kind::Damaged};
        QTest::newRow("late") << sim::ReplyFault{.kind = Kind::Late, .time = 30ms};
        QTest::newRow("cut") << sim::ReplyFault{.kind = Kind::Cut, .amount = 5};
        QTest::newRow("twice") << sim::ReplyFault{.kind = Kind::Twice, .time = 1ms};
        QTest::newRow("reboots instead") << sim::ReplyFault{.kind = Kind::Reboot};
    }
    /// One answer goes wrong: what is said to be done is done, and the same once more ends the same.
    void disturbed()
    {
        QFETCH(sim::ReplyFault, fault);
        for (int skip = 0; skip < 140; skip += Sanitized ? 20 : 3) {
            ProfileWorld world(m_catalog, servosOf(8), profileOf(8));
            world.setUp(twelveDeviations());
            fault.skip = skip;
            world.bus.setFaults({.replies = {fault}});
            const ProfileOutcome outcome = world.apply();
            if (world.isDone && fault.kind != sim::ReplyFault::Kind::Reboot)
                QCOMPARE(world.wrong(), QStringList());
            QVERIFY2(world.isDone || outcome.ended || !world.why.isEmpty() || hasReason(outcome),
                     qPrintable(u"no reason after reply %1"_s.arg(skip)));
            world.bus.setFaults({});
            world.bus.advanceTo(world.bus.now() + 1s);
            (void)world.apply();
            QVERIFY2(world.isDone, qPrintable(u"after reply %1: %2"_s.arg(skip).arg(world.why)));
            QCOMPARE(world.wrong(), QStringList());
            (void)world.apply();
            QCOMPARE(world.writes(), QStringList());
        }
    }

    void torque()
    {
        ProfileWorld world(m_catalog, servosOf(2), profileOf(2));
        world.setUp({{1, u"Shutdown"_s, 0}, {2, u"Position P Gain"_s, 1}});
        for (int id = 1; id <= 2; ++id)
            world.bus.servo(id, ProfileRate)->write(u"Torque Enable", 1);
        (void)world.apply();
        QVERIFY(!world.isDone);
        QVERIFY2(world.why.contains(u"j1 (ID 1) is under torque"), qPrintable(world.why));
        QCOMPARE(world.writes(), QStringList{u"2:84"_s}); // RAM isn't locked
        ProfileApplyOptions options;
        options.mayTurnTorqueOff = true;
        (void)world.apply(options);
        QVERIFY(world.isDone);
        QCOMPARE(world.bus.servo(1, ProfileRate)->value(u"Torque Enable"), 0); // stays so unless it is asked for
        world.setUp({{1, u"Shutdown"_s, 0}});
        world.bus.servo(1, ProfileRate)->write(u"Torque Enable", 1);
        options.putTorqueBack = true;
        (void)world.apply(options);
        QVERIFY(world.isDone);
        QCOMPARE(world.bus.servo(1, ProfileRate)->value(u"Torque Enable"), 1);
        QCOMPARE(world.writes().front(), u"1:64"_s);
        QCOMPARE(world.writes().back(), u"1:64"_s);
    }

    void selectedJoints()
    {
        ProfileWorld world(m_catalog, servosOf(3), profileOf(3));
        world.setUp({{1, u"Shutdown"_s, 0}, {2, u"Shutdown"_s, 0}, {3, u"Shutdown"_s, 0}});
        ProfileApplyOptions options;
        options.joints = {1};
        (void)world.apply(options);
        QCOMPARE(world.writes(), QStringList{u"2:63"_s});
    }

    void refusesWhatCantBe()
    {
        ProfileWorld world(m_catalog, servosOf(1), oneJoint("      Shutdown: 0\n      Profile Velocity: 200 ms\n"));
        (void)world.apply();
        QVERIFY2(world.why.startsWith(u"f.yaml:9:25: a: \"ms\" does not fit"), qPrintable(world.why));
        QCOMPARE(world.writes(), QStringList());
        ProfileWorld old(m_catalog, u"XM430-W350/40@1000000:1"_s, oneJoint("      Shutdown: 0\n      Startup Configuration: 1\n"));
        (void)old.apply();
        QVERIFY2(old.why.startsWith(u"f.yaml:9:30: a: this firmware has no Startup Configuration"), qPrintable(old.why));
        QCOMPARE(old.writes(), QStringList());
    }

    void othersGoOn()
    {
        ProfileWorld world(m_catalog, u"XM430-W350@1000000:1,XL430-W250@1000000:2,XM430-W350@1000000:4"_s, profileOf(4));
        world.bus.servo(1, ProfileRate)->write(u"Shutdown", 0);
        (void)world.apply();
        QVERIFY(!world.isDone);
        QVERIFY2(world.why.contains(u"j2: a XL430-W250 is there"), qPrintable(world.why));
        QVERIFY2(world.why.contains(u"j3: "), qPrintable(world.why));
        QCOMPARE(world.bus.servo(1, ProfileRate)->value(u"Shutdown"), 52);
        QCOMPARE(world.bus.servo(4, ProfileRate)->value(u"Position P Gain"), 900);
    }

    void noted()
    {
        ProfileWorld world(m_catalog, servosOf(2), profileOf(2));
        world.setUp({{1, u"Shutdown"_s, 0}, {2, u"Position P Gain"_s, 1}});
        Journal journal;
        ProfileApplyHooks hooks;
        QStringList told;
        hooks.begun = [&](const JointApply &joint) { told << joint.name; };
        hooks.writes = [&](const JointApply &joint) {
            JournalEntry as;
            as.by = JournalAuthor::Profile;
            as.device = journalDevice(joint.found, joint.table->model(), u"sim"_s);
            return dynascope::noted(&journal, as, joint.table);
        };
        (void)world.apply({}, hooks);
        QCOMPARE(told, QStringList({u"j1"_s, u"j2"_s}));
        QCOMPARE(journal.entries().size(), 2U);
        const JournalEntry &entry = journal.entries().front();
        QCOMPARE(entry.by, JournalAuthor::Profile);
        QCOMPARE(entry.state, JournalState::Done);
        QCOMPARE(entry.changes.front().name, u"Shutdown"_s);
        QCOMPARE(entry.changes.front().before, Bytes{0});
        QCOMPARE(entry.changes.front().after, Bytes{52});
        QCOMPARE(entry.device.id, 1);
    }

    void stopEndsIt()
    {
        ProfileWorld world(m_catalog, servosOf(3), profileOf(3));
        world.setUp({{1, u"Shutdown"_s, 0}, {2, u"Shutdown"_s, 0}, {3, u"Shutdown"_s, 0}});
        ProfileApplyHooks hooks;
        hooks.ended = [&](const JointApply &, const Result<SettingsOutcome> &) { world.stop = true; };
        const ProfileOutcome outcome = world.apply({}, hooks);
        QVERIFY(outcome.ended && outcome.ended->kind == ErrorKind::Stopped);
        QCOMPARE(world.writes(), QStringList{u"1:63"_s});
    }

    /// At another baud rate: moved by a plan of its own, then compared anew.
    void moved()
    {
        ProfileWorld world(m_catalog, u"XM430-W350@1000000:1,XM430-W350@57600:2,XM430-W350@115200:3"_s, profileOf(3));
        const auto comparison = world.check();
        QVERIFY(comparison);
        auto plan = planProfileMoves(world.profile, *comparison, {});
        QVERIFY2(plan, plan ? "" : qPrintable(plan.error().text));
        QCOMPARE(plan->steps.size(), 2U);
        {
            MortalLine line(world.bus, ProfileRate);
            Bus program(line);
            DirectContext context(program);
            const auto checked = checkMoves(context, *plan);
            QVERIFY2(checked, checked ? "" : qPrintable(checked.error().text));
            const auto moved = moveDevices(context, *plan, {});
            QVERIFY2(moved, moved ? "" : qPrintable(moved.error().text));
        }
        world.bus.advanceTo(world.bus.now() + 1s);
        const auto after = world.check();
        QCOMPARE(after->count(JointComparison::State::Differs), 3U);
        (void)world.apply();
        QVERIFY2(world.isDone, qPrintable(world.why));
        QCOMPARE(world.wrong(), QStringList());
        QVERIFY(planProfileMoves(world.profile, *world.check(), {})->isOver());
    }

private:
    static std::vector<std::int64_t> valuesOf(sim::Servo &servo)
    {
        std::vector<std::int64_t> values;
        for (const Field &field : servo.table().fields())
            values.push_back(servo.value(field.name));
        return values;
    }

    /// Of RAM what it is after power-up, too, where that has gone.
    static void checkOldOrNew(sim::Servo &servo, const ProfileJoint &joint, const std::vector<std::int64_t> &before,
                              bool lostPower)
    {
        const std::vector<WantedValue> wanted = wantedValues(joint, servo.table(), {});
        const auto fields = servo.table().fields();
        const Field *mode = servo.table().find(Known::OperatingMode);
        for (std::size_t i = 0; i < fields.size(); ++i) {
            const Field &field = fields[i];
            if (!mayBeInProfile(profileUse(servo.table(), field)))
                continue;
            const std::int64_t value = servo.value(field.name);
            const auto at = std::ranges::find(wanted, &field, &WantedValue::field);
            const bool isNew = at != wanted.end() && *at->raw == value;
            const bool isReset = (lostPower && field.area == Area::Ram) || mode->resets.contains(field.name);
            QVERIFY2(value == before[i] || isNew || isReset,
                     qPrintable(u"%1 %2 is %3"_s.arg(joint.name, field.name).arg(value)));
        }
    }

    static bool hasReason(const ProfileOutcome &outcome)
    {
        return std::ranges::any_of(outcome.joints, [](const JointOutcome &joint) {
            return joint.outcome && (joint.outcome->ended || joint.outcome->count(SettingState::Failed) > 0);
        });
    }

    const Catalog m_catalog = builtInCatalog();
};

DYNASCOPE_CORE_TEST(TestProfileApply)
#include "tst_profileapply.moc"
