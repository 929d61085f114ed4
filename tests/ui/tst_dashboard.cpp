// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/uitest.h"
#include "tests/support/workbenchfixture.h"
#include "ui/dashboard/alarmmodel.h"
#include "ui/dashboard/dashboarddelegate.h"
#include "ui/dashboard/dashboarddialog.h"
#include "ui/dashboard/dashboardmodel.h"
#include "ui/devices/devicepanel.h"
#include "ui/mainwindow.h"

#include <QAbstractItemModelTester>
#include <QAction>
#include <QFileDialog>
#include <QHeaderView>
#include <QLabel>
#include <QScrollBar>
#include <QSettings>
#include <QSignalSpy>
#include <QStackedWidget>
#include <QTemporaryDir>
#include <QToolButton>
#include <QTreeView>

using namespace dynascope;
using namespace std::chrono_literals;

namespace {

constexpr int Baud = 1'000'000;

/// Six servos of which a test says what they say; nothing is polled.
struct Bench : test::WorkbenchFixture {
    explicit Bench(int servos = 6) : WorkbenchFixture(named(servos))
    {
        line = &session.open(QStringLiteral("sim"), Baud);
        for (int id = 1; id <= servos; ++id) {
            Found found;
            found.id = static_cast<std::uint8_t>(id);
            found.baudRate = Baud;
            found.modelNumber = 1020;
            found.firmware = 45;
            line->heard(found);
        }
        if (!QTest::qWaitFor([this] { return line->state() == BusThread::State::Open; }))
            qFatal("not open");
    }

    static QString named(int servos)
    {
        QStringList all;
        for (int id = 1; id <= servos; ++id)
            all << QStringLiteral("XM430-W350@1000000:%1").arg(id);
        return all.join(u',');
    }
    Device &servo(int id) { return *device(id, Baud); }
    void say(int id, QStringView name, std::int64_t raw, LineTime at = 1s)
    {
        const Field *field = servo(id).table().find(name);
        PollValue value;
        value.device = servo(id).key();
        value.address = field->address;
        value.length = field->size;
        value.data = bytesFromRaw(*field, raw);
        value.at = at;
        servo(id).take(value);
    }
    void warm(int id, int degrees) ///< two readings, as alarms want them
    {
        say(id, u"Present Temperature", degrees, clock += 1s);
        alarms.look();
        say(id, u"Present Temperature", degrees, clock += 2s);
        alarms.look();
    }

    AlarmWatch alarms{session, monitor};
    LineSession *line = nullptr;
    LineTime clock = 100s;
};

} // namespace

/// All devices at a glance.
class TestDashboard : public QObject
{
    Q_OBJECT

private slots:
    void init() { QSettings().clear(); }

    void theWorstStandsOnTopAndNothingJumps()
    {
        Bench bench;
        DashboardModel model(bench.session, bench.alarms);
        const QAbstractItemModelTester tester(&model, QAbstractItemModelTester::FailureReportingMode::QtTest);
        QSignalSpy moves(&model, &QAbstractItemModel::layoutChanged);
        model.refresh(0s);
        QCOMPARE(ids(model), QStringLiteral("1 2 3 4 5 6"));
        const QPersistentModelIndex fourth = model.index(3, 2);
        bench.say(4, u"Hardware Error Status", 0x20);
        bench.alarms.look();
        model.refresh(10s);
        QCOMPARE(ids(model), QStringLiteral("4 1 2 3 5 6"));
        QCOMPARE(fourth.row(), 0);
        QCOMPARE(moves.count(), 1);
        bench.warm(2, 75);
        model.refresh(10s + 500ms); // only half a second later
        QCOMPARE(ids(model), QStringLiteral("4 1 2 3 5 6"));
        QCOMPARE(severity(model, 2), Severity::Near); // but it is said
        model.refresh(11s);
        QCOMPARE(ids(model), QStringLiteral("4 2 1 3 5 6"));
        for (int i = 0; i < 20; ++i) { // figures alone move nothing
            bench.warm(5, 30 + i);
            bench.warm(2, 73 + i % 3);
            model.refresh(20s + i * 2s);
        }
        QCOMPARE(moves.count(), 2);
        bench.warm(3, 90);
        bench.servo(6).setState(Device::State::Silent);
        bench.alarms.look();
        model.refresh(90s);
        QCOMPARE(ids(model), QStringLiteral("4 6 3 2 1 5")); // fault, silent, beyond, near, good
        bench.line->forget(bench.servo(4).key());
        model.refresh(91s);
        QCOMPARE(ids(model), QStringLiteral("6 3 2 1 5"));
        bench.session.close(*bench.line);
        model.refresh(92s);
        QCOMPARE(model.rowCount(), 0);
    }

    void saysValuesLimitsAndWhoseTheyAre()
    {
        Bench bench(2);
        DashboardModel model(bench.session, bench.alarms);
        bench.say(1, u"Present Temperature", 40);
        bench.say(1, u"Present Position", 1024);
        bench.say(1, u"Present Current", -100);
        bench.say(1, u"Present Input Voltage", 128);
        bench.alarms.look();
        model.refresh(0s);
        QCOMPARE(text(model, 0, DashboardColumn::Position), QStringLiteral("90.00 °"));
        QCOMPARE(text(model, 0, DashboardColumn::Load), QStringLiteral("−269 mA"));
        QCOMPARE(text(model, 0, DashboardColumn::Temperature), QStringLiteral("40 °C"));
        QCOMPARE(text(model, 0, DashboardColumn::Voltage), QStringLiteral("12.8 V"));
        QCOMPARE(text(model, 1, DashboardColumn::Voltage), QStringLiteral("–"));
        QCOMPARE(part(model, 0, DashboardColumn::Temperature), 0.5);
        QVERIFY(std::abs(part(model, 0, DashboardColumn::Load) - 100.0 / 1193) < 1e-9);
        QVERIFY(!model.index(1, static_cast<int>(DashboardColumn::Load)).data(DashboardModel::PartRole).isValid());
        const auto tip = [&] {
            return model.index(0, static_cast<int>(DashboardColumn::Temperature)).data(Qt::ToolTipRole).toString();
        };
        QVERIFY2(tip().contains(QStringLiteral("the factory's Temperature Limit is 80 °C")), qPrintable(tip()));
        QVERIFY(model.limitsSummary().contains(QStringLiteral("factory values")));
        for (const QStringView name : {u"Temperature Limit", u"Max Voltage Limit", u"Current Limit"})
            bench.say(1, name, 100);
        bench.alarms.look();
        model.refresh(1s);
        QVERIFY2(tip().contains(QStringLiteral("its Temperature Limit is 100 °C")), qPrintable(tip()));
        QVERIFY2(model.limitsSummary().contains(QStringLiteral("1 of 2")), qPrintable(model.limitsSummary()));
        model.setUnits(AngleUnit::Turns);
        model.refresh(2s);
        QVERIFY(text(model, 0, DashboardColumn::Position).startsWith(QStringLiteral("0.25")));
        QCOMPARE(model.summary(), QStringLiteral("2 devices · all good"));
        bench.say(2, u"Hardware Error Status", 0x04);
        bench.alarms.look();
        model.refresh(3s);
        QCOMPARE(model.summary(), QStringLiteral("2 devices · 1 hardware error"));
        QCOMPARE(text(model, 0, DashboardColumn::State), QStringLiteral("Overheating"));
        QVERIFY(model.index(0, 0).data(Qt::AccessibleTextRole).toString().endsWith(QStringLiteral("hardware error")));
    }

    void choosingARowIsChoosingItsDevice()
    {
        Bench bench(3);
        DashboardDialog dialog(bench.session, bench.monitor, bench.alarms, nullptr);
        QSignalSpy chosen(&dialog, &DashboardDialog::deviceChosen);
        dialog.show();
        auto *view = dialog.findChild<QTreeView *>(QStringLiteral("dashboardView"));
        QCOMPARE(view->model()->rowCount(), 3);
        const auto last = [&] { return chosen.back().front().value<Device *>(); };
        QTest::mouseClick(view->viewport(), Qt::LeftButton, {}, view->visualRect(view->model()->index(1, 2)).center());
        QCOMPARE(chosen.count(), 1);
        QCOMPARE(last(), &bench.servo(2));
        QTest::keyClick(view, Qt::Key_Down);
        QCOMPARE(last(), &bench.servo(3));
        // A row that goes takes the cursor along, and nobody has chosen anything.
        const int before = chosen.count();
        bench.line->forget(bench.servo(3).key());
        bench.alarms.look();
        QTRY_COMPARE(view->model()->rowCount(), 2);
        QCOMPARE(chosen.count(), before);
    }

    void listsAlarmsAndSavesWhatWasBefore()
    {
        Bench bench(2);
        DashboardDialog dialog(bench.session, bench.monitor, bench.alarms, nullptr);
        dialog.show();
        auto *view = dialog.findChild<QTreeView *>(QStringLiteral("alarmView"));
        const QAbstractItemModelTester tester(view->model(), QAbstractItemModelTester::FailureReportingMode::QtTest);
        auto *save = dialog.findChild<QToolButton *>(QStringLiteral("alarmSaveButton"));
        auto *forget = dialog.findChild<QToolButton *>(QStringLiteral("alarmForgetButton"));
        QVERIFY(dialog.findChild<QLabel *>(QStringLiteral("alarmEmpty"))->isVisible());
        QVERIFY(!save->isEnabled() && !forget->isEnabled());
        for (int i = 0; i < 20; ++i) {
            bench.say(1, u"Present Temperature", 40 + i, 100s + i * 1s);
            bench.alarms.look();
        }
        bench.say(1, u"Hardware Error Status", 0x20, 119s);
        bench.alarms.look();
        QCOMPARE(view->model()->rowCount(), 1);
        QVERIFY(view->isVisible());
        const auto cell = [view](int row, AlarmColumn column) {
            return view->model()->index(row, static_cast<int>(column)).data().toString();
        };
        QCOMPARE(cell(0, AlarmColumn::Device), bench.servo(1).displayName());
        QCOMPARE(cell(0, AlarmColumn::Cause), QStringLiteral("Overload"));
        QCOMPARE(cell(0, AlarmColumn::Cleared), QStringLiteral("lasts"));
        QVERIFY(!cell(0, AlarmColumn::Time).isEmpty());
        QTest::mouseClick(view->viewport(), Qt::LeftButton, {}, view->visualRect(view->model()->index(0, 2)).center());
        QVERIFY(save->isEnabled());
        const QTemporaryDir folder;
        const QString path = folder.filePath(QStringLiteral("alarm.csv"));
        QTest::mouseClick(save, Qt::LeftButton);
        auto *files = dialog.findChild<QFileDialog *>();
        QVERIFY(files);
        emit files->fileSelected(path);
        files->close();
        QTRY_VERIFY(QFile::exists(path));
        QFile file(path);
        QVERIFY(file.open(QIODevice::ReadOnly));
        const QStringList lines = QString::fromUtf8(file.readAll()).split(u'\n', Qt::SkipEmptyParts);
        QVERIFY2(lines.front().contains(QStringLiteral("Present Temperature (°C)")), qPrintable(lines.front()));
        QVERIFY2(lines.front().endsWith(QStringLiteral(",Alarm: Overload")), qPrintable(lines.front()));
        QCOMPARE(lines.size(), 12); // heading, ten seconds, and the fault beside the last
        QVERIFY2(lines.back().endsWith(QStringLiteral(",1")), qPrintable(lines.back()));
        // The rows keep their place under the cursor when another comes.
        bench.say(2, u"Hardware Error Status", 0x01, 119s);
        bench.alarms.look();
        QCOMPARE(view->currentIndex().row(), 1);
        bench.say(1, u"Hardware Error Status", 0, 120s);
        bench.alarms.look();
        QVERIFY(cell(1, AlarmColumn::Cleared) != QStringLiteral("lasts"));
        QVERIFY(forget->isEnabled());
        QTest::mouseClick(forget, Qt::LeftButton);
        QCOMPARE(view->model()->rowCount(), 1);
        QCOMPARE(cell(0, AlarmColumn::Cause), QStringLiteral("Input voltage"));
    }

    void theWindowOpensItAndPollsForIt()
    {
        test::WorkbenchFixture bench;
        MainWindow window(bench.workbench());
        window.show();
        window.connectTo(QStringLiteral("sim"), Baud);
        QTRY_COMPARE(bench.session.devices().size(), std::size_t(3));
        QVERIFY(!bench.monitor.isGlancing());
        QTest::keyClick(&window, Qt::Key_G, Qt::ControlModifier);
        auto *dialog = window.findChild<DashboardDialog *>();
        QVERIFY(dialog && dialog->isVisible());
        QVERIFY(bench.monitor.isGlancing());
        QVERIFY(bench.monitor.watches().empty()); // nothing comes onto the plots
        auto *view = dialog->findChild<QTreeView *>(QStringLiteral("dashboardView"));
        QTRY_COMPARE(view->model()->rowCount(), 3);
        auto *panel = window.findChild<DevicePanel *>();
        for (const int row : {1, 0}) {
            QTest::mouseClick(view->viewport(), Qt::LeftButton, {},
                              view->visualRect(view->model()->index(row, 0)).center());
            QCOMPARE(panel->selectedDevices().size(), std::size_t(1));
            QCOMPARE(QString::number(panel->selectedDevices().front()->id()),
                     view->model()->index(row, static_cast<int>(DashboardColumn::Id)).data().toString());
        }
        window.findChild<QAction *>(QStringLiteral("dashboardAction"))->trigger(); // the same one again
        QCOMPARE(window.findChildren<DashboardDialog *>().size(), 1);
        dialog->close();
        QVERIFY(!bench.monitor.isGlancing());
        QTRY_VERIFY(!window.findChild<DashboardDialog *>());
    }

    void fitsIntoASmallWindowAndStandsStill()
    {
        Bench bench;
        DashboardDialog dialog(bench.session, bench.monitor, bench.alarms, nullptr);
        dialog.resize(960, 640);
        dialog.show();
        auto *view = dialog.findChild<QTreeView *>(QStringLiteral("dashboardView"));
        QCOMPARE(view->horizontalScrollBar()->maximum(), 0);
        QList<int> before;
        for (int column = 0; column < DashboardColumns; ++column)
            before << view->columnWidth(column);
        bench.say(1, u"Present Position", 1'000'000);
        bench.say(1, u"Present Current", -1193);
        bench.alarms.look();
        QTRY_VERIFY(view->model()
                        ->index(0, static_cast<int>(DashboardColumn::Load))
                        .data()
                        .toString()
                        .contains(QStringLiteral("mA")));
        for (int column = 0; column < DashboardColumns; ++column)
            QCOMPARE(view->columnWidth(column), before[column]);
        for (int column = 0; column < DashboardColumns; ++column)
            QVERIFY(!view->model()->headerData(column, Qt::Horizontal, Qt::ToolTipRole).toString().isEmpty());
    }

    void sayWhatBelongsThere()
    {
        test::WorkbenchFixture bench;
        AlarmWatch watch(bench.session, bench.monitor);
        DashboardDialog dialog(bench.session, bench.monitor, watch, nullptr);
        dialog.show();
        QVERIFY(dialog.findChild<QLabel *>(QStringLiteral("dashboardEmpty"))->isVisible());
        QVERIFY(dialog.findChild<QLabel *>(QStringLiteral("alarmEmpty"))->isVisible());
    }

private:
    static QString text(const DashboardModel &model, int row, DashboardColumn column)
    {
        return model.index(row, static_cast<int>(column)).data().toString();
    }
    static double part(const DashboardModel &model, int row, DashboardColumn column)
    {
        return model.index(row, static_cast<int>(column)).data(DashboardModel::PartRole).toDouble();
    }
    static Severity severity(const DashboardModel &model, int id)
    {
        for (int row = 0; row < model.rowCount(); ++row) {
            if (model.row(row)->id == id)
                return model.row(row)->severity;
        }
        return Severity::Unknown;
    }
    static QString ids(const DashboardModel &model)
    {
        QStringList all;
        for (int row = 0; row < model.rowCount(); ++row)
            all << QString::number(model.row(row)->id);
        return all.join(u' ');
    }
};

DYNASCOPE_UI_TEST(TestDashboard)
#include "tst_dashboard.moc"
