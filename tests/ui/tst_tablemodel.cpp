// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/uitest.h"
#include "tests/ui/tablefixture.h"
#include "ui/table/fieldfiltermodel.h"
#include "ui/table/fieldtablemodel.h"
#include "ui/table/fieldwordsmodel.h"

#include <QAbstractItemModelTester>
#include <QMimeData>
#include <QSignalSpy>

using namespace dynascope;

namespace {

QString markOf(const QModelIndex &cell)
{
    switch (static_cast<FieldState>(cell.data(StateRole).toInt())) {
    case FieldState::Unknown: return QStringLiteral("?");
    case FieldState::Stale: return QStringLiteral("~");
    case FieldState::Failed: return QStringLiteral("!");
    default: return cell.data(DiffersRole).toBool() ? QStringLiteral("#") : QString();
    }
}

/// Each row as "name | cell | cell"; groups as "[title]". States as a mark, a write as "old>new".
QStringList printed(const QAbstractItemModel &model)
{
    QStringList lines;
    for (int group = 0; group < model.rowCount(); ++group) {
        const QModelIndex parent = model.index(group, 0);
        lines << QStringLiteral("[%1]").arg(parent.data().toString());
        for (int row = 0; row < model.rowCount(parent); ++row) {
            QStringList cells;
            for (int column = 0; column < model.columnCount(); ++column) {
                const QModelIndex cell = model.index(row, column, parent);
                if (kindAt(cell) == ColumnKind::Plot) {
                    if (cell.data(Qt::CheckStateRole).toInt() != Qt::Unchecked)
                        cells.back() += QStringLiteral(" (plot)");
                    continue;
                }
                QString text = cell.data().toString();
                if (isValueKind(kindAt(cell)) && kindAt(cell) != ColumnKind::Physical)
                    text += markOf(cell);
                if (const QString next = cell.data(PendingTextRole).toString(); !next.isEmpty())
                    text += u'>' + next;
                cells << text;
            }
            lines << cells.join(QStringLiteral(" | "));
        }
    }
    return lines;
}

Field makeField(int address, int size, const QString &name, Area area, bool writable, Unit unit, double scale)
{
    Field field;
    field.address = static_cast<std::uint16_t>(address);
    field.size = static_cast<std::uint8_t>(size);
    field.name = name;
    field.area = area;
    field.access = writable ? Access::ReadWrite : Access::Read;
    field.unit = unit;
    field.scale = scale;
    field.isSigned = size == 4;
    return field;
}

ControlTablePtr smallTable()
{
    ControlTable::Description table;
    table.modelNumber = 1;
    table.model = QStringLiteral("Small");
    Field id = makeField(7, 1, QStringLiteral("ID"), Area::Eeprom, true, Unit::None, 1);
    id.initial = 1;
    id.minimum.number = 0;
    id.maximum.number = 252;
    Field mode = makeField(11, 1, QStringLiteral("Operating Mode"), Area::Eeprom, true, Unit::None, 1);
    mode.initial = 3;
    mode.values = {{1, QStringLiteral("Velocity")}, {3, QStringLiteral("Position")}};
    Field limit = makeField(48, 4, QStringLiteral("Max Position Limit"), Area::Eeprom, true, Unit::Pulse, 1);
    limit.initial = 4095;
    limit.help = QStringLiteral("How far the joint may turn.");
    Field torque = makeField(64, 1, QStringLiteral("Torque Enable"), Area::Ram, true, Unit::None, 1);
    torque.values = {{0, QStringLiteral("Off")}, {1, QStringLiteral("On")}};
    torque.initial = 0;
    Field goal = makeField(116, 4, QStringLiteral("Goal Position"), Area::Ram, true, Unit::Pulse, 1);
    goal.minimum.number = 0;
    goal.maximum.reg = QStringLiteral("Max Position Limit");
    Field volt = makeField(144, 2, QStringLiteral("Present Input Voltage"), Area::Ram, false, Unit::Volt, 0.1);
    Field address = makeField(168, 2, QStringLiteral("Indirect Address 1"), Area::Ram, true, Unit::None, 1);
    Field data = makeField(224, 1, QStringLiteral("Indirect Data 1"), Area::Ram, true, Unit::None, 1);
    table.fields = {id, mode, limit, torque, goal, volt, address, data};
    return std::make_shared<ControlTable>(table);
}

std::unique_ptr<Device> smallDevice(int id)
{
    Found found;
    found.id = static_cast<std::uint8_t>(id);
    return std::make_unique<Device>(static_cast<DeviceKey>(id), nullptr, smallTable(), found);
}

} // namespace

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
            QStringLiteral("Max Position Limit | 48 | 3072 | 270.00 ° | 4095 |  | RW"),
            QStringLiteral("[RAM]"),
            QStringLiteral("Torque Enable | 64 | ? |  | 0 |  | RW"),
            QStringLiteral("Goal Position | 116 | -1024 | -90.00 ° |  | 0 … 3072 | RW"),
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
        QCOMPARE(words.headerData(3, Qt::Horizontal, Qt::DisplayRole).toString(), QStringLiteral("Small #1"));
        QCOMPARE(words.headerData(4, Qt::Horizontal, Qt::DisplayRole).toString(), QStringLiteral("Small #2"));
        const QStringList lines = printed(words);
        QCOMPARE(lines.at(2), QStringLiteral("Operating Mode | 11 | Position | Velocity# | 3 |  | RW"));
        QCOMPARE(lines.at(3), QStringLiteral("Max Position Limit | 48 | 180.00 ° | 180.00 ° | 4095 |  | RW"));
        // What the servos measure differs all the time: not worth a mark.
        QCOMPARE(lines.at(7), QStringLiteral("Present Input Voltage | 144 | 12.1 V | 12.2 V |  |  | R"));
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
        QCOMPARE(line(6), QStringLiteral("Goal Position | 116 | 1024 | 90.00 ° |  | 0 … 1024 | RW"));
        now += ChangeTracker::PendingMs; // a slow write says what it is about
        QCOMPARE(line(6), QStringLiteral("Goal Position | 116 | 1024>2048 | 90.00 °>180.00 ° |  | 0 … 1024 | RW"));
        device->clearPending(4);
        device->setFailed(4, QStringLiteral("nothing came back"));
        QCOMPARE(line(6), QStringLiteral("Goal Position | 116 | 1024! | 90.00 ° |  | 0 … 1024 | RW"));
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
        QCOMPARE(range.data().toString(), QStringLiteral("0 … 3000"));
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
        model.setEditsAll(true);
        QVERIFY(model.setData(cell, 200, Qt::EditRole));
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

    void filters_data()
    {
        QTest::addColumn<QString>("search");
        QTest::addColumn<QString>("switches"); // of c(hanged) w(ritable) p(lotted)
        QTest::addColumn<QStringList>("left");
        const auto row = [](const char *name, const QString &search, const QString &switches, const QString &left) {
            QTest::newRow(name) << search << switches << left.split(u'/', Qt::SkipEmptyParts);
        };
        row("name", QStringLiteral("position"), {},
            QStringLiteral("[EEPROM]/Max Position Limit/[RAM]/Goal Position"));
        row("words in any order", QStringLiteral("limit max"), {}, QStringLiteral("[EEPROM]/Max Position Limit"));
        row("help", QStringLiteral("joint"), {}, QStringLiteral("[EEPROM]/Max Position Limit"));
        row("address", QStringLiteral("116"), {}, QStringLiteral("[RAM]/Goal Position"));
        row("address in hex", QStringLiteral("0x90"), {}, QStringLiteral("[RAM]/Present Input Voltage"));
        row("nothing", QStringLiteral("elephant"), {}, {});
        row("changed", {}, QStringLiteral("c"), QStringLiteral("[EEPROM]/ID"));
        row("plotted", {}, QStringLiteral("p"), QStringLiteral("[RAM]/Present Input Voltage"));
        row("writable and a search", QStringLiteral("p"), QStringLiteral("w"),
            QStringLiteral("[EEPROM]/Operating Mode/Max Position Limit/[RAM]/Goal Position"));
        row("plotted and writable", {}, QStringLiteral("pw"), {});
    }

    void filters()
    {
        QFETCH(QString, search);
        QFETCH(QString, switches);
        QFETCH(QStringList, left);
        TableFixture fixture;
        const auto device = smallDevice(3);
        TableFixture::set(device.get(), QStringLiteral("ID"), 3);
        TableFixture::set(device.get(), QStringLiteral("Operating Mode"), 3);
        fixture.watched = {{3, 5}};
        FieldTableModel model(fixture.actions());
        FieldWordsModel words;
        FieldFilterModel filter;
        words.setSourceModel(&model);
        filter.setSourceModel(&words);
        const QAbstractItemModelTester tester(&filter, QAbstractItemModelTester::FailureReportingMode::QtTest);
        model.setDevices({device.get()});
        filter.setSearch(search);
        filter.setOnlyChanged(switches.contains(u'c'));
        filter.setOnlyWritable(switches.contains(u'w'));
        filter.setOnlyWatched(switches.contains(u'p'));
        QStringList names;
        for (const QString &line : printed(filter))
            names << line.section(QStringLiteral(" | "), 0, 0).remove(QStringLiteral(" (plot)"));
        QCOMPARE(names, left);
    }

    void aFilterFollowsTheValues()
    {
        TableFixture fixture;
        const auto device = smallDevice(1);
        TableFixture::set(device.get(), QStringLiteral("Operating Mode"), 3);
        FieldTableModel model(fixture.actions());
        FieldFilterModel filter;
        filter.setSourceModel(&model);
        model.setDevices({device.get()});
        filter.setOnlyChanged(true);
        QCOMPARE(filter.rowCount(), 0);
        TableFixture::set(device.get(), QStringLiteral("Operating Mode"), 1);
        QTRY_COMPARE(filter.rowCount(), 1);
        TableFixture::set(device.get(), QStringLiteral("Operating Mode"), 3);
        QTRY_COMPARE(filter.rowCount(), 0);
    }
};

DYNASCOPE_UI_TEST(TestTableModel)
#include "tst_tablemodel.moc"
