// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/restartsigns.h"
#include "tests/support/builtincatalog.h"
#include "tests/support/testmain.h"

using namespace dynascope;
using Verdict = TickSign::Verdict;

namespace {

struct Look {
    int ms = 0; ///< by the line's clock
    int tick = 0;
};
using Looks = std::vector<Look>;

} // namespace

Q_DECLARE_METATYPE(Looks)
Q_DECLARE_METATYPE(Verdict)

/// What tells of a restart, and what doesn't.
class TestRestartSigns : public QObject
{
    Q_OBJECT

private slots:
    void tick_data()
    {
        QTest::addColumn<Looks>("looks");
        QTest::addColumn<Verdict>("verdict"); // on the last of them
        const auto row = [](const char *name, Looks looks, Verdict verdict) {
            QTest::newRow(name) << looks << verdict;
        };
        row("the first look", {{1000, 40}}, Verdict::Runs);
        row("as time goes by", {{1000, 500}, {10'000, 9'500}}, Verdict::Runs);
        row("ten times a second", {{1000, 500}, {1100, 600}}, Verdict::Runs);
        row("an answer that waited for a busy host", {{1000, 500}, {1190, 600}}, Verdict::Runs);
        row("a clock that runs 1.5 % fast", {{0, 500}, {9'000, 9'635}}, Verdict::Runs);
        row("a clock that runs 1.5 % slow", {{0, 500}, {9'000, 9'365}}, Verdict::Runs);
        row("began anew, the last tick high", {{0, 20'000}, {9'000, 3'000}}, Verdict::Restarted);
        row("began anew, the last tick low", {{0, 4'000}, {9'000, 8'000}}, Verdict::Restarted);
        row("began anew just now", {{0, 12'000}, {9'000, 0}}, Verdict::Restarted);
        row("began anew between two quick looks", {{0, 12'000}, {600, 90}}, Verdict::Restarted);
        row("went round: a restart just then looks alike", {{0, 30'000}, {9'000, 6'232}}, Verdict::Unclear);
        row("went round, and is elsewhere", {{0, 30'000}, {9'000, 2'000}}, Verdict::Restarted);
        row("the very end, and on", {{0, 32'767}, {1, 0}}, Verdict::Unclear);
        row("where no restart would have it: the host's clock stood", {{0, 1'000}, {1'000, 20'000}}, Verdict::Unclear);
        row("a pause of 40 s, as expected", {{0, 1'000}, {40'000, 41'000 - 32'768}}, Verdict::Unclear);
        row("a pause of 40 s, elsewhere", {{0, 1'000}, {40'000, 20'000}}, Verdict::Restarted);
        row("an hour: its drift is more than a round", {{0, 1'000}, {3'600'000, 5'000}}, Verdict::Unclear);
        row("after an hour the next look is good", {{0, 1'000}, {3'600'000, 5'000}, {3'609'000, 14'000}}, Verdict::Runs);
        row("older news", {{2'000, 5'000}, {1'000, 4'000}}, Verdict::Runs);
        row("older news is no basis", {{2'000, 5'000}, {1'000, 4'000}, {3'000, 6'000}}, Verdict::Runs);
        row("the same answer twice", {{2'000, 5'000}, {2'000, 5'000}}, Verdict::Runs);
        row("of a tick that counts to 65 535", {{0, 40'000}, {9'000, 49'000}}, Verdict::Runs);
    }

    void tick()
    {
        QFETCH(Looks, looks);
        QFETCH(Verdict, verdict);
        TickSign sign;
        Verdict last = Verdict::Runs;
        for (const Look &look : looks)
            last = sign.take(std::chrono::milliseconds(look.ms), look.tick);
        QCOMPARE(last, verdict);
        sign.forget();
        QCOMPARE(sign.take({}, 0), Verdict::Runs); // the first again
    }

    /// Whenever the power goes within the 9 s between two looks, whatever the tick was: noticed, or said to be unclear.
    void everyMomentOfACut()
    {
        int unclear = 0, all = 0;
        for (int before = 200; before < TickSign::Period; before += 97) {
            for (int since = 0; since <= 8'500; since += 61) {
                TickSign sign;
                sign.take({}, before);
                const Verdict verdict = sign.take(std::chrono::milliseconds(9'000), since);
                const bool isJustAfterStart = before < 400 && since > 8'400; // no servo starts that fast
                QVERIFY2(verdict != Verdict::Runs || isJustAfterStart,
                         qPrintable(QStringLiteral("%1 then %2").arg(before).arg(since)));
                unclear += verdict == Verdict::Unclear;
                ++all;
            }
        }
        QVERIFY(unclear * 50 < all);
    }

    /// Whatever the tick was, a servo that runs is never said to have restarted.
    void noFalseAlarm()
    {
        for (int from = 0; from < TickSign::Period; from += 61) {
            for (const int elapsed : {1, 90, 1'000, 9'000, 10'000, 31'000, 33'000, 40'000, 200'000, 4'000'000}) {
                for (const int error : {-elapsed / 60, 0, elapsed / 60}) {
                    TickSign sign;
                    sign.take({}, from);
                    const auto tick = (from + std::int64_t(elapsed) + error) % TickSign::Period;
                    QVERIFY(sign.take(std::chrono::milliseconds(elapsed), tick) != Verdict::Restarted);
                }
            }
        }
    }

    void whoHasATick_data()
    {
        QTest::addColumn<int>("model");
        QTest::addColumn<int>("address");
        QTest::newRow("XM430-W350") << 1020 << 120;
        QTest::newRow("MX-28") << 30 << 120;
        QTest::newRow("PH54-200-S500-R") << 2020 << 568;
        QTest::newRow("XL-320") << 350 << -1;
        QTest::newRow("H54-200-S500-R") << 54024 << -1;
    }

    void whoHasATick()
    {
        QFETCH(int, model);
        QFETCH(int, address);
        const ControlTablePtr table = m_catalog.findOrRaw(model, 40);
        QVERIFY(!table->description().isRaw);
        const Field *field = tickField(*table);
        QCOMPARE(field ? field->address : -1, address);
    }

    void values_data()
    {
        QTest::addColumn<int>("torque"); // −1: has none
        QTest::addColumn<std::vector<SetReading>>("readings");
        QTest::addColumn<bool>("restarted");
        const auto row = [](const char *name, int torque, std::vector<SetReading> readings, bool restarted) {
            QTest::newRow(name) << torque << readings << restarted;
        };
        row("torque off alone", 0, {{33, 33, 10}}, false);
        row("torque off, and back at its initial value", 0, {{10, 33, 10}}, true);
        row("back at its initial value under torque", 1, {{10, 33, 10}}, false);
        row("one of two is kept", 0, {{10, 33, 10}, {7, 7, 0}}, false);
        row("both are gone", 0, {{10, 33, 10}, {0, 7, 0}}, true);
        row("one is elsewhere", 0, {{10, 33, 10}, {3, 7, 0}}, true);
        row("none is at its initial value", 0, {{11, 33, 10}, {3, 7, 0}}, false);
        row("of which none is known", 0, {{11, 33, {}}}, false);
        row("nothing read", 0, {}, false);
        row("no torque to be off", -1, {{10, 33, 10}}, true);
    }

    void values()
    {
        QFETCH(int, torque);
        QFETCH(std::vector<SetReading>, readings);
        const auto on = torque < 0 ? std::nullopt : std::optional(torque == 1);
        QTEST(looksRestarted(on, readings), "restarted");
    }

private:
    const Catalog m_catalog = test::builtInCatalog();
};

DYNASCOPE_CORE_TEST(TestRestartSigns)
#include "tst_restartsigns.moc"
