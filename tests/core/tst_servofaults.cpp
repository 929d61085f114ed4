// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/truth.h"
#include "tests/support/servobench.h"
#include "tests/support/testmain.h"

#include <QJsonArray>
#include <QJsonObject>

using namespace dynascope;
using namespace dynascope::sim;
using namespace simclient;

Q_DECLARE_METATYPE(dynascope::sim::HardwareFault)

/// Hardware errors: what latches them, Alert, Shutdown, the LED, and what clears them.
class TestServoFaults : public QObject
{
    Q_OBJECT

private slots:
    void init() { m_bench.start(); }

    void injected_data()
    {
        QTest::addColumn<QString>("model");
        QTest::addColumn<HardwareFault>("fault");
        QTest::addColumn<int>("bit"); // 0: the model doesn't know it
        for (const char *model : {"XM430-W350", "XL430-W250", "XL330-M288"}) {
            const bool encoder = QString::fromLatin1(model) != u"XL330-M288";
            QTest::addRow("%s voltage", model) << model << HardwareFault::InputVoltage << 0x01;
            QTest::addRow("%s hall", model) << model << HardwareFault::HallSensor << 0;
            QTest::addRow("%s heat", model) << model << HardwareFault::Overheating << 0x04;
            QTest::addRow("%s encoder", model) << model << HardwareFault::Encoder << (encoder ? 0x08 : 0);
            QTest::addRow("%s shock", model) << model << HardwareFault::ElectricalShock << 0x10;
            QTest::addRow("%s overload", model) << model << HardwareFault::Overload << 0x20;
        }
    }

    /// Each fault with its Shutdown bit clear, then set.
    void injected()
    {
        QFETCH(QString, model);
        QFETCH(HardwareFault, fault);
        QFETCH(int, bit);
        for (const bool shutsDown : {false, true}) {
            m_bench.start(model);
            if (bit == 0) {
                QVERIFY(!m_bench.servo().inject(fault));
                QCOMPARE(m_bench.value(u"Hardware Error Status"), 0);
                continue;
            }
            m_bench.write(u"Shutdown", shutsDown ? bit : 0x3D & ~bit);
            m_bench.write(u"Torque Enable", 1);
            QVERIFY(m_bench.servo().inject(fault));
            QCOMPARE(m_bench.value(u"Hardware Error Status"), bit);
            QCOMPARE(m_bench.value(u"Torque Enable"), shutsDown ? 0 : 1);
            QCOMPARE(m_bench.servo().joint().torque(), !shutsDown);
            QCOMPARE(m_bench.tryWrite(u"LED", 0), 0x80); // Alert beside success
            QCOMPARE(led(), shutsDown ? QStringLiteral("blinking") : QStringLiteral("off"));
            m_bench.tryWrite(u"Torque Enable", 1);
            QCOMPARE(m_bench.value(u"Torque Enable"), shutsDown ? 0 : 1); // stays off until a reboot
            m_bench.client().exchange(QStringLiteral("01 08"));
            m_bench.wait(500ms);
            QCOMPARE(m_bench.value(u"Hardware Error Status"), 0);
            QCOMPARE(m_bench.tryWrite(u"Torque Enable", 1), 0);
            QCOMPARE(m_bench.value(u"Torque Enable"), 1);
        }
    }

    void ledFollowsItsRegister()
    {
        QCOMPARE(led(), QStringLiteral("off"));
        m_bench.write(u"LED", 1);
        QCOMPARE(led(), QStringLiteral("on"));
        m_bench.servo().setPower(false);
        QCOMPARE(led(), QStringLiteral("off"));
    }

    void overloadByAStop()
    {
        m_bench.servo().joint().setStops(std::nullopt, 200);
        m_bench.write(u"Torque Enable", 1);
        m_bench.write(u"Goal Position", 3500);
        m_bench.wait(800ms);
        QCOMPARE(m_bench.value(u"Hardware Error Status"), 0);
        m_bench.wait(2s);
        QCOMPARE(m_bench.value(u"Hardware Error Status"), 0x20);
        QCOMPARE(m_bench.value(u"Torque Enable"), 0); // in the factory's Shutdown
        m_bench.wait(5s);
        QCOMPARE(m_bench.value(u"Hardware Error Status"), 0x20); // latched, though it is over
    }

    void overheating()
    {
        m_bench.write(u"Shutdown", 0x04);
        m_bench.servo().joint().setAmbientTemperature(90);
        m_bench.write(u"Torque Enable", 1);
        m_bench.wait(100ms);
        QCOMPARE(m_bench.value(u"Hardware Error Status"), 0);
        m_bench.wait(1h);
        QVERIFY(m_bench.value(u"Present Temperature") > 80);
        QCOMPARE(m_bench.value(u"Hardware Error Status"), 4);
        QCOMPARE(m_bench.value(u"Torque Enable"), 0);
        m_bench.client().exchange(QStringLiteral("01 08"));
        m_bench.wait(500ms);
        QCOMPARE(m_bench.value(u"Hardware Error Status"), 4); // it still is too hot
    }

    void voltage_data()
    {
        QTest::addColumn<double>("volts");
        QTest::addColumn<int>("status");
        QTest::newRow("right") << 12.0 << 0;
        QTest::newRow("low") << 9.3 << 1;
        QTest::newRow("just enough") << 9.6 << 0;
        QTest::newRow("high") << 16.2 << 1;
        QTest::newRow("just not too much") << 15.9 << 0;
    }

    void voltage()
    {
        QFETCH(double, volts);
        QFETCH(int, status);
        m_bench.power().setVoltage(volts);
        m_bench.wait(100ms);
        QCOMPARE(m_bench.value(u"Hardware Error Status"), status);
        QCOMPARE(m_bench.value(u"Torque Enable"), 0);
    }

    /// A Voltage Limit in the EEPROM is what counts.
    void theLimitsAreRegisters()
    {
        m_bench.write(u"Max Voltage Limit", 110);
        m_bench.wait(50ms);
        QCOMPARE(m_bench.value(u"Hardware Error Status"), 1);
    }

    void severalErrorsAddUp()
    {
        m_bench.servo().inject(HardwareFault::InputVoltage);
        m_bench.servo().inject(HardwareFault::Encoder);
        QCOMPARE(m_bench.value(u"Hardware Error Status"), 9);
        const QJsonArray names = truth(m_bench.servo()).value(u"hardwareErrors").toArray();
        QCOMPARE(names, QJsonArray({QStringLiteral("Input voltage"), QStringLiteral("Motor encoder")}));
    }

private:
    QString led()
    {
        m_bench.wait(0ms);
        return truth(m_bench.servo()).value(u"led").toString();
    }

    const Catalog m_catalog = test::builtInCatalog();
    ServoBench m_bench{m_catalog};
};

DYNASCOPE_CORE_TEST(TestServoFaults)
#include "tst_servofaults.moc"
