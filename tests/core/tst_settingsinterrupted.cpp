// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/messages.h"
#include "core/sim/linefaults.h"
#include "tests/support/builtincatalog.h"
#include "tests/support/settingsworld.h"
#include "tests/support/testmain.h"

using namespace dynascope;
using namespace Qt::StringLiterals;
using test::MortalLine, test::SettingsWorld, test::Wanted;

namespace {

struct Case {
    QString servo;
    Wanted wanted;
};

/// Everything is at its end?
bool isDone(sim::Servo &servo, const Wanted &wanted)
{
    return std::ranges::all_of(wanted, [&](const auto &one) { return servo.value(one.first) == one.second; });
}

} // namespace
Q_DECLARE_METATYPE(Case)

/// Ended at every write, in every way: each register is old or new, and the same once more brings it to its end.
class TestSettingsInterrupted : public QObject
{
    Q_OBJECT

private slots:
    void atEachWrite_data()
    {
        QTest::addColumn<Case>("what");
        QTest::addColumn<QString>("end");
        const std::vector<std::pair<const char *, Case>> cases{
            {"XM430",
             {u"XM430-W350@57600:1"_s,
              {{u"Operating Mode"_s, 4},
               {u"Homing Offset"_s, -300},
               {u"Current Limit"_s, 600},
               {u"Position P Gain"_s, 640},
               {u"Profile Velocity"_s, 90},
               {u"LED"_s, 1}}}},
            {"XL-320",
             {u"XL-320@1000000:1"_s, {{u"Control Mode"_s, 1}, {u"Max Torque"_s, 1000}, {u"P Gain"_s, 40}}}},
            {"PRO",
             {u"H54-100-S500-R@57600:1"_s, {{u"Velocity Limit"_s, 9000}, {u"Position P Gain"_s, 33}}}},
            {"Y", {u"YM070-210-M001-RH@57600:1"_s, {{u"Velocity Limit"_s, 500}, {u"Position P Gain"_s, 33}}}}};
        for (const auto &[name, what] : cases) {
            for (const char *end : {"killed, its last packet arrives", "killed, its last packet is lost", "STOP",
                                    "cancelled", "power cut before", "power cut behind"})
                QTest::addRow("%s, %s", name, end) << what << QString::fromLatin1(end);
        }
    }
    void atEachWrite()
    {
        QFETCH(Case, what);
        QFETCH(QString, end);
        for (int at = 0; at < 40; ++at) {
            SettingsWorld world(m_catalog, what.servo);
            world.servo().write(u"Torque Enable", 1);
            std::map<QString, std::int64_t> old;
            for (const auto &[name, raw] : what.wanted)
                old[name] = world.servo().value(name);
            SettingsOptions options;
            options.mayTurnTorqueOff = options.putTorqueBack = true;
            const auto plan = test::planFor(world.servo(), what.wanted, options);
            QVERIFY2(plan, plan ? "" : qPrintable(plan.error().text));
            const bool wasReached = endAt(world, *plan, end, at);
            for (const auto &[name, raw] : what.wanted) {
                const std::int64_t now = world.servo().value(name);
                QVERIFY2(now == raw || now == old[name],
                         qPrintable(u"%1 is %2, ended at write %3"_s.arg(name).arg(now).arg(at)));
            }
            const auto again = world.apply(*plan);
            QVERIFY2(again && again->isDone(),
                     qPrintable(u"ended at write %1: %2"_s.arg(at).arg(again ? again->why : again.error().text)));
            QVERIFY2(isDone(world.servo(), what.wanted), qPrintable(QString::number(at)));
            const auto third = world.apply(*plan);
            QVERIFY(third && third->isDone());
            QCOMPARE(world.writes(), QStringList());
            if (!wasReached) {
                QVERIFY(at >= static_cast<int>(what.wanted.size()));
                return;
            }
        }
        QFAIL("it never came to its end");
    }

    /// An answer lost, late, damaged, cut, doubled; each of those that come.
    void aFaultyAnswer_data()
    {
        using Kind = sim::ReplyFault::Kind;
        QTest::addColumn<int>("kind");
        QTest::addColumn<int>("times");
        for (const auto &[name, kind] : std::vector<std::pair<const char *, Kind>>{{"lost", Kind::Lost},
                                                                                  {"late", Kind::Late},
                                                                                  {"damaged", Kind::Damaged},
                                                                                  {"cut", Kind::Cut},
                                                                                  {"twice", Kind::Twice}}) {
            for (const int times : {1, 4})
                QTest::addRow("%s, %d of them", name, times) << static_cast<int>(kind) << times;
        }
    }
    void aFaultyAnswer()
    {
        QFETCH(int, kind);
        QFETCH(int, times);
        const Wanted wanted{{u"Operating Mode"_s, 4}, {u"Current Limit"_s, 600}, {u"Position P Gain"_s, 640}};
        int done = 0;
        for (int skip = 0; skip < 30; ++skip) {
            SettingsWorld world(m_catalog, u"XM430-W350@57600:1"_s);
            world.servo().write(u"Torque Enable", 1);
            SettingsOptions options;
            options.mayTurnTorqueOff = options.putTorqueBack = true;
            const auto plan = test::planFor(world.servo(), wanted, options);
            sim::ReplyFault fault;
            fault.kind = static_cast<sim::ReplyFault::Kind>(kind);
            fault.skip = skip;
            fault.times = times;
            fault.amount = 6;
            fault.time = std::chrono::milliseconds(2);
            sim::LineFaults faults;
            faults.replies = {fault};
            world.bus.setFaults(faults);
            const auto outcome = world.apply(*plan);
            if (outcome && outcome->isDone()) {
                ++done;
                QVERIFY(isDone(world.servo(), wanted));
                QCOMPARE(world.servo().value(u"Torque Enable"), outcome->torqueIsBack ? 1 : 0);
            }
            world.bus.setFaults({});
            const auto again = world.apply(*plan);
            QVERIFY2(again && again->isDone(), qPrintable(u"%1: %2"_s.arg(skip).arg(
                                                   again ? again->why : again.error().text)));
            QVERIFY(isDone(world.servo(), wanted));
        }
        QVERIFY2(done >= (times == 1 ? 26 : 10), qPrintable(QString::number(done)));
    }

private:
    /// True where there was such a write.
    bool endAt(SettingsWorld &world, const SettingsPlan &plan, const QString &end, int at)
    {
        const bool isKill = end.startsWith(u"killed");
        MortalLine line(world.bus, plan.place.baudRate, at);
        line.setLastGoesOut(!end.endsWith(u"lost"));
        bool ended = false;
        world.atCheckpoint = [&]() -> Result<void> {
            return ended ? Result<void>(tl::unexpected(messages::cancelled())) : Result<void>();
        };
        const auto cutPower = [&] {
            line.advance(std::chrono::milliseconds(1)); // while its EEPROM is being written
            world.bus.advanceTo(line.now());
            world.servo().powerCycle();
        };
        if (end == u"STOP")
            line.setBefore([&] { world.stop = true; });
        else if (end == u"cancelled")
            line.setBefore([&] { ended = true; });
        else if (end == u"power cut before")
            line.setBefore(cutPower);
        else if (end == u"power cut behind")
            line.setBehind(cutPower);
        const auto outcome = world.apply(line, plan);
        world.atCheckpoint = {};
        world.stop = false;
        const bool wasReached = line.wasReached();
        if (isKill && wasReached && outcome && !outcome->ended)
            QTest::qFail("a killed program went on", __FILE__, __LINE__);
        world.bus.advanceTo(line.now() + std::chrono::seconds(1)); // it boots
        return wasReached;
    }

    const Catalog m_catalog = test::builtInCatalog();
};

DYNASCOPE_CORE_TEST(TestSettingsInterrupted)
#include "tst_settingsinterrupted.moc"
