// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/uitest.h"
#include "tests/ui/plotfixture.h"
#include "ui/plot/csvsave.h"
#include "ui/plot/deriveddialog.h"

#include <QAbstractItemModelTester>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QDoubleSpinBox>
#include <QLineEdit>
#include <QMenu>
#include <QSignalSpy>
#include <QSpinBox>
#include <QTemporaryDir>

using namespace dynascope;
using namespace std::chrono_literals;

namespace {

QAction *actionOf(const QMenu &menu, const QString &text)
{
    for (QAction *action : menu.actions()) {
        if (action->text().remove(u'&') == text)
            return action;
    }
    return nullptr;
}

struct DerivedBench : PlotBench {
    Watch goal = watch(first, "Goal Position");
    Watch present = watch(first, "Present Position");

    void samples(int from, int to)
    {
        for (int i = from; i < to; ++i) {
            sample(goal, 10ms * i, 2048);
            sample(present, 10ms * i, 2048 - 10 * i);
        }
    }
    QString value(int row) const { return model().index(row).data(TraceModel::ValueRole).toString(); }
    QString unit(int row) const { return model().index(row).data(TraceModel::UnitRole).toString(); }
    QString name(int row) const { return model().index(row).data(TraceModel::FieldRole).toString(); }
};

Derivation derivation(Derivation::Kind kind, LineTime span = {})
{
    Derivation made;
    made.kind = kind;
    made.span = span;
    return made;
}

} // namespace

class TestPlotDerived : public QObject
{
    Q_OBJECT

private slots:
    void goalLessPresentIsOneClick()
    {
        DerivedBench bench;
        bench.area.addTrace(bench.present);
        const QAbstractItemModelTester tester(&bench.model());
        QMenu menu;
        bench.list().addDerivedActions(menu);
        QVERIFY(actionOf(menu, QStringLiteral("Add Goal − Present")));
        actionOf(menu, QStringLiteral("Add Goal − Present"))->trigger();
        QCOMPARE(bench.model().rowCount(), 2);
        QCOMPARE(bench.name(1), QStringLiteral("Goal − Present Position"));
        QVERIFY(bench.monitor.isWatched(bench.goal)); // though only its difference is shown
        bench.samples(0, 101);
        QTRY_COMPARE(bench.value(1), QStringLiteral("87.89")); // 1000 pulses
        QCOMPARE(bench.unit(1), QStringLiteral("°"));
        bench.samples(101, 103);
        QTRY_COMPARE(bench.value(1), QStringLiteral("89.65"));
        QMenu again;
        bench.list().addDerivedActions(again);
        QVERIFY(!actionOf(again, QStringLiteral("Add Goal − Present"))->isEnabled()); // it is there
        bench.area.removeTrace(bench.present);
        QVERIFY(bench.monitor.isWatched(bench.present)); // still needed
        emit bench.area.panels().front()->removeRequested({bench.model().key(0)});
        QVERIFY(bench.monitor.watches().empty());
    }

    void theDialogAsksForTheRest()
    {
        DerivedBench bench;
        bench.area.addTrace(bench.present);
        bench.area.addTrace(bench.watch(bench.first, "Present Current"));
        bench.area.addTrace(bench.watch(bench.second, "Present Position"));
        DerivedDialog dialog(bench.model(), 0, &bench.area);
        QSignalSpy chosen(&dialog, &DerivedDialog::chosen);
        const QList<QComboBox *> boxes = dialog.findChildren<QComboBox *>();
        QCOMPARE(boxes[2]->count(), 1); // the only other one in degrees
        dialog.accept();
        QCOMPARE(chosen.count(), 0);
        boxes[1]->setCurrentIndex(2);
        dialog.findChild<QSpinBox *>()->setValue(200);
        QVERIFY(QMetaObject::invokeMethod(dialog.findChild<QDialogButtonBox *>(), "accepted"));
        QCOMPARE(chosen.count(), 1);
        const auto key = chosen.front().front().value<TraceKey>();
        QVERIFY(key == TraceKey(bench.present, derivation(Derivation::Kind::Average, 200ms)));
    }

    void derivativeAndScaleHaveTheirUnits()
    {
        DerivedBench bench;
        bench.area.addTrace({bench.present, derivation(Derivation::Kind::Derivative)});
        Derivation scaled = derivation(Derivation::Kind::Scaled);
        scaled.factor = 2;
        scaled.offset = 1024; // pulses: 90°
        bench.area.addTrace({bench.present, scaled});
        scaled.unit = QStringLiteral("cm");
        scaled.factor = 0.01;
        scaled.offset = 3;
        bench.area.addTrace({bench.present, scaled});
        bench.samples(0, 101);
        QTRY_COMPARE(bench.value(0), QStringLiteral("−87.89")); // 1000 pulses a second
        QCOMPARE(bench.unit(0), QStringLiteral("°/s"));
        QCOMPARE(bench.value(1), QStringLiteral("274.22")); // 2 × 92.11 + 90
        QCOMPARE(bench.value(2), QStringLiteral("13.48"));
        QCOMPARE(bench.unit(2), QStringLiteral("cm"));
        const UnitPreferences radians(AngleUnit::Radians);
        bench.area.setUnits(radians);
        QTRY_COMPARE(bench.unit(0), QStringLiteral("rad/s"));
        QVERIFY(bench.value(1).startsWith(QStringLiteral("4.78"))); // the same angle
        QCOMPARE(bench.value(2), QStringLiteral("13.48"));
    }

    void onlyOneUnitIsSubtracted()
    {
        DerivedBench bench;
        Derivation difference = derivation(Derivation::Kind::Difference);
        difference.other = bench.watch(bench.first, "Present Current");
        bench.area.addTrace({bench.present, difference});
        QCOMPARE(bench.model().rowCount(), 0);
        difference.other = {77, 1}; // nobody
        bench.area.addTrace({bench.present, difference});
        QCOMPARE(bench.model().rowCount(), 0);
    }

    void whatIsAddedWhilePausedIsMadeForWhatIsSeen()
    {
        DerivedBench bench;
        bench.area.addTrace(bench.present);
        bench.samples(0, 200);
        bench.area.setLive(false);
        bench.area.addTrace({bench.present, derivation(Derivation::Kind::Average, 50ms)});
        QTRY_VERIFY(bench.chart().traces()[1].isDrawn());
        QCOMPARE(bench.chart().traces()[1].history->size(), std::size_t(200));
    }

    void theySurviveARestartAndGoIntoCsv()
    {
        QByteArray state;
        {
            DerivedBench bench;
            QMenu menu;
            bench.area.addTrace(bench.goal);
            bench.list().addDerivedActions(menu);
            actionOf(menu, QStringLiteral("Add Goal − Present"))->trigger();
            bench.area.addTrace({bench.present, derivation(Derivation::Kind::Average, 70ms)});
            state = bench.area.saveState();
        }
        DerivedBench bench;
        bench.line.forget(bench.first.key());
        bench.area.restoreState(state);
        QCOMPARE(bench.model().rowCount(), 0);
        QVERIFY(bench.area.saveState() == state);
        Device &back = bench.line.heard({1, 1'000'000, 1020, 45, false, {}});
        QCOMPARE(bench.model().rowCount(), 3);
        QCOMPARE(bench.model().index(1).data(TraceModel::FieldRole).toString(), QStringLiteral("Goal − Present Position"));
        QVERIFY(bench.monitor.isWatched(bench.watch(back, "Present Position")));
        QVERIFY(bench.area.saveState() == state);

        bench.goal = bench.watch(back, "Goal Position");
        bench.present = bench.watch(back, "Present Position");
        bench.samples(0, 3);
        QTRY_COMPARE(bench.model().derivedHistory(1)->history().size(), std::size_t(3));
        const QTemporaryDir directory;
        CsvSave csv(bench.monitor);
        QSignalSpy written(&csv, &CsvSave::written);
        const auto looks = bench.model().drawn(bench.area.palette());
        csv.start(directory.filePath(QStringLiteral("some.csv")),
            {{bench.goal, looks[0]}, {bench.goal, looks[1], bench.model().derivedHistory(1)}}, 0s, 1s);
        QTRY_COMPARE(written.count(), 1);
        QFile file(directory.filePath(QStringLiteral("some.csv")));
        QVERIFY(file.open(QIODevice::ReadOnly));
        QCOMPARE(QString::fromUtf8(file.readAll()).section(u'\n', 1),
            QStringLiteral("0.000000,180.00,0.00\n0.010000,180.00,0.88\n0.020000,180.00,1.76\n"));
    }
};

DYNASCOPE_UI_TEST(TestPlotDerived)
#include "tst_plotderived.moc"
