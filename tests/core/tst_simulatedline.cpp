// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/simulatedline.h"
#include "core/table/catalog.h"
#include "tests/support/builtincatalog.h"
#include "tests/support/simclient.h"
#include "tests/support/testmain.h"

using namespace dynascope;
using namespace dynascope::sim;
using namespace simclient;

class TestSimulatedLine : public QObject
{
    Q_OBJECT

private slots:
    void initTestCase()
    {
        m_ping = instruction(QStringLiteral("01 01"));
        m_answer = status(QStringLiteral("01 00 FC 03 2D"));
    }

    void init()
    {
        m_bus = std::make_unique<SimulatedBus>(m_catalog);
        QVERIFY(m_bus->add({QStringLiteral("XM430-W350"), -1, 57600, 1}));
    }

    void readsByteByByteInVirtualTime()
    {
        SimulatedLine line(*m_bus);
        QVERIFY(line.write(m_ping));
        QCOMPARE(line.now(), LineTime{}); // writing doesn't wait
        Bytes heard;
        while (heard.size() < m_answer.size()) {
            const std::size_t before = heard.size();
            QVERIFY(line.read(heard, 50ms));
            QVERIFY(heard.size() > before);
        }
        QCOMPARE(hex(heard), hex(m_answer));
        const auto bytes = static_cast<int>(m_ping.size() + m_answer.size());
        QCOMPARE(line.now(), bytes * line.byteTime() + 600us);
    }

    void silenceEndsAtTheDeadline()
    {
        SimulatedLine line(*m_bus);
        Bytes heard;
        QVERIFY(line.read(heard, 16ms));
        QVERIFY(heard.empty());
        QCOMPARE(line.now(), LineTime(16ms));
        QVERIFY(line.read(heard, 10ms)); // long past: does not go back
        QCOMPARE(line.now(), LineTime(16ms));
    }

    void echo()
    {
        SimulatedLine line(*m_bus);
        m_bus->setFaults({.echo = {.on = true}});
        QVERIFY(line.write(m_ping));
        Bytes heard;
        while (heard.size() < m_ping.size())
            QVERIFY(line.read(heard, 50ms));
        QCOMPARE(hex(heard), hex(m_ping));
        QCOMPARE(line.now(), static_cast<int>(m_ping.size()) * line.byteTime());
    }

    void discards()
    {
        SimulatedLine line(*m_bus);
        QVERIFY(line.write(m_ping));
        line.advance(50ms);
        line.discardInput();
        Bytes heard;
        QVERIFY(line.read(heard, line.now() + 50ms));
        QVERIFY(heard.empty());
    }

    void refusesARate()
    {
        SimulatedLine line(*m_bus);
        line.refuseBaudRate(4500000);
        const auto refused = line.setBaudRate(4500000);
        QVERIFY(!refused);
        QCOMPARE(refused.error().kind, ErrorKind::PortUnsuitable);
        QCOMPARE(line.baudRate(), 57600);
        QVERIFY(line.setBaudRate(1000000));
        QCOMPARE(line.baudRate(), 1000000);
    }

    void unplugged()
    {
        SimulatedLine line(*m_bus);
        line.unplug();
        Bytes heard;
        QCOMPARE(line.read(heard, 1ms).error().kind, ErrorKind::PortLost);
        QCOMPARE(line.write(m_ping).error().kind, ErrorKind::PortLost);
        QCOMPARE(line.setBaudRate(57600).error().kind, ErrorKind::PortLost);
    }

private:
    const Catalog m_catalog = test::builtInCatalog();
    Bytes m_ping, m_answer;
    std::unique_ptr<SimulatedBus> m_bus;
};

DYNASCOPE_CORE_TEST(TestSimulatedLine)
#include "tst_simulatedline.moc"
