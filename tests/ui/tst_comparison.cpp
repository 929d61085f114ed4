// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/uitest.h"
#include "tests/ui/tablefixture.h"
#include "ui/table/comparison.h"
#include "ui/table/registerrows.h"

using namespace dynascope;

/// Which registers of different tables stand in one row, which of them count as different, and what a value of one is
/// in another.
class TestComparison : public QObject
{
    Q_OBJECT

private slots:
    void rowsOfOneTableAreItsFields()
    {
        const ControlTablePtr table = tableOf(1020, 45);
        const RegisterRows rows({table.get(), table.get()});
        QCOMPARE(rows.count(), static_cast<int>(table->fields().size()));
        for (int row = 0; row < rows.count(); ++row) {
            QCOMPARE(rows.fieldOf(row, 1), row);
            QVERIFY(rows.isOnAll(row));
        }
        const std::vector<FieldGroup> groups = fieldGroups(*table);
        QCOMPARE(rows.groups().size(), groups.size());
        for (std::size_t i = 0; i < groups.size(); ++i) {
            QCOMPARE(rows.groups()[i].title, groups[i].title);
            QCOMPARE(rows.groups()[i].fields, groups[i].fields);
        }
        QCOMPARE(rows.deciding(), decidingFields(*table));
    }

    void everyRegisterOfEveryTableHasItsRow()
    {
        // XM430, XL430 (no current), XL-320 (another family), an unknown model (bytes), two firmwares of XL330
        std::vector<ControlTablePtr> kept{tableOf(1020, 45), tableOf(1060, 45), tableOf(350, 20),
                                          tableOf(9999, 1),  tableOf(1200, 51), tableOf(1200, 53)};
        std::vector<const ControlTable *> tables;
        for (const ControlTablePtr &table : kept)
            tables.push_back(table.get());
        const RegisterRows rows(tables);
        std::set<int> grouped;
        for (const FieldGroup &group : rows.groups()) {
            QVERIFY(std::ranges::is_sorted(group.fields));
            for (const int row : group.fields)
                QVERIFY(grouped.insert(row).second);
        }
        QCOMPARE(grouped.size(), static_cast<std::size_t>(rows.count()));
        for (int device = 0; device < static_cast<int>(tables.size()); ++device) {
            const auto &fields = tables[static_cast<std::size_t>(device)]->fields();
            for (int field = 0; field < static_cast<int>(fields.size()); ++field) {
                const int row = rows.rowOf(device, field);
                QCOMPARE(rows.fieldOf(row, device), field);
                const int with = rows.deviceWith(row);
                const auto at = static_cast<std::size_t>(rows.fieldOf(row, with));
                QCOMPARE(tables[static_cast<std::size_t>(with)]->fields()[at].name,
                         fields[static_cast<std::size_t>(field)].name);
            }
        }
    }

    void whatTheFirstLacksStandsBesideItsNeighbours()
    {
        const ControlTablePtr without = tableOf(1060, 45);
        const ControlTablePtr with = tableOf(1020, 45);
        const RegisterRows rows({without.get(), with.get()});
        const int row = rows.rowOf(1, with->indexOf(u"Current Limit"));
        QCOMPARE(rows.fieldOf(row, 0), -1);
        QVERIFY(!rows.isOnAll(row));
        QCOMPARE(rows.deviceWith(row), 1);
        QCOMPARE(row, rows.rowOf(0, without->indexOf(u"PWM Limit")) + 1);
        QCOMPARE(rows.groups().front().title, QStringLiteral("EEPROM"));
        QVERIFY(std::ranges::find(rows.groups().front().fields, row) != rows.groups().front().fields.end());
    }

    void oneFirmwaresAddressIsNotTheOthers()
    {
        const ControlTablePtr old = tableOf(1200, 51);
        const ControlTablePtr fresh = tableOf(1200, 53);
        const RegisterRows rows({old.get(), fresh.get()});
        const int row = rows.rowOf(0, old->indexOf(u"Indirect Data 1"));
        QCOMPARE(old->fields()[static_cast<std::size_t>(rows.fieldOf(row, 0))].address, 208);
        QCOMPARE(fresh->fields()[static_cast<std::size_t>(rows.fieldOf(row, 1))].address, 224);
    }

    void countsSharedSettings_data()
    {
        QTest::addColumn<QString>("name");
        QTest::addColumn<bool>("counts");
        const std::pair<const char *, bool> rows[]{{"Operating Mode", true},
                                                   {"Position P Gain", true},
                                                   {"Baud Rate", true},
                                                   {"Return Delay Time", true},
                                                   {"Profile Velocity", true},
                                                   {"Indirect Address 1", true},
                                                   {"ID", false},
                                                   {"Homing Offset", false},
                                                   {"Goal Position", false},
                                                   {"Goal Current", false},
                                                   {"Torque Enable", false},
                                                   {"LED", false},
                                                   {"Present Position", false},
                                                   {"Moving", false},
                                                   {"Hardware Error Status", false},
                                                   {"Indirect Data 1", false}};
        for (const auto &[name, counts] : rows)
            QTest::newRow(name) << QString::fromLatin1(name) << counts;
    }

    void countsSharedSettings()
    {
        QFETCH(QString, name);
        QFETCH(bool, counts);
        const ControlTablePtr table = tableOf(1020, 45);
        QVERIFY(table->find(name));
        QCOMPARE(isSharedSetting(*table->find(name)), counts);
    }

    void comparesNumbersAndWhatTheyMean_data()
    {
        QTest::addColumn<int>("model");
        QTest::addColumn<int>("other");
        QTest::addColumn<QString>("name");
        QTest::addColumn<int>("raw");
        QTest::addColumn<int>("otherRaw");
        QTest::addColumn<bool>("differs");
        QTest::newRow("alike") << 1020 << 1020 << QStringLiteral("Position P Gain") << 5 << 5 << false;
        QTest::newRow("other number") << 1020 << 1020 << QStringLiteral("Position P Gain") << 5 << 6 << true;
        QTest::newRow("other model, same meaning")
            << 1020 << 1060 << QStringLiteral("Velocity Limit") << 100 << 100 << false;
        QTest::newRow("same number, other scale") << 1020 << 2000 << QStringLiteral("Velocity Limit") << 5 << 5 << true;
        QTest::newRow("same number, other angle")
            << 1020 << 2000 << QStringLiteral("Max Position Limit") << 5 << 5 << true;
    }

    void comparesNumbersAndWhatTheyMean()
    {
        QFETCH(int, model);
        QFETCH(int, other);
        QFETCH(QString, name);
        QFETCH(int, raw);
        QFETCH(int, otherRaw);
        QFETCH(bool, differs);
        const ControlTablePtr one = tableOf(model, 45);
        const ControlTablePtr two = tableOf(other, 45);
        QCOMPARE(holdDifferent(compared(*one, name, raw), compared(*two, name, otherRaw)), differs);
        ComparedCell unread = compared(*two, name, otherRaw);
        unread.raw.reset();
        QVERIFY(!holdDifferent(compared(*one, name, raw), unread));
    }

    void carriesOverWhatIsMeant_data()
    {
        QTest::addColumn<int>("from");
        QTest::addColumn<int>("to");
        QTest::addColumn<QString>("name");
        QTest::addColumn<int>("raw");
        QTest::addColumn<QString>("result"); // raw, or a piece of the reason
        const auto row = [](const char *what, int from, int to, const char *name, int raw, const char *result) {
            QTest::newRow(what) << from << to << QString::fromLatin1(name) << raw << QString::fromLatin1(result);
        };
        row("the same", 1020, 1060, "Position P Gain", 640, "640");
        row("beyond the other's range", 350, 1020, "Temperature Limit", 120, "Temperature Limit");
        row("a speed at another scale", 1020, 2000, "Velocity Limit", 100, "2290");
        row("an angle at another resolution", 1020, 2000, "Max Position Limit", 2048, "303750");
        row("a unit that nobody states there", 1020, 35072, "Velocity Limit", 100, "means something else");
    }

    void carriesOverWhatIsMeant()
    {
        QFETCH(int, from);
        QFETCH(int, to);
        QFETCH(QString, name);
        QFETCH(int, raw);
        QFETCH(QString, result);
        const ControlTablePtr one = tableOf(from, 45);
        const ControlTablePtr two = tableOf(to, 45);
        const auto carried = carriedOver(compared(*one, name, raw), raw, compared(*two, name, 0));
        const QString said = carried ? QString::number(*carried) : carried.error().text;
        QVERIFY2(said.contains(result), qPrintable(said));
    }

    void carriesNamesOverByTheName()
    {
        Field one;
        one.name = QStringLiteral("Mode");
        one.values = {{1, QStringLiteral("Velocity")}, {3, QStringLiteral("Position")}};
        Field other = one;
        other.values = {{7, QStringLiteral("Velocity")}};
        const ComparedCell from{&one, effective(one, {}), 4096, 1};
        const ComparedCell to{&other, effective(other, {}), 4096, 7};
        QVERIFY(holdDifferent(from, to)); // in their numbers: what is written differs
        QCOMPARE(carriedOver(from, 1, to).value_or(-1), std::int64_t(7));
        QVERIFY(!carriedOver(from, 3, to));
        other.values.clear();
        QVERIFY(!carriedOver(from, 1, to));
    }

private:
    static ControlTablePtr tableOf(int model, int firmware)
    {
        return TableFixture::catalog().findOrRaw(static_cast<std::uint16_t>(model), firmware);
    }

    static ComparedCell compared(const ControlTable &table, const QString &name, std::int64_t raw)
    {
        const Field *field = table.find(name);
        if (!field)
            qFatal("no %s", qPrintable(name));
        return {field, effective(*field, {}), table.resolution(), raw};
    }
};

DYNASCOPE_UI_TEST(TestComparison)
#include "tst_comparison.moc"
