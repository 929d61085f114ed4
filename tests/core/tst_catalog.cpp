// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/table/catalog.h"
#include "core/table/units.h"
#include "tests/support/testmain.h"

#include <QFile>

using namespace dynascope;

namespace {

const Catalog &builtIn()
{
    static const Result<Catalog> catalog = Catalog::builtIn();
    if (!catalog)
        qFatal("%s", qPrintable(catalog.error().text));
    return *catalog;
}

QString boundText(const Bound &bound)
{
    if (bound.number)
        return QString::number(*bound.number);
    return (bound.negated ? QStringLiteral("-") : QString()) + bound.reg;
}

QString unitText(const Field &field)
{
    return field.unit == Unit::Pulse ? QStringLiteral("pulse") : unitId(field.unit);
}

/// A register as a line of the facts in tests/data/tables.
QString line(const Field &field)
{
    const QString area = field.area == Area::Eeprom ? QStringLiteral("EEPROM") : QStringLiteral("RAM");
    const QStringList cells{QString::number(field.address), QString::number(field.size), field.name, area,
        field.isWritable() ? QStringLiteral("RW") : QStringLiteral("R"),
        field.initial ? QString::number(*field.initial) : QString(), boundText(field.minimum), boundText(field.maximum),
        unitText(field), field.unit == Unit::None ? QString() : QString::number(field.scale),
        QString::number(field.isSigned ? 1 : 0)};
    return cells.join(u',');
}

QStringList factLines(const QString &name)
{
    QFile file(QStringLiteral(DYNASCOPE_SOURCE_DIR "/tests/data/tables/") + name);
    if (!file.open(QIODevice::ReadOnly))
        qFatal("no facts: %s", qPrintable(name));
    QStringList lines = QString::fromUtf8(file.readAll()).split(u'\n', Qt::SkipEmptyParts);
    lines.removeFirst();
    for (QString &text : lines) { // one spelling of a number
        QStringList cells = text.split(u',');
        if (!cells[9].isEmpty())
            cells[9] = QString::number(cells[9].toDouble());
        text = cells.join(u',');
    }
    return lines;
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
    void everyRegisterAsTheFactsSay_data()
    {
        QTest::addColumn<int>("model");
        QTest::addColumn<int>("firmware");
        QTest::newRow("xm430-w350") << 1020 << 45;
        QTest::newRow("xl430-w250") << 1060 << 45;
        QTest::newRow("xl330-m288") << 1200 << 53;
        QTest::newRow("xl330-m288-fw52") << 1200 << 52;
    }

    void everyRegisterAsTheFactsSay()
    {
        QFETCH(int, model);
        QFETCH(int, firmware);
        const ControlTablePtr table = builtIn().find(model, firmware);
        QVERIFY(table);
        QStringList lines;
        for (const Field &field : table->fields())
            lines.append(line(field));
        const QStringList facts = factLines(QString::fromLatin1(QTest::currentDataTag()) + QStringLiteral(".csv"));
        for (qsizetype i = 0; i < std::min(lines.size(), facts.size()); ++i)
            QCOMPARE(lines[i], facts[i]);
        QCOMPARE(lines.size(), facts.size());
    }

    void everyFieldIsExplained()
    {
        for (const Catalog::ModelInfo &info : builtIn().models()) {
            const ControlTablePtr table = builtIn().find(info.modelNumber, info.newestFirmware);
            for (const Field &field : table->fields())
                QVERIFY2(field.help.size() > 20 && field.help.endsWith(u'.'), qPrintable(field.name));
        }
    }

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
        QCOMPARE(builtIn().models().size(), std::size_t(3));
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
