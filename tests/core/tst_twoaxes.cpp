// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/simulatedbus.h"
#include "tests/support/builtincatalog.h"
#include "tests/support/simclient.h"
#include "tests/support/testmain.h"

#include <QFile>

using namespace dynascope;
using namespace dynascope::sim;
using namespace simclient;

/// A model with two axes: two devices on the wire, one baud rate, one lock of the EEPROM. The table says so.
class TestTwoAxes : public QObject
{
    Q_OBJECT

private slots:
    void initTestCase()
    {
        QFile file(QStringLiteral(DYNASCOPE_SOURCE_DIR "/tests/data/tables/two-axes.json"));
        QVERIFY(file.open(QIODevice::ReadOnly));
        const auto added = m_catalog.add(file.readAll(), QStringLiteral("two-axes.json"));
        QVERIFY2(added, qPrintable(added ? QString() : added.error().text));
        QCOMPARE(m_catalog.find(65001, 255)->description().axes, 2);
        QCOMPARE(m_catalog.find(1020, 255)->description().axes, 1);
    }

    void init()
    {
        m_bus = std::make_unique<SimulatedBus>(m_catalog);
        const auto specs = parseServoSpecs(u"Two axes@57600:1+2", m_catalog);
        QVERIFY2(specs, qPrintable(specs ? QString() : specs.error().text));
        QCOMPARE((*specs)[0].secondId, 2);
        QVERIFY(m_bus->add((*specs)[0]));
        QCOMPARE(m_bus->servos().size(), std::size_t(2));
    }

    void specs_data()
    {
        QTest::addColumn<QString>("text");
        QTest::addColumn<QString>("says");
        QTest::newRow("one ID for two axes") << "Two axes@57600:1" << "two IDs";
        QTest::newRow("two IDs for one axis") << "XL430-W250@57600:1+2" << "one ID";
        QTest::newRow("the same twice") << "Two axes@57600:1+1" << "different IDs";
        QTest::newRow("three") << "Two axes@57600:1+2+3" << "252";
        QTest::newRow("no second") << "Two axes@57600:1+" << "252";
        QTest::newRow("too high") << "Two axes@57600:1+253" << "252";
    }

    void specs()
    {
        QFETCH(QString, text);
        QFETCH(QString, says);
        const auto read = parseServoSpecs(text, m_catalog);
        QVERIFY(!read);
        QVERIFY2(read.error().text.contains(says), qPrintable(read.error().text));
    }

    void bothAnswer()
    {
        Client client{*m_bus};
        QCOMPARE(hex(client.exchange(QStringLiteral("01 02 07 00 01 00"))), hex(status(QStringLiteral("01 00 01"))));
        QCOMPARE(hex(client.exchange(QStringLiteral("02 02 07 00 01 00"))), hex(status(QStringLiteral("02 00 02"))));
    }

    void oneLockOfTheEeprom()
    {
        Client client{*m_bus};
        QCOMPARE(hex(client.exchange(QStringLiteral("02 03 40 00 01"))), hex(status(QStringLiteral("02 00"))));
        QCOMPARE(hex(client.exchange(QStringLiteral("01 03 09 00 05"))), hex(status(QStringLiteral("01 07"))));
        QCOMPARE(hex(client.exchange(QStringLiteral("02 03 09 00 05"))), hex(status(QStringLiteral("02 07"))));
        QCOMPARE(hex(client.exchange(QStringLiteral("02 03 40 00 00"))), hex(status(QStringLiteral("02 00"))));
        QCOMPARE(hex(client.exchange(QStringLiteral("01 03 09 00 05"))), hex(status(QStringLiteral("01 00"))));
        QCOMPARE(m_bus->servos()[1]->value(u"Return Delay Time"), 250); // registers are each axis's own
    }

    void oneBaudRate()
    {
        Client client{*m_bus};
        QCOMPARE(hex(client.exchange(QStringLiteral("02 03 08 00 03"))), hex(status(QStringLiteral("02 00"))));
        client.baudRate = 1000000;
        for (const QString &id : {QStringLiteral("01"), QStringLiteral("02")})
            QCOMPARE(hex(client.exchange(id + QStringLiteral(" 02 08 00 01 00"))), hex(status(id + QStringLiteral(" 00 03"))));
    }

    void aFactoryResetOfOneTakesTheRateOfBoth()
    {
        Client client{*m_bus};
        client.exchange(QStringLiteral("01 03 08 00 03"));
        client.baudRate = 1000000;
        QVERIFY(!client.exchange(QStringLiteral("01 06 01"), 1s).empty()); // all but the ID
        client.baudRate = 57600;
        for (const QString &id : {QStringLiteral("01"), QStringLiteral("02")})
            QVERIFY(!client.exchange(id + QStringLiteral(" 01"), 1s).empty());
    }

    void aFactoryResetOfAllGivesEachAxisItsOwnId()
    {
        m_bus = std::make_unique<SimulatedBus>(m_catalog);
        QVERIFY(m_bus->add((*parseServoSpecs(u"Two axes@57600:11+12", m_catalog))[0]));
        Client client{*m_bus};
        QVERIFY(!client.exchange(QStringLiteral("0C 06 FF"), 1s).empty());
        QCOMPARE(m_bus->servos()[1]->id(), 2);
        QCOMPARE(m_bus->servos()[0]->id(), 11); // the other is a device of its own
        QVERIFY(!client.exchange(QStringLiteral("0B 06 FF"), 1s).empty());
        QCOMPARE(m_bus->servos()[0]->id(), 1);
    }

private:
    Catalog m_catalog = test::builtInCatalog();
    std::unique_ptr<SimulatedBus> m_bus;
};

DYNASCOPE_CORE_TEST(TestTwoAxes)
#include "tst_twoaxes.moc"
