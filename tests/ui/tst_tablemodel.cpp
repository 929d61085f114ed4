// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/uitest.h"
#include "tests/ui/smalldevice.h"
#include "tests/ui/tablefixture.h"
#include "ui/table/fieldfiltermodel.h"
#include "ui/table/fieldtablemodel.h"
#include "ui/table/fieldwordsmodel.h"

#include <QAbstractItemModelTester>
#include <QMimeData>
#include <QSignalSpy>

using namespace dynascope;

class TestTableModel : public QObject
{
    Q_OBJECT

private slots:
    void printsOneDevice()
    {
        TableFixture fixture;
        const auto device = smallDevice(3);
        FieldTableModel model(fixture.actions());
        FieldWordsModel words;
        words.setSourceModel(&model);
        const QAbstractItemModelTester tester(&model, QAbstractItemModelTester::FailureReportingMode::QtTest);
        const QAbstractItemModelTester wordsTester(&words, QAbstractItemModelTester::FailureReportingMode::QtTest);
        QCOMPARE(printed(words), QStringList());
        TableFixture::set(device.get(), QStringLiteral("ID"), 3);
        TableFixture::set(device.get(), QStringLiteral("Operating Mode"), 3);
        TableFixture::set(device.get(), QStringLiteral("Max Position Limit"), 3072);
        TableFixture::set(device.get(), QStringLiteral("Goal Position"), -1024);
        TableFixture::set(device.get(), QStringLiteral("Present Input Voltage"), 121);
        fixture.watched = {{3, 5}};
        model.setDevices({device.get()});
        const QStringList expected{
            QStringLiteral("[EEPROM]"),
            QStringLiteral("ID | 7 | 3 |  | 1 | 0 … 252 | RW"),
            QStringLiteral("Operating Mode | 11 | 3 | Position | 3 |  | RW"),
            QStringLiteral("Max Position Limit | 48 | 3072 | 270.00 ° | 359.91 |  | RW"),
            QStringLiteral("[RAM]"),
            QStringLiteral("Torque Enable | 64 | ? |  | 0 |  | RW"),
            QStringLiteral("Goal Position | 116 | -1024 | -90.00 ° |  | 0.00 … 270.00 ° | RW"),
            QStringLiteral("Present Input Voltage (plot) | 144 | 121 | 12.1 V |  |  | R"),
            QStringLiteral("[Indirect addresses]"),
            QStringLiteral("Indirect Address 1 | 168 | ? |  |  |  | RW"),
            QStringLiteral("[Indirect data]"),
            QStringLiteral("Indirect Data 1 | 224 | ? |  |  |  | RW"),
        };
        QCOMPARE(printed(words), expected);
    }

    void printsSeveralDevicesAndTheirDifferences()
    {
        TableFixture fixture;
        const auto one = smallDevice(1);
        const auto two = smallDevice(2);
        for (Device *device : {one.get(), two.get()}) {
            TableFixture::set(device, QStringLiteral("Operating Mode"), device->id() == 1 ? 3 : 1);
            TableFixture::set(device, QStringLiteral("Max Position Limit"), 2048);
            TableFixture::set(device, QStringLiteral("Present Input Voltage"), 120 + device->id());
        }
        FieldTableModel model(fixture.actions());
        FieldWordsModel words;
        words.setSourceModel(&model);
        const QAbstractItemModelTester tester(&model, QAbstractItemModelTester::FailureReportingMode::QtTest);
        model.setDevices({one.get(), two.get()});
        QCOMPARE(words.headerData(3, Qt::Horizontal, Qt::DisplayRole).toString(), QStringLiteral("All"));
        QCOMPARE(words.headerData(5, Qt::Horizontal, Qt::DisplayRole).toString(), QStringLiteral("Small #2"));
        const QStringList lines = printed(words);
        QCOMPARE(lines.at(2), QStringLiteral("Operating Mode | 11 | mixed# | Position | Velocity# | RW"));
        QCOMPARE(lines.at(3), QStringLiteral("Max Position Limit | 48 | 180.00 ° | 180.00 ° | 180.00 ° | RW"));
        // What the servos measure differs all the time: not worth a mark.
        QCOMPARE(lines.at(7), QStringLiteral("Present Input Voltage | 144 | mixed | 12.1 V | 12.2 V | R"));
    }

    void showsStates()
    {
        TableFixture fixture;
        qint64 now = 0;
        const auto device = smallDevice(1);
        TableFixture::set(device.get(), QStringLiteral("Goal Position"), 1024);
        TableFixture::set(device.get(), QStringLiteral("Max Position Limit"), 1024);
        FieldTableModel model(fixture.actions(), [&] { return now; });
        FieldWordsModel words;
        words.setSourceModel(&model);
        model.setDevices({device.get()});
        const auto line = [&](int index) { return printed(words).at(index); };

        device->setPending(4, 2048);
        QCOMPARE(line(6), QStringLiteral("Goal Position | 116 | 1024 | 90.00 ° |  | 0.00 … 90.00 ° | RW"));
        now += ChangeTracker::PendingMs; // a slow write says what it is about
        QCOMPARE(line(6), QStringLiteral("Goal Position | 116 | 1024>2048 | 90.00 °>180.00 ° |  | 0.00 … 90.00 ° | RW"));
        device->clearPending(4);
        device->setFailed(4, QStringLiteral("nothing came back"));
        QCOMPARE(line(6), QStringLiteral("Goal Position | 116 | 1024! | 90.00 ° |  | 0.00 … 90.00 ° | RW"));
        const QModelIndex cell = words.mapFromSource(model.indexOf(4, 3));
        QCOMPARE(cell.data(Qt::ToolTipRole).toString(), QStringLiteral("nothing came back"));
        device->setState(Device::State::Silent);
        QVERIFY(line(3).startsWith(QStringLiteral("Max Position Limit | 48 | 1024~")));
        QCOMPARE(cell.data(LockRole).toString(), QString()); // what became of a write is said by the write
    }

    void mergesManyUpdatesIntoFewSignals()
    {
        TableFixture fixture;
        Device *device = fixture.add(1);
        FieldTableModel model(fixture.actions());
        model.setDevices({device});
        QSignalSpy changed(&model, &QAbstractItemModel::dataChanged);
        QSignalSpy updated(&model, &FieldTableModel::updated);
        for (int i = 0; i < 1000; ++i) {
            TableFixture::set(device, QStringLiteral("Present Position"), i);
            TableFixture::set(device, QStringLiteral("Present Current"), i % 300);
            TableFixture::set(device, QStringLiteral("Velocity I Gain"), i);
        }
        QCOMPARE(changed.count(), 0);
        QTRY_COMPARE(updated.count(), 1);
        // One stretch of present values, one for the gain.
        QCOMPARE(changed.count(), 2);
        QCOMPARE(device->raw(u"Present Position"), std::optional<std::int64_t>(999));
        // The same values again are no news.
        TableFixture::set(device, QStringLiteral("Present Position"), 999);
        QTest::qWait(2 * FieldTableModel::FrameMs);
        QCOMPARE(updated.count(), 1);
    }

    void hiddenViewsCatchUpOnce()
    {
        TableFixture fixture;
        Device *device = fixture.add(1);
        FieldTableModel model(fixture.actions());
        model.setDevices({device});
        model.setLive(false);
        QSignalSpy changed(&model, &QAbstractItemModel::dataChanged);
        for (int i = 0; i < 100; ++i)
            TableFixture::set(device, QStringLiteral("Present Position"), i);
        QTest::qWait(2 * FieldTableModel::FrameMs);
        QCOMPARE(changed.count(), 0);
        model.setLive(true);
        QCOMPARE(changed.count(), 1);
    }

    void aLimitChangesWhatDependsOnIt()
    {
        TableFixture fixture;
        Device *device = fixture.add(1);
        FieldTableModel model(fixture.actions());
        FieldWordsModel words;
        words.setSourceModel(&model);
        model.setDevices({device});
        QSignalSpy changed(&words, &QAbstractItemModel::dataChanged);
        TableFixture::set(device, QStringLiteral("Max Position Limit"), 3000);
        QTRY_VERIFY(changed.count() > 0);
        const int goal = TableFixture::field(device, u"Goal Position");
        const QModelIndex range = words.mapFromSource(model.indexOf(goal, model.columnOf(ColumnKind::Range)));
        QCOMPARE(range.data().toString(), QStringLiteral("0.00 … 263.67 °"));
        const bool told = std::ranges::any_of(changed, [&](const QList<QVariant> &signal) {
            const auto first = signal.at(0).value<QModelIndex>();
            const auto last = signal.at(1).value<QModelIndex>();
            return first.parent() == range.parent() && first.row() <= range.row() && range.row() <= last.row()
                && last.column() >= range.column();
        });
        QVERIFY(told);
    }

    void fadesWhatChangedAfterStandingStill()
    {
        TableFixture fixture;
        qint64 now = 0;
        Device *device = fixture.add(1);
        FieldTableModel model(fixture.actions(), [&] { return now; });
        model.setDevices({device});
        const int field = TableFixture::field(device, u"Present Position");
        const auto fade = [&] { return model.indexOf(field, 3).data(FadeRole).toDouble(); };
        TableFixture::set(device, QStringLiteral("Present Position"), 10);
        QCOMPARE(fade(), 0.0); // just read for the first time: it didn't stand still
        now += ChangeTracker::StillMs;
        TableFixture::set(device, QStringLiteral("Present Position"), 20);
        QCOMPARE(fade(), 1.0);
        now += ChangeTracker::FadeMs / 2;
        TableFixture::set(device, QStringLiteral("Present Position"), 30); // live values just change
        QCOMPARE(fade(), 0.5);
        now += ChangeTracker::FadeMs / 2;
        QCOMPARE(fade(), 0.0);
    }

    void fadesWhatAWriteChanged()
    {
        TableFixture fixture;
        qint64 now = 0;
        Device *device = fixture.add(1);
        FieldTableModel model(fixture.actions(), [&] { return now; });
        model.setDevices({device});
        const int field = TableFixture::field(device, u"Goal Position");
        TableFixture::set(device, QStringLiteral("Goal Position"), 10);
        device->setPending(field, 20);
        device->clearPending(field);
        TableFixture::set(device, QStringLiteral("Goal Position"), 20);
        QCOMPARE(model.indexOf(field, 3).data(FadeRole).toDouble(), 1.0);
    }

    void writesOnlyWhatIsNew()
    {
        TableFixture fixture;
        Device *one = fixture.add(1);
        Device *two = fixture.add(2);
        TableFixture::set(one, QStringLiteral("Position P Gain"), 100);
        TableFixture::set(two, QStringLiteral("Position P Gain"), 200);
        FieldTableModel model(fixture.actions());
        model.setDevices({one, two});
        const int field = TableFixture::field(one, u"Position P Gain");
        const QModelIndex cell = model.indexOf(field, model.columnOf(ColumnKind::Device, 1));
        QVERIFY(!model.setData(cell, 200, Qt::EditRole));
        QVERIFY(model.setData(cell, 300, Qt::EditRole));
        QCOMPARE(fixture.written(), QStringList{QStringLiteral("2 Position P Gain=300")});
        fixture.writes.clear();
        QVERIFY(model.setData(model.indexOf(field, model.columnOf(ColumnKind::All)), 200, Qt::EditRole));
        QCOMPARE(fixture.written(), QStringList{QStringLiteral("1 Position P Gain=200")});
        QVERIFY(!model.setData(model.indexOf(TableFixture::field(one, u"Present Position"), 3), 1, Qt::EditRole));
    }

    void forgetsADeviceThatDies()
    {
        TableFixture fixture;
        auto one = smallDevice(1);
        const auto two = smallDevice(2);
        FieldTableModel model(fixture.actions());
        const QAbstractItemModelTester tester(&model, QAbstractItemModelTester::FailureReportingMode::QtTest);
        model.setDevices({one.get(), two.get()});
        one.reset();
        QCOMPARE(model.devices(), std::vector<Device *>{two.get()});
        QCOMPARE(model.columnOf(ColumnKind::Value), 3);
    }

    void asksForPlotsAndDragsThem()
    {
        TableFixture fixture;
        const auto one = smallDevice(1);
        const auto two = smallDevice(2);
        FieldTableModel model(fixture.actions());
        model.setDevices({one.get(), two.get()});
        std::vector<Watch> asked;
        connect(&model, &FieldTableModel::plotRequested, this, [&](const Watch &watch) { asked.push_back(watch); });
        const QModelIndex tick = model.indexOf(5, model.columnOf(ColumnKind::Plot));
        QVERIFY(model.setData(tick, Qt::Checked, Qt::CheckStateRole));
        const std::vector<Watch> expected{{1, 5}, {2, 5}};
        QCOMPARE(asked, expected);
        fixture.watched = {{1, 5}};
        QCOMPARE(tick.data(Qt::CheckStateRole).toInt(), static_cast<int>(Qt::PartiallyChecked));
        const std::unique_ptr<QMimeData> mime(model.mimeData({tick, tick.siblingAtColumn(0)}));
        QVERIFY(mime && mime->hasFormat(QStringLiteral("application/x-dynascope-watch")));
        QVERIFY(!model.mimeData({model.index(0, 0)}));
    }
};

DYNASCOPE_UI_TEST(TestTableModel)
#include "tst_tablemodel.moc"
