// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/uitest.h"
#include "tests/ui/smalldevice.h"
#include "tests/ui/tablefixture.h"
#include "ui/table/fieldfiltermodel.h"
#include "ui/table/fieldtablemodel.h"
#include "ui/table/fieldwordsmodel.h"

#include <QAbstractItemModelTester>

using namespace dynascope;

/// What search and filters leave of the table.
class TestTableFilter : public QObject
{
    Q_OBJECT

private slots:
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

DYNASCOPE_UI_TEST(TestTableFilter)
#include "tst_tablefilter.moc"
