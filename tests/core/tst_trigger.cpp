// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/trigger.h"
#include "tests/support/testmain.h"

using namespace dynascope;
using namespace std::chrono_literals;

Q_DECLARE_METATYPE(dynascope::TriggerSettings::Kind)

namespace {

TriggerSettings settings(TriggerSettings::Kind kind, double level, double hysteresis = 0,
    TriggerSettings::Mode mode = TriggerSettings::Mode::Normal)
{
    TriggerSettings made;
    made.kind = kind;
    made.mode = mode;
    made.level = level;
    made.hysteresis = hysteresis;
    made.before = 20ms;
    made.after = 30ms;
    return made;
}

/// A sample each 10 ms.
struct Feed {
    History history;
    Trigger trigger;
    std::vector<LineTime> shown;

    void add(std::initializer_list<std::int32_t> values)
    {
        for (const std::int32_t value : values) {
            const LineTime at = history.isEmpty() ? LineTime(0) : history.last().at + 10ms;
            history.append(at, value);
            step(at);
        }
    }
    void step(LineTime now)
    {
        std::size_t budget = 1000;
        if (trigger.advance(&history, now, budget) && trigger.shown())
            shown.push_back(*trigger.shown());
    }
};

using Kind = TriggerSettings::Kind;
using Mode = TriggerSettings::Mode;

} // namespace

class TestTrigger : public QObject
{
    Q_OBJECT

private slots:
    void edges_data()
    {
        QTest::addColumn<TriggerSettings::Kind>("kind");
        QTest::addColumn<QList<int>>("milliseconds");
        QTest::newRow("rising") << Kind::Rising << QList<int>{15, 95};
        QTest::newRow("falling") << Kind::Falling << QList<int>{55, 135};
        QTest::newRow("either") << Kind::Either << QList<int>{15, 55, 95, 135};
    }
    void edges()
    {
        QFETCH(TriggerSettings::Kind, kind);
        QFETCH(QList<int>, milliseconds);
        Feed feed;
        feed.trigger.set(settings(kind, 50));
        feed.trigger.arm(0ms);
        feed.add({0, 0, 100, 100, 100, 100, 0, 0, 0, 0, 100, 100, 100, 100, 0, 0, 0, 0, 0});
        QList<int> found;
        for (const LineTime at : feed.shown)
            found << int(at / 1ms);
        QCOMPARE(found, milliseconds);
    }

    void noiseWithinTheHysteresisDoesntFire()
    {
        Feed feed;
        feed.trigger.set(settings(Kind::Rising, 50, 20));
        feed.trigger.arm(0ms);
        feed.add({49, 51, 49, 52, 40, 55, 31, 60, 70, 70, 70, 70});
        QVERIFY(feed.shown.empty());
        feed.add({29, 60, 70, 70, 70, 70});
        QCOMPARE(feed.shown.size(), std::size_t(1));
        Feed plain;
        plain.trigger.set(settings(Kind::Rising, 50));
        plain.trigger.arm(0ms);
        plain.add({49, 51, 49, 49, 49});
        QCOMPARE(plain.shown.size(), std::size_t(1));
        plain.add({50, 50, 50, 50}); // from below to the level
        QCOMPARE(plain.shown.size(), std::size_t(2));
        plain.add({51, 51, 51, 51}); // and not from it
        QCOMPARE(plain.shown.size(), std::size_t(2));
    }

    void whatFollowsIsWaitedFor()
    {
        Feed feed;
        feed.trigger.set(settings(Kind::Rising, 50));
        feed.trigger.arm(0ms);
        feed.add({0, 100, 100, 100}); // fires at 5 ms, until 35 ms
        QVERIFY(feed.shown.empty());
        QCOMPARE(feed.trigger.state(), Trigger::State::Filling);
        feed.add({100});
        QCOMPARE(feed.shown.size(), std::size_t(1));
        QCOMPARE(feed.trigger.state(), Trigger::State::Armed);
    }

    void singleFiresOnce()
    {
        Feed feed;
        feed.trigger.set(settings(Kind::Rising, 50, 0, Mode::Single));
        feed.trigger.arm(0ms);
        feed.add({0, 100, 100, 100, 100, 0, 100, 100, 100, 100, 100});
        QCOMPARE(feed.shown, std::vector{LineTime(5ms)});
        QCOMPARE(feed.trigger.state(), Trigger::State::Done);
        QVERIFY(feed.trigger.shown() == LineTime(5ms));
        feed.trigger.arm(feed.history.last().at);
        QVERIFY(!feed.trigger.shown());
        feed.add({0, 100, 100, 100, 100});
        QCOMPARE(feed.shown.size(), std::size_t(2));
    }

    void autoGoesLiveAgain()
    {
        Feed feed;
        feed.trigger.set(settings(Kind::Rising, 50, 0, Mode::Auto));
        feed.trigger.arm(0ms);
        feed.add({0, 100, 100, 100, 100, 100});
        QVERIFY(feed.trigger.shown());
        feed.step(feed.history.last().at + Trigger::Patience / 2);
        QVERIFY(feed.trigger.shown());
        feed.step(feed.history.last().at + Trigger::Patience + 1s);
        QVERIFY(!feed.trigger.shown());
        QCOMPARE(feed.trigger.state(), Trigger::State::Armed);
    }

    void nothingFiresAcrossAGapNorBeforeItWasArmed()
    {
        Feed feed;
        feed.trigger.set(settings(Kind::Rising, 50));
        feed.add({0, 100, 100, 0, 0});
        feed.trigger.arm(feed.history.last().at);
        feed.add({0, 0});
        feed.history.appendGap(1s);
        feed.add({100, 100, 100, 100, 100});
        QVERIFY(feed.shown.empty());
        feed.history = History(); // cleared
        feed.add({100, 100, 0, 0});
        feed.step(10s);
        QVERIFY(feed.shown.empty());
    }

    void eventsFire()
    {
        Feed feed;
        feed.trigger.set(settings(Kind::Event, 50));
        feed.trigger.arm(0ms);
        feed.add({0, 100, 0, 100, 0, 100});
        QVERIFY(feed.shown.empty());
        feed.trigger.event(52ms);
        feed.trigger.event(53ms); // is part of what is shown
        feed.add({0, 0, 0, 0, 0});
        QCOMPARE(feed.shown, std::vector{LineTime(52ms)});
        feed.trigger.disarm();
        feed.trigger.event(200ms);
        QCOMPARE(feed.trigger.state(), Trigger::State::Off);
    }
};

DYNASCOPE_CORE_TEST(TestTrigger)
#include "tst_trigger.moc"
