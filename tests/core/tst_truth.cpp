// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/truth.h"
#include "tests/support/builtincatalog.h"
#include "tests/support/servobench.h"
#include "tests/support/testmain.h"

#include <QJsonArray>
#include <QJsonDocument>

using namespace dynascope;
using namespace dynascope::sim;
using namespace simclient;

/// The truth about a bus, as a control channel prints it.
class TestTruth : public QObject
{
    Q_OBJECT

private slots:
    void init() { m_bench.start(); }

    void registersByName()
    {
        m_bench.write(u"LED", 1);
        m_bench.write(u"Goal Velocity", -5);
        const QJsonObject said = truth(m_bench.servo());
        const QJsonObject registers = said.value(u"registers").toObject();
        QCOMPARE(registers.size(), qsizetype(m_bench.servo().table().fields().size()));
        for (const Field &field : m_bench.servo().table().fields())
            QCOMPARE(registers.value(field.name).toInteger(-12345), qint64(m_bench.servo().value(field)));
        QCOMPARE(registers.value(u"Goal Velocity").toInt(), -5);
        QCOMPARE(said.value(u"model").toString(), u"XM430-W350");
        QCOMPARE(said.value(u"id").toInt(), 1);
        QCOMPARE(said.value(u"baudRate").toInt(), 57600);
        QCOMPARE(said.value(u"led").toString(), u"on");
        QCOMPARE(said.value(u"power").toBool(), true);
        QCOMPARE(said.value(u"deaf").toBool(true), false);
    }

    void whatIsMemoryOnly()
    {
        QCOMPARE(truth(m_bench.servo()).value(u"notModelled").toArray(), QJsonArray());
        const Catalog catalog = test::builtInCatalog();
        SimulatedBus bus(catalog);
        const auto specs = parseServoSpecs(u"YM070-210-R051-RH@57600:1", catalog);
        QVERIFY2(specs, qPrintable(specs ? QString() : specs.error().text));
        QVERIFY(bus.add((*specs)[0]));
        const QJsonArray names = truth(*bus.servos().front()).value(u"notModelled").toArray();
        QVERIFY(names.contains(QStringLiteral("Drive Mode: Dynamic brake")));
        QVERIFY(names.contains(QStringLiteral("Brake Delay")));
        QVERIFY(!names.contains(QStringLiteral("Goal Position")));
    }

    void physicalState()
    {
        Joint &joint = m_bench.servo().joint();
        joint.setStops(90, 270);
        joint.setAmbientTemperature(30);
        m_bench.write(u"Operating Mode", 16);
        m_bench.write(u"Torque Enable", 1);
        m_bench.wait(200ms);
        joint.push(0.5, 10);
        m_bench.wait(10ms);
        QJsonObject state = truth(m_bench.servo()).value(u"physical").toObject();
        QVERIFY(state.value(u"speed").toDouble() > 10); // rev/min
        QCOMPARE(state.value(u"handTorque").toDouble(), 0.5);
        m_bench.wait(700ms);
        state = truth(m_bench.servo()).value(u"physical").toObject();
        QVERIFY(qAbs(state.value(u"angle").toDouble() - 270) < 1.5);
        QCOMPARE(state.value(u"speed").toDouble(), 0.0);
        QCOMPARE(state.value(u"highestStop").toDouble(), 270.0);
        QVERIFY(state.value(u"motorCurrent").toDouble() > 2);
        QVERIFY(state.value(u"motorTorque").toDouble() > 4);
        QVERIFY(state.value(u"voltage").toDouble() < 11.9);
        QVERIFY(state.value(u"windingTemperature").toDouble() > state.value(u"caseTemperature").toDouble() + 1);
        QCOMPARE(state.value(u"ambient").toDouble(), 30.0);
        joint.hold(100.0);
        QCOMPARE(truth(m_bench.servo()).value(u"physical").toObject().value(u"heldAt").toDouble(), 100.0);
    }

    void aDeafAndAFaultyOne()
    {
        m_bench.servo().inject(HardwareFault::Overload);
        QJsonObject said = truth(m_bench.servo());
        QCOMPARE(said.value(u"hardwareErrors").toArray(), QJsonArray{QStringLiteral("Overload")});
        QCOMPARE(said.value(u"shutDown").toBool(), true);
        QCOMPARE(said.value(u"led").toString(), u"blinking");
        m_bench.client().exchange(QStringLiteral("01 08"));
        m_bench.wait(10ms);
        said = truth(m_bench.servo());
        QCOMPARE(said.value(u"deaf").toBool(), true);
        QCOMPARE(said.value(u"shutDown").toBool(true), false);
        m_bench.servo().setPlugged(false);
        QCOMPARE(truth(m_bench.servo()).value(u"power").toBool(true), false);
    }

    void theMotorSaysWhatIsKnown()
    {
        const QJsonObject motor = truth(m_bench.servo()).value(u"motor").toObject();
        QCOMPARE(motor.value(u"name").toString(), u"XM430-W350");
        QVERIFY(motor.value(u"known").toArray().contains(QStringLiteral("stall torque")));
        QVERIFY(motor.value(u"chosen").toArray().contains(QStringLiteral("friction")));
    }

    void theWholeBus()
    {
        m_bench.add(QStringLiteral("XL330-M288"), -1, 57600, 2);
        m_bench.power().setResistance(0.2);
        m_bench.wait(100ms);
        const QJsonObject said = truth(m_bench.bus());
        QCOMPARE(said.value(u"servos").toArray().size(), 2);
        QCOMPARE(said.value(u"time").toDouble(), 100.0);
        const QJsonObject power = said.value(u"power").toObject();
        QCOMPARE(power.value(u"on").toBool(), true);
        const QJsonArray supplies = power.value(u"supplies").toArray();
        QCOMPARE(supplies.size(), 2);
        QCOMPARE(supplies[0].toObject().value(u"voltage").toDouble(), 12.0);
        QCOMPARE(supplies[1].toObject().value(u"voltage").toDouble(), 5.0);
        QCOMPARE(supplies[0].toObject().value(u"resistance").toDouble(), 0.2);
        QVERIFY(supplies[0].toObject().value(u"current").toDouble() > 0);
        QVERIFY(QJsonDocument(said).toJson().size() > 1000);
    }

    /// The same seed and script: the same truth, to the last digit.
    void deterministic()
    {
        QByteArray stories[2];
        for (QByteArray &story : stories) {
            m_bench.start();
            m_bench.add(QStringLiteral("XL430-W250"), -1, 57600, 2);
            m_bench.servo(0).joint().setGravityArm(0.8);
            for (int i = 0; i < 2; ++i)
                m_bench.write(u"Torque Enable", 1, i);
            for (int i = 0; i < 20; ++i) {
                m_bench.write(u"Goal Position", 1500 + 50 * i, i % 2);
                if (i == 7)
                    m_bench.servo(1).joint().push(0.4, 0.1);
                m_bench.wait(33ms);
                story += QJsonDocument(truth(m_bench.bus())).toJson();
            }
        }
        QCOMPARE(stories[0], stories[1]);
    }

private:
    const Catalog m_catalog = test::builtInCatalog();
    ServoBench m_bench{m_catalog};
};

DYNASCOPE_CORE_TEST(TestTruth)
#include "tst_truth.moc"
