// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/builtincatalog.h"
#include "tests/support/profileworld.h"
#include "tests/support/testmain.h"

using namespace dynascope;
using namespace dynascope::test;
using namespace Qt::StringLiterals;
using namespace std::chrono_literals;

namespace {

QString unread(const ProfileComparison &comparison)
{
    QString text;
    for (const JointComparison &joint : comparison.joints)
        text += joint.isReadable() ? QString() : u"; "_s + joint.name + u": "_s + joint.why;
    return text;
}

} // namespace

/// A profile beside a simulated bus, in virtual time.
class TestProfileCheck : public QObject
{
    Q_OBJECT

private slots:
    void findsExactlyWhatDeviates()
    {
        ProfileWorld world(m_catalog, servosOf(8), profileOf(8));
        world.setUp();
        auto clean = world.check();
        QVERIFY2(clean, clean ? "" : qPrintable(clean.error().text));
        QCOMPARE(differences(*clean), QStringList());
        QVERIFY(clean->isAsWanted());
        world.setUp(twelveDeviations());
        const auto found = world.check();
        QVERIFY(found && !found->isAsWanted());
        QCOMPARE(differences(*found),
                 QStringList({u"j1 Operating Mode: 4 -> 3"_s, u"j1 Position P Gain: 640 -> 900"_s,
                              u"j2 Return Delay Time: 250 -> 0"_s, u"j2 Max Position Limit: 4000 -> 4095"_s,
                              u"j3 Shutdown: 0 -> 52"_s, u"j3 Profile Velocity: 50 -> 100"_s,
                              u"j4 Temperature Limit: 60 -> 80"_s, u"j5 Velocity Limit: 200 -> 480"_s,
                              u"j6 Drive Mode: 1 -> 0"_s, u"j6 Position D Gain: 100 -> 10"_s,
                              u"j7 Current Limit: 500 -> 1193"_s, u"j8 PWM Limit: 800 -> 885"_s}));
        QCOMPARE(found->count(JointComparison::State::Differs), 8U);
        QCOMPARE(world.writes(), QStringList());
        const RegisterComparison &limit = found->joints[1].rows[7];
        QCOMPARE(limit.name, u"Max Position Limit"_s);
        QCOMPARE(limit.held->text, u"351.56 °"_s);
        QCOMPARE(limit.wanted->unit, u"deg"_s);
        QCOMPARE(limit.line, 12);
    }

    /// Each side's text is in the unit that holds there.
    void unitsOfBothSides()
    {
        ProfileWorld world(m_catalog, servosOf(1),
                           "profile: 1\njoints:\n  - name: a\n    model: XM430-W350\n    id: 1\n    baud: 1000000\n"
                           "    registers:\n      Profile Velocity: 200 ms\n      Drive Mode: Time-based profile\n");
        world.bus.servo(1, ProfileRate)->write(u"Profile Velocity", 100);
        auto found = world.check();
        QVERIFY(found);
        QCOMPARE(found->joints[0].rows[0].held->text, u"22.9 rev/min"_s);
        QCOMPARE(found->joints[0].rows[0].wanted->text, u"200 ms"_s);
        // What only the device can tell to be wrong.
        ProfileWorld other(m_catalog, servosOf(1),
                           "profile: 1\njoints:\n  - name: a\n    model: XM430-W350\n    id: 1\n    baud: 1000000\n"
                           "    registers:\n      Profile Velocity: 200 ms\n");
        found = other.check();
        QVERIFY(found);
        QCOMPARE(found->joints[0].rows[0].state, RegisterComparison::State::Wrong);
        QVERIFY(found->joints[0].rows[0].why.contains(u"\"ms\" does not fit Profile Velocity"));
        QCOMPARE(found->joints[0].state, JointComparison::State::Differs);
    }

    void saysWhoIsNotThere()
    {
        const QByteArray yaml =
            "profile: 1\njoints:\n"
            "  - { name: there, model: XM430-W350, id: 1, baud: 1000000 }\n"
            "  - { name: gone, model: XM430-W350, id: 2, baud: 1000000 }\n"
            "  - { name: slow, model: XM430-W350, id: 3, baud: 1000000 }\n"
            "  - { name: other, model: XM430-W350, id: 4, baud: 1000000 }\n"
            "  - { name: old, model: XM430-W350, id: 5, baud: 1000000, firmware: 45 }\n"
            "  - { name: mute, model: XM430-W350, id: 6, baud: 1000000, registers: { Shutdown: 52 } }\n"
            "  - { name: lacks, model: XM430-W350, id: 7, baud: 1000000,\n"
            "      registers: { Startup Configuration: 0, Shutdown: 52 } }\n"
            "  - { name: away, model: XL430-W250, id: 1, baud: 57600 }\n"
            "  - { name: third, model: XL330-M288, id: 10, baud: 115200 }\n";
        ProfileWorld world(m_catalog,
                           u"XM430-W350@1000000:1,XM430-W350@115200:3,XL430-W250@1000000:4,XM430-W350/40@1000000:5,"
                           "XM430-W350@1000000:6,XM430-W350/40@1000000:7,XL430-W250@57600:1,XL330-M288@1000000:9,"
                           "XL330-M288@115200:10"_s,
                           yaml);
        world.bus.servo(6, ProfileRate)->write(u"Status Return Level", 0);
        const auto found = world.check();
        QVERIFY2(found, found ? "" : qPrintable(found.error().text));
        using State = JointComparison::State;
        const std::vector<State> states{State::AsWanted,    State::Missing,    State::AtOtherBaud, State::OtherModel,
                                        State::OldFirmware, State::Unreadable, State::Differs,     State::AsWanted,
                                        State::AsWanted};
        for (std::size_t i = 0; i < states.size(); ++i)
            QVERIFY2(found->joints[i].state == states[i],
                     qPrintable(found->joints[i].name + u": "_s + wordOf(found->joints[i].state)));
        QCOMPARE(found->joints[2].found->baudRate, 115200);
        QCOMPARE(found->joints[2].why, u"answers at 115200 bps, not at 1000000"_s);
        QCOMPARE(found->joints[3].why, u"a XL430-W250 is there, not a XM430-W350"_s);
        QCOMPARE(found->joints[4].why, u"its firmware is 40, the profile asks for 45 or newer"_s);
        QCOMPARE(found->joints[6].rows[0].state, RegisterComparison::State::NotThere);
        QCOMPARE(found->joints[6].rows[1].state, RegisterComparison::State::Same);
        QCOMPARE(found->others.size(), 1U); // the one at 115 200 is "slow", and no stranger
        QCOMPARE(int(found->others[0].id), 9);
        QCOMPARE(world.writes(), QStringList());
        ProfileReadOptions quick;
        quick.looksForOthers = false;
        QVERIFY(world.check(quick)->others.empty());
    }

    void doubtful()
    {
        ProfileWorld world(m_catalog, u"XM430-W350@1000000:1,XL430-W250@1000000:1,XM430-W350@1000000:2"_s,
                           profileOf(2));
        const auto found = world.check();
        QVERIFY2(found, found ? "" : qPrintable(found.error().text));
        QVERIFY(found->joints[0].state == JointComparison::State::Doubtful
                || found->joints[0].state == JointComparison::State::OtherModel
                || found->joints[0].state == JointComparison::State::Missing);
        QVERIFY(!found->isAsWanted());
    }

    /// Whatever befalls one answer, what is said is right: no value is invented, no deviation overlooked.
    void disturbed_data()
    {
        QTest::addColumn<sim::ReplyFault>("fault");
        QTest::addColumn<bool>("groups");
        using Kind = sim::ReplyFault::Kind;
        const auto row = [](const char *name, const sim::ReplyFault &fault) {
            QTest::addRow("%s", name) << fault << true;
        };
        row("lost", {.kind = Kind::Lost});
        row("damaged", {.kind = Kind::Damaged});
        row("late", {.kind = Kind::Late, .time = 30ms});
        row("much too late", {.kind = Kind::Late, .time = 300ms});
        row("cut", {.kind = Kind::Cut, .amount = 5});
        row("other length", {.kind = Kind::WrongLength, .amount = 1});
        row("noise before", {.kind = Kind::NoiseBefore, .amount = 7});
        row("twice", {.kind = Kind::Twice, .time = 1ms});
        row("stray before", {.kind = Kind::StrayBefore, .amount = 77});
        row("three lost", {.kind = Kind::Lost, .times = 3});
    }
    void disturbed()
    {
        QFETCH(sim::ReplyFault, fault);
        ProfileReadOptions quick;
        quick.looksForOthers = false;
        for (int skip = 0; skip < 40; ++skip) {
            ProfileWorld world(m_catalog, servosOf(8), profileOf(8));
            world.setUp(twelveDeviations());
            fault.skip = skip;
            world.bus.setFaults({.replies = {fault}});
            const auto found = world.check(quick);
            QVERIFY2(found, found ? "" : qPrintable(found.error().text));
            QCOMPARE(found->joints.size(), 8U);
            const bool allRead = std::ranges::all_of(found->joints, &JointComparison::isReadable);
            if (allRead)
                QCOMPARE(differences(*found).size(), 12);
            for (const JointComparison &joint : found->joints) {
                QVERIFY2(joint.isReadable() || !joint.why.isEmpty(), qPrintable(joint.name));
                for (const RegisterComparison &each : joint.rows)
                    QVERIFY2(
                        !each.held
                            || each.held->raw
                                   == world.bus.servo(static_cast<int>(joint.joint) + 1, ProfileRate)->value(each.name),
                        qPrintable(joint.name + u' ' + each.name));
            }
            // Of what stands still for longer than anybody waits the reason is said.
            QVERIFY2(allRead || fault.times > 1 || fault.time > 100ms,
                     qPrintable(u"not read after reply %1"_s.arg(skip) + unread(*found)));
        }
    }

    void endsWhereItIsTold()
    {
        for (int at = 0; at < 50; ++at) {
            ProfileWorld world(m_catalog, servosOf(3), profileOf(3));
            MortalLine line(world.bus, ProfileRate);
            Bus program(line);
            DirectContext context(program);
            int left = at;
            context.atCheckpoint = [&]() -> Result<void> {
                return left-- > 0 ? Result<void>() : failure(ErrorKind::Cancelled, u"enough"_s);
            };
            const auto reading = readForProfile(context, planProfileReading(world.profile, m_catalog));
            if (reading) {
                QVERIFY(at > 2);
                return;
            }
            QCOMPARE(reading.error().kind, ErrorKind::Cancelled);
            QCOMPARE(line.baudRate(), ProfileRate);
        }
        QFAIL("it never came to its end");
    }

    /// 20 servos at 1 Mbps: how much of the time that it takes the wire is busy.
    void nearTheWiresLimit()
    {
        ProfileWorld world(m_catalog, servosOf(20), profileOf(20));
        world.setUp();
        ProfileReadOptions quick;
        quick.looksForOthers = false;
        const auto found = world.check(quick);
        QVERIFY(found && found->isAsWanted());
        const double ratio =
            static_cast<double>(world.statistics.busy.count()) / static_cast<double>(world.took.count());
        qInfo("20 servos in %.2f ms of simulated time, of which the wire is busy %.2f ms: %.3f; %lld exchanges",
              static_cast<double>(world.took.count()) / 1e6, static_cast<double>(world.statistics.busy.count()) / 1e6,
              ratio, static_cast<long long>(world.statistics.exchanges));
        QVERIFY2(ratio > 0.8, qPrintable(QString::number(ratio)));
    }

private:
    const Catalog m_catalog = builtInCatalog();
};

DYNASCOPE_CORE_TEST(TestProfileCheck)
#include "tst_profilecheck.moc"
