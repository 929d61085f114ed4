// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/simulatedbus.h"
#include "core/table/catalog.h"
#include "tests/support/builtincatalog.h"
#include "tests/support/testmain.h"

using namespace dynascope;
using namespace dynascope::sim;

class TestServoSpecs : public QObject
{
    Q_OBJECT

private slots:
    void good()
    {
        const auto specs = parseServoSpecs(u"XM430-W350@57600:1, xl330m288/52@1000000:7", m_catalog);
        QVERIFY2(specs, qPrintable(specs ? QString() : specs.error().text));
        const std::vector<ServoSpec> expected{{QStringLiteral("XM430-W350"), -1, 57600, 1},
                                              {QStringLiteral("XL330-M288"), 52, 1000000, 7}};
        QVERIFY(*specs == expected);
    }

    void bad_data()
    {
        QTest::addColumn<QString>("text");
        QTest::addColumn<QString>("named"); // in the message
        QTest::newRow("empty") << "" << "missing";
        QTest::newRow("nothing between commas") << "XM430-W350@57600:1,,XM430-W350@57600:2" << "missing";
        QTest::newRow("no rate") << "XM430-W350:1" << "MODEL[/FIRMWARE]@BAUD:ID";
        QTest::newRow("no model") << "@57600:1" << "MODEL[/FIRMWARE]@BAUD:ID";
        QTest::newRow("unknown model") << "XM999@57600:1" << "XM999";
        QTest::newRow("only its addresses are known") << "OMY-HAT@57600:1" << "only the addresses";
        QTest::newRow("only the family's name") << "xm430@57600:1" << "those that begin so: XM430-W";
        QTest::newRow("a rate it doesn't have") << "XL330-M288@4500000:1" << "4000000";
        QTest::newRow("a rate that is no number") << "XL330-M288@fast:1" << "4000000";
        QTest::newRow("an ID too high") << "XM430-W350@57600:253" << "252";
        QTest::newRow("an ID that is no number") << "XM430-W350@57600:x" << "252";
        QTest::newRow("firmware that is no number") << "XM430-W350/new@57600:1" << "firmware";
        QTest::newRow("the second one") << "XM430-W350@57600:1,XM999@57600:2" << "\"XM999@57600:2\"";
    }

    void bad()
    {
        QFETCH(QString, text);
        QFETCH(QString, named);
        const auto specs = parseServoSpecs(text, m_catalog);
        QVERIFY(!specs);
        QVERIFY2(specs.error().text.contains(named), qPrintable(specs.error().text));
    }

private:
    const Catalog m_catalog = test::builtInCatalog();
};

DYNASCOPE_CORE_TEST(TestServoSpecs)
#include "tst_servospecs.moc"
