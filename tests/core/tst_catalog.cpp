// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/table/catalog.h"
#include "core/table/units.h"
#include "tests/support/testmain.h"

#include <algorithm>
#include <thread>

using namespace dynascope;

namespace {

const Catalog &builtIn()
{
    static const Result<Catalog> catalog = Catalog::builtIn();
    if (!catalog)
        qFatal("%s", qPrintable(catalog.error().text));
    return *catalog;
}

QStringList names(const QStringList &wanted, const ControlTable &table)
{
    QStringList there;
    for (const QString &name : wanted) {
        if (table.find(name))
            there.append(name);
    }
    return there;
}

} // namespace

class TestCatalog : public QObject
{
    Q_OBJECT

private slots:
    void firmwareChangesTheTable_data()
    {
        QTest::addColumn<int>("model");
        QTest::addColumn<int>("firmware");
        QTest::addColumn<int>("from");
        QTest::addColumn<int>("to");
        QTest::addColumn<QStringList>("registers");
        QTest::addColumn<int>("driveModeBits");
        QTest::addColumn<int>("alternatesOfProfile");
        const QStringList none, drive{QStringLiteral("Drive Mode")};
        const QStringList all{
            QStringLiteral("Drive Mode"), QStringLiteral("Startup Configuration"), QStringLiteral("Backup Ready")};
        for (const int model : {1020, 1060}) {
            QTest::addRow("%d oldest", model) << model << 0 << 0 << 37 << none << -1 << 0;
            QTest::addRow("%d unknown", model) << model << -1 << 0 << 37 << none << -1 << 0;
            QTest::addRow("%d 37", model) << model << 37 << 0 << 37 << none << -1 << 0;
            QTest::addRow("%d 38", model) << model << 38 << 38 << 41 << drive << 1 << 0;
            QTest::addRow("%d 42", model) << model << 42 << 42 << 44 << drive << 5 << 1;
            QTest::addRow("%d 45", model) << model << 45 << 45 << 255 << all << 13 << 1;
            QTest::addRow("%d newer", model) << model << 99 << 45 << 255 << all << 13 << 1;
        }
        QTest::newRow("1200 45") << 1200 << 45 << 0 << 45 << drive << 5 << 1;
        QTest::newRow("1200 46") << 1200 << 46 << 46 << 52 << all << 13 << 1;
        QTest::newRow("1200 52") << 1200 << 52 << 46 << 52 << all << 13 << 1;
        QTest::newRow("1200 53") << 1200 << 53 << 53 << 255 << all << 13 << 1;
        QTest::newRow("1200 beyond the byte") << 1200 << 1000 << 53 << 255 << all << 13 << 1;
    }

    void firmwareChangesTheTable()
    {
        QFETCH(int, model);
        QFETCH(int, firmware);
        const ControlTablePtr table = builtIn().find(model, firmware);
        QVERIFY(table);
        QTEST(table->description().firmwareFrom, "from");
        QTEST(table->description().firmwareTo, "to");
        const QStringList changing{
            QStringLiteral("Drive Mode"), QStringLiteral("Startup Configuration"), QStringLiteral("Backup Ready")};
        QTEST(names(changing, *table), "registers");
        const Field *drive = table->find(u"Drive Mode");
        QTEST(drive ? int(drive->maximum.number.value_or(-2)) : -1, "driveModeBits");
        QTEST(int(table->find(u"Profile Velocity")->alternates.size()), "alternatesOfProfile");
    }

    void modelsAreFound()
    {
        QCOMPARE(builtIn().model(u"xm430_w350")->modelNumber, std::uint16_t(1020));
        QCOMPARE(builtIn().model(u"XL 330-M288")->newestFirmware, 53);
        QCOMPARE(builtIn().model(1060)->newestFirmware, 45);
        QCOMPARE(builtIn().model(1060)->series, QStringLiteral("X"));
        QVERIFY(!builtIn().model(u"XM430"));
        QVERIFY(!builtIn().model(7));
        QVERIFY(!builtIn().find(7, 45));
        QCOMPARE(modelName(builtIn(), 1020), QStringLiteral("XM430-W350"));
        QCOMPARE(modelName(builtIn(), 1234), QStringLiteral("unknown model 1234"));
    }

    /// Names and numbers that could be taken for each other.
    void theRightOne_data()
    {
        QTest::addColumn<int>("number");
        QTest::addColumn<QString>("name");
        QTest::addColumn<int>("torqueEnable");
        QTest::addColumn<int>("goalPosition");
        QTest::newRow("PRO") << 54024 << "H54-200-S500-R" << 562 << 596;
        QTest::newRow("PRO(A)") << 54025 << "H54-200-S500-R(A)" << 512 << 564;
        QTest::newRow("P") << 2020 << "PH54-200-S500-R" << 512 << 564;
        QTest::newRow("gripper") << 35073 << "RH-P12-RN" << 562 << 596;
        QTest::newRow("gripper (A)") << 35074 << "RH-P12-RN(A)" << 512 << 564;
        QTest::newRow("XL-320") << 350 << "XL-320" << 24 << 30;
        QTest::newRow("Y") << 4050 << "YM070-210-A099-RH" << 512 << 532;
        QTest::newRow("Y, in Modbus mode") << 4051 << "YM070-210-A099-RH" << 512 << 532;
        QTest::newRow("X") << 1020 << "XM430-W350" << 64 << 116;
    }

    void theRightOne()
    {
        QFETCH(int, number);
        QFETCH(QString, name);
        const ControlTablePtr table = builtIn().find(number, 255);
        QVERIFY(table);
        QCOMPARE(table->model(), name);
        QCOMPARE(modelName(builtIn(), number), name);
        QTEST(int(table->find(Known::TorqueEnable)->address), "torqueEnable");
        QTEST(int(table->find(u"Goal Position")->address), "goalPosition");
    }

    void twoNamesBehindOneNumber()
    {
        QCOMPARE(builtIn().model(u"XC430-T150BB")->modelNumber, std::uint16_t(1070));
        QCOMPARE(builtIn().model(u"xc430-w240bb")->model, QStringLiteral("XC430-W240"));
    }

    void newerThanKnown()
    {
        const ControlTablePtr table = builtIn().find(1200, 60);
        QVERIFY(table->isNewerThanKnown(60) && table->isNewerThanKnown(54) && !table->isNewerThanKnown(53));
        QCOMPARE(table->find(u"Indirect Data 28")->address, std::uint16_t(251));
        QVERIFY(!builtIn().find(1700, 60)->isNewerThanKnown(60)); // of which no firmware is known
    }

    void instructions()
    {
        const ControlTable::Description &x = builtIn().find(1020, 45)->description();
        QVERIFY(builtIn().find(1020, 45)->hasClear(42) && !builtIn().find(1020, 45)->hasClear(41));
        QVERIFY(!x.clearsErrors && x.axes == 1 && x.resetByBroadcastUntil == 41);
        QVERIFY(builtIn().find(4000, 11)->description().clearsErrors && builtIn().find(4000, 11)->hasClear(0));
        QCOMPARE(builtIn().find(1090, 45)->description().axes, 2);
        QVERIFY(!builtIn().find(350, 29)->hasClear(29) && !builtIn().find(54024, 30)->hasClear(30));
    }

    void anUnknownModelIsBytes()
    {
        const ControlTablePtr table = builtIn().findOrRaw(1235, 45);
        QVERIFY(table->description().isRaw && !table->description().doubt.isEmpty());
        QCOMPARE(table->model(), QStringLiteral("unknown model 1235"));
        QCOMPARE(int(table->fields().size()), 1024);
        for (const Field &field : table->fields())
            QVERIFY(field.mayBeTried() && !field.isWritable() && field.size == 1 && field.area == Area::Unknown);
        // XC330-M181 and XC330-M288 are its neighbours.
        QCOMPARE(table->at(64)->suggested, QStringLiteral("Torque Enable"));
        QVERIFY(table->at(64)->help.contains(u"XC330-M181") && table->at(64)->help.startsWith(u"Only a guess: "));
        QVERIFY(table->at(65)->suggested == u"LED" && table->at(66)->suggested.isEmpty());
        QVERIFY(table->at(168)->suggested.isEmpty());
    }

    /// Nothing that the program does by itself may reach a register of an unknown model.
    void theProgramMeansNothingInBytes()
    {
        const ControlTablePtr table = builtIn().findOrRaw(1235, 45);
        for (int known = 0; known <= int(Known::PresentPosition); ++known)
            QVERIFY(!table->find(Known(known)));
        for (const char16_t *name : {u"Torque Enable", u"ID", u"Baud Rate", u"Goal Position", u"LED"})
            QVERIFY(!table->find(QStringView(name)));
        QVERIFY(!table->baudCode(57600) && !table->hasFastReads(255));
        QVERIFY(!table->hasBackup(255) && !table->hasClear(255));
    }

    void neighboursOfAnotherSeriesSuggestNothing()
    {
        for (const int number : {1, 345, 35500, 60000}) {
            const ControlTablePtr table = builtIn().findOrRaw(number, 1);
            QVERIFY(std::none_of(table->fields().begin(), table->fields().end(),
                [](const Field &field) { return !field.suggested.isEmpty(); }));
        }
    }

    /// Many threads at once: whoever asks first has the tables made, all get the same.
    void askedByManyThreads()
    {
        const Catalog catalog = Catalog::builtIn().value();
        std::vector<ControlTablePtr> got[4];
        std::vector<std::thread> threads;
        for (std::vector<ControlTablePtr> &mine : got) {
            threads.emplace_back([&catalog, &mine] {
                for (const Catalog::ModelInfo &info : catalog.models())
                    mine.push_back(catalog.find(info.modelNumber, info.newestFirmware));
            });
        }
        for (std::thread &thread : threads)
            thread.join();
        for (const std::vector<ControlTablePtr> &mine : got)
            QVERIFY(mine == got[0]);
        QVERIFY(!got[0].empty() && got[0].front());
    }

    void abilities()
    {
        const ControlTablePtr xm = builtIn().find(1020, 45), xl = builtIn().find(1060, 45);
        const ControlTablePtr small = builtIn().find(1200, 53);
        QVERIFY(!xm->hasFastReads(44) && xm->hasFastReads(45) && !xm->hasBackup(44) && xm->hasBackup(45));
        QVERIFY(!small->hasFastReads(45) && small->hasFastReads(46) && small->hasBackup(46));
        for (const ControlTablePtr &table : {xm, xl, small})
            QCOMPARE(table->receiveBuffer(), 1024);
        QCOMPARE(xm->description().operatingModes, (std::vector<int>{0, 1, 3, 4, 5, 16}));
        QCOMPARE(xl->description().operatingModes, (std::vector<int>{1, 3, 4, 16}));
        QCOMPARE(xm->baudRate(7), std::optional<int>(4500000));
        QCOMPARE(small->baudRate(7), std::optional<int>());
        QCOMPARE(small->baudCode(1000000), std::optional<int>(3));
        QCOMPARE(small->description().baudCodes.size(), std::size_t(7));
        QCOMPARE(meaning(*xm->find(u"Baud Rate"), 1), QStringLiteral("57600 bps"));
        QVERIFY(xl->find(u"Operating Mode")->resets.contains(QStringLiteral("Goal PWM")));
        QVERIFY(!xl->find(u"Operating Mode")->resets.contains(QStringLiteral("Goal Current")));
        QVERIFY(xm->find(u"Operating Mode")->resets.contains(QStringLiteral("Goal Current")));
        QCOMPARE(xl->find(u"Goal Position")->alternates.front().values, (std::vector<std::int64_t>{4}));
        QCOMPARE(xm->find(u"Goal Position")->alternates.front().values, (std::vector<std::int64_t>{4, 5}));
    }
};

DYNASCOPE_CORE_TEST(TestCatalog)
#include "tst_catalog.moc"
