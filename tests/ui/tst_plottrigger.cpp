// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/uitest.h"
#include "tests/ui/plotfixture.h"
#include "ui/plot/triggerdialog.h"

#include <QComboBox>
#include <QDialogButtonBox>

using namespace dynascope;
using namespace std::chrono_literals;

namespace {

struct TriggerBench : PlotBench {
    Watch position = watch(first, "Present Position");

    TriggerBench() { area.addTrace(position); }
    TriggerChoice choice(TriggerSettings::Mode mode, TriggerSettings::Kind kind = TriggerSettings::Kind::Rising) const
    {
        TriggerChoice made;
        made.trace = position;
        made.level = 90; // ° are 1024 pulses
        made.hysteresis = 1;
        made.settings.kind = kind;
        made.settings.mode = mode;
        made.settings.before = 100ms;
        made.settings.after = 200ms;
        return made;
    }
    /// From 0 to 2048 pulses at this moment, and 300 ms more.
    void jump(LineTime at)
    {
        sample(position, at - 400ms, 0);
        sample(position, at - 10ms, 0);
        sample(position, at + 10ms, 2048);
        sample(position, at + 300ms, 2048);
    }
    bool isShown(LineTime at) const
    {
        const TimeView view = chart().view();
        return !area.timeWindow().isLive() && std::abs((view.zero - at).count()) < LineTime(1ms).count()
            && view.from() <= at - 99ms && view.to() >= at + 199ms && view.to() - view.from() < 310ms;
    }
};

} // namespace

/// Trigger, event marks and colours.
class TestPlotTrigger : public QObject
{
    Q_OBJECT

private slots:
    void theViewStandsWhereItTriggered()
    {
        TriggerBench bench;
        bench.area.arm(bench.choice(TriggerSettings::Mode::Normal));
        QVERIFY(bench.action(QStringLiteral("Trigger"))->isChecked());
        bench.jump(10s);
        QTRY_VERIFY(bench.isShown(10s));
        bench.jump(20s); // armed again
        QTRY_VERIFY(bench.isShown(20s));
        bench.area.setLive(true);
        bench.area.setLive(false); // a person paused: that stays
        const TimeView view = bench.chart().view();
        bench.jump(30s);
        QTest::qWait(60);
        QVERIFY(bench.chart().view() == view);
        bench.area.setLive(true);
        QTRY_VERIFY(bench.isShown(30s));
        bench.action(QStringLiteral("Trigger"))->trigger();
        QVERIFY(bench.area.timeWindow().isLive());
    }

    void singleIsDoneAfterOne()
    {
        TriggerBench bench;
        bench.area.arm(bench.choice(TriggerSettings::Mode::Single));
        bench.jump(10s);
        QTRY_VERIFY(bench.isShown(10s));
        QVERIFY(!bench.action(QStringLiteral("Trigger"))->isChecked());
        bench.jump(20s);
        QTest::qWait(60);
        QVERIFY(bench.isShown(10s));
        bench.action(QStringLiteral("Trigger"))->trigger(); // once more
        QVERIFY(bench.area.timeWindow().isLive());
        bench.jump(30s);
        QTRY_VERIFY(bench.isShown(30s));
    }

    void theLevelIsDragged()
    {
        TriggerBench bench;
        bench.jump(10s); // an axis from 0 to 180 degrees
        bench.area.arm(bench.choice(TriggerSettings::Mode::Normal));
        PlotChart &chart = bench.chart();
        const double before = bench.area.trigger().choice().level;
        const auto placeOf = [&chart](double level) {
            const AxisRange &range = chart.scales().range(QStringLiteral("°"));
            const QRectF area = chart.plotArea();
            return QPointF(area.center().x(), area.bottom() - (level - range.minimum) / range.span() * area.height()).toPoint();
        };
        QTRY_VERIFY(!chart.grab().isNull() && chart.plotArea().contains(placeOf(before)));
        const QPoint from = placeOf(before);
        const QPoint to = placeOf(before + 40);
        QTest::mousePress(&chart, Qt::LeftButton, {}, from);
        QTest::mouseMove(&chart, (from + to) / 2);
        QTest::mouseMove(&chart, to);
        QTest::mouseRelease(&chart, Qt::LeftButton, {}, to);
        const double level = bench.area.trigger().choice().level;
        QVERIFY2(std::abs(level - (before + 40)) < 2, qPrintable(QString::number(level)));
        QVERIFY(bench.area.trigger().isOn());
        // A click on it moves nothing.
        QTest::mouseClick(&chart, Qt::LeftButton, {}, placeOf(level));
        QCOMPARE(bench.area.trigger().choice().level, level);
    }

    void withoutAChoiceItAsks()
    {
        TriggerBench bench;
        bench.action(QStringLiteral("Trigger"))->trigger();
        auto *dialog = bench.area.findChild<TriggerDialog *>();
        QVERIFY(dialog);
        QVERIFY(!bench.action(QStringLiteral("Trigger"))->isChecked());
        dialog->findChildren<QComboBox *>()[0]->setCurrentIndex(1);
        QVERIFY(QMetaObject::invokeMethod(dialog->findChild<QDialogButtonBox *>(), "accepted"));
        QVERIFY(bench.area.trigger().isOn());
        QVERIFY(bench.area.trigger().choice().settings.kind == TriggerSettings::Kind::Falling);
        QVERIFY(bench.area.trigger().choice().trace == TraceKey(bench.position));
    }

    void eventsAreMarkedAndTrigger()
    {
        TriggerBench bench;
        bench.area.arm(bench.choice(TriggerSettings::Mode::Single, TriggerSettings::Kind::Event));
        const Watch torque = bench.watch(bench.first, "Torque Enable");
        const auto read = [&](LineTime at, std::uint8_t value) {
            PollValue one;
            one.device = bench.first.key();
            one.address = 64;
            one.length = 1;
            one.data = {value};
            one.at = at;
            bench.first.take(one);
        };
        bench.sample(bench.position, 9s, 0);
        read(9s, 0);
        read(10s, 1);
        bench.sample(bench.position, 11s, 0);
        QTRY_VERIFY(bench.isShown(10s));
        QVERIFY(torque.field > 0);
        bench.chart().grab();
        const QRectF area = bench.chart().plotArea();
        const QPointF mark(area.left() + area.width() / 3, area.top() + 5); // 100 of 300 ms
        PlotMarks marks;
        marks.log = &bench.area.events();
        marks.devices = {bench.first.key()};
        QCOMPARE(marks.textAt(mark, bench.chart().view(), area), QStringLiteral("0.000 s · XM430-W350 #1 · Torque on"));
        QCOMPARE(marks.textAt(mark + QPointF(40, 0), bench.chart().view(), area), QString());
        marks.devices = {bench.second.key()};
        QCOMPARE(marks.textAt(mark, bench.chart().view(), area), QString());
    }

    void coloursStayWithTheField()
    {
        PlotBench bench;
        const Watch position = bench.watch(bench.first, "Present Position");
        const Watch current = bench.watch(bench.first, "Present Current");
        const Watch load = bench.watch(bench.second, "Present Load");
        bench.area.addTrace(position);
        bench.area.addTrace(current);
        const int color = bench.model().colorIndex(1);
        QVERIFY(color != bench.model().colorIndex(0));
        PlotPanel *lower = bench.area.addPanel();
        emit lower->watchesDropped({current});
        QCOMPARE(lower->model().colorIndex(0), color); // in every panel
        bench.area.removeTrace(position);
        bench.area.removeTrace(current);
        bench.area.addTrace(load);
        QVERIFY(bench.model(1).colorIndex(0) != color); // it is remembered to be another's
        bench.area.addTrace(current);
        QCOMPARE(bench.model(1).colorIndex(1), color);
    }

    void aRecordingsEventsFireAtTheirTime()
    {
        PlotBench bench;
        EventLog &log = bench.area.events();
        const auto event = [](LineTime at) {
            return LoggedEvent{at, LoggedEvent::Kind::Alert, 1, QStringLiteral("ID 1"), QStringLiteral("Overload")};
        };
        log.showRecorded({event(1s), event(5s), event(5s + 100ms), event(9s)});
        PlotTrigger trigger(log);
        TriggerChoice choice;
        choice.settings.kind = TriggerSettings::Kind::Event;
        choice.settings.after = 1s;
        trigger.choose(choice);
        trigger.setOn(true, 2s);
        const auto changes = [&trigger](LineTime now) {
            std::size_t budget = 100;
            return trigger.advance(nullptr, nullptr, now, budget);
        };
        QVERIFY(!changes(4s)); // what was before it was armed doesn't count, nor what is still to come
        QVERIFY(!changes(5s + 500ms)); // what follows it is wanted, too
        QVERIFY(changes(6s));
        QCOMPARE(trigger.shown().value_or(0s), LineTime(5s));
        QVERIFY(!changes(8s));
        QVERIFY(changes(4s)); // gone back: nothing is shown, and it is armed there
        QVERIFY(!trigger.shown());
        QVERIFY(changes(20s)); // a jump over all: one after the other
        QCOMPARE(trigger.shown().value_or(0s), LineTime(5s));
        QVERIFY(changes(20s));
        QCOMPARE(trigger.shown().value_or(0s), LineTime(9s));
        QVERIFY(!changes(30s));
    }

    void whatLivePlotsLoseDoesNotArmAnew()
    {
        TriggerBench bench;
        bench.area.arm(bench.choice(TriggerSettings::Mode::Single));
        bench.jump(10s);
        QTRY_VERIFY(bench.isShown(10s));
        QVERIFY(bench.area.trigger().isDone());
        bench.area.removeTrace(bench.position); // of what is plotted nothing is newer than 0 s now
        QTest::qWait(60);
        QVERIFY(bench.area.trigger().isDone());
    }

    void moreThanEightHavePatterns()
    {
        PlotBench bench;
        std::set<std::pair<QRgb, int>> looks;
        for (int field = 0; field < 32; ++field)
            bench.area.addTrace({bench.first.key(), field});
        for (const TraceData &trace : bench.chart().traces())
            looks.insert({trace.color.rgb(), trace.dash});
        QCOMPARE(looks.size(), std::size_t(32));
        QCOMPARE(bench.chart().traces()[7].dash, 0);
        QVERIFY(bench.chart().traces()[8].dash != 0);
        for (const int dash : {1, 2, 3}) {
            int ink = 0;
            for (int x = 0; x < 240; ++x)
                ink += traceInk(dash, x, 1);
            QVERIFY(ink > 80 && ink < 200);
            QCOMPARE(traceInk(dash, 14, 2), traceInk(dash, 7, 1)); // as long at 200 %
        }
    }
};

DYNASCOPE_UI_TEST(TestPlotTrigger)
#include "tst_plottrigger.moc"
