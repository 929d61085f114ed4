// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/control.h"
#include "core/sim/servo.h"
#include "tests/support/builtincatalog.h"
#include "tests/support/simclient.h"
#include "tests/support/testmain.h"

#include <QJsonArray>
#include <QJsonDocument>

using namespace dynascope;
using namespace dynascope::sim;
using namespace simclient;

/// The lines of a control channel.
class TestControl : public QObject
{
    Q_OBJECT

private slots:
    void init()
    {
        m_bus = std::make_unique<SimulatedBus>(m_catalog);
        QVERIFY(m_bus->add({QStringLiteral("XM430-W350"), -1, 57600, 1}));
        QVERIFY(m_bus->add({QStringLiteral("XM430-W350"), -1, 57600, 2}));
        QVERIFY(m_bus->add({QStringLiteral("XM430-W350"), -1, 1000000, 2}));
        m_quit = 0;
    }

    void obeys_data()
    {
        QTest::addColumn<QString>("line");
        QTest::addColumn<QString>("answer"); // the begin of it
        const auto row = [](const char *line, const char *answer) {
            QTest::newRow(line) << QString::fromLatin1(line) << QString::fromLatin1(answer);
        };
        row("push 1 0.3", "ok");
        row("push 1 -0.3Nm", "ok");
        row("push all 0", "ok");
        row("gravity 1 0.5", "ok");
        row("inertia #2 0.01", "ok");
        row("angle tilt 90deg", "ok");
        row("temperature 2@1000000 40C", "ok");
        row("supply 11.1V", "ok");
        row("supply 1 12", "ok");
        row("error 1 0x20", "error: ");
        row("error 1 32", "ok");
        row("write 1 Return Delay Time=5", "ok");
        row("write 1 LED=2", "error: ID 1 refused with error 4");
        row("write 1 Colour=2", "error: XM430-W350 has no register Colour");
        row("write 1 LED=300", "error: LED does not hold 300");
        row("  fault   echo   latency=16ms ", "ok");
        row("fault clear", "ok");
        row("fault", "error: ");
        row("hold 1", "ok");
        row("hold 1 90deg", "ok");
        row("release 1", "ok");
        row("push 1 0.5 0.2s", "ok");
        row("push 1 0.5 soon", "error: \"soon\"");
        row("stops 1 90 270", "ok");
        row("stops 1 270 90", "error: stops WHO");
        row("stops 1 none", "ok");
        row("supply 1 99999", "error: ");
        row("fault nonsense", "error: \"nonsense\"");
        row("unplug 1", "ok");
        row("unplug adapter", "ok");
        row("power off", "ok");
        row("power off 1", "ok");
        row("power maybe", "error: power on or power off");
        row("quit", "ok");
        row("help", "[");
        row("help push", "[\"push WHO");
        row("help frobnicate", "error: ");
        row("status", "{");
        row("truth", "{");
        row("truth 1", "{");
        row("", "error: No command");
        row("frobnicate", "error: No command is called frobnicate");
        row("push 1", "error: push WHO TORQUE");
        row("push 1 nan", "error: ");
        row("push 1 1e9", "error: ");
        row("push 9 1", "error: No device is 9");
        row("push 2 1", "error: 2 devices are 2");
        row("push #4 1", "error: No device");
        row("push base 1", "ok");
        row("push Base 1", "error: No device is Base");
    }

    void obeys()
    {
        QFETCH(QString, line);
        QFETCH(QString, answer);
        const QString said = obey(line);
        QVERIFY2(said.startsWith(answer), qPrintable(said));
        QVERIFY(!said.contains(u'\n'));
    }

    void tooLong() { QVERIFY(obey(QString(5000, u'x')).contains(QStringLiteral("4096"))); }

    void quits()
    {
        obey(QStringLiteral("quit"));
        QCOMPARE(m_quit, 1);
    }

    void aDeviceIsUnpluggedAndPlugged()
    {
        Client client{*m_bus};
        client.exchange(QStringLiteral("01 03 41 00 01")); // LED: RAM
        client.exchange(QStringLiteral("01 03 09 00 05")); // Return Delay Time: EEPROM
        m_bus->advanceTo(client.now += 200ms);             // a cut in the middle of the write may leave the old value
        QCOMPARE(obey(QStringLiteral("unplug 1")), QStringLiteral("ok"));
        QVERIFY(client.exchange(QStringLiteral("01 01")).empty());
        QVERIFY(!client.exchange(QStringLiteral("02 01")).empty());
        QCOMPARE(obey(QStringLiteral("plug 1")), QStringLiteral("ok"));
        client.now += 1s; // it boots
        QCOMPARE(hex(client.exchange(QStringLiteral("01 02 41 00 01 00"))), hex(status(QStringLiteral("01 00 00"))));
        QCOMPARE(hex(client.exchange(QStringLiteral("01 02 09 00 01 00"))), hex(status(QStringLiteral("01 00 05"))));
    }

    void aHandPushes()
    {
        m_bus->advanceTo(100ms);
        const qint64 before = m_bus->servos()[0]->value(u"Present Position");
        obey(QStringLiteral("push base 0.5"));
        m_bus->advanceTo(1s);
        QVERIFY(m_bus->servos()[0]->value(u"Present Position") > before + 100);
    }

    void aHandHolds()
    {
        obey(QStringLiteral("hold base 100deg"));
        obey(QStringLiteral("push base 0.5"));
        m_bus->advanceTo(1s);
        const double held = angle();
        QVERIFY2(std::abs(held - 100) < 5, qPrintable(QString::number(held)));
        obey(QStringLiteral("release base"));
        m_bus->advanceTo(2s);
        QVERIFY(angle() > held + 30);
        obey(QStringLiteral("stops base -1000 3600"));
        m_bus->advanceTo(60s);
        QVERIFY(std::abs(angle() - 3600) < 5);
    }

    void theBusLosesPowerAndGetsItBack()
    {
        Client client{*m_bus};
        obey(QStringLiteral("supply 2@57600 12V")); // one of its own
        obey(QStringLiteral("power off"));
        QVERIFY(client.exchange(QStringLiteral("01 01")).empty());
        QVERIFY(client.exchange(QStringLiteral("02 01")).empty());
        obey(QStringLiteral("power on"));
        client.now += 1s;
        QVERIFY(!client.exchange(QStringLiteral("01 01")).empty());
        QVERIFY(!client.exchange(QStringLiteral("02 01")).empty());
    }

    void faultsAddUp()
    {
        obey(QStringLiteral("fault latency=16ms"));
        obey(QStringLiteral("fault dead-segment=1"));
        QCOMPARE(m_bus->faults().latencyTimer, LineTime(16ms));
        QCOMPARE(m_bus->faults().deaf, std::vector<int>{1});
        obey(QStringLiteral("unplug adapter"));
        QVERIFY(m_bus->isUnplugged());
        obey(QStringLiteral("plug adapter"));
        QVERIFY(!m_bus->isUnplugged());
        QCOMPARE(m_bus->faults().latencyTimer, LineTime(16ms));
        obey(QStringLiteral("fault clear"));
        QVERIFY(m_bus->faults() == LineFaults{});
    }

    void truth()
    {
        m_bus->servos()[0]->write(u"LED", 1);
        const QJsonObject one = QJsonDocument::fromJson(obey(QStringLiteral("truth base")).toUtf8()).object();
        QCOMPARE(one.value(u"model").toString(), QStringLiteral("XM430-W350"));
        QCOMPARE(one.value(u"registers").toObject().value(u"LED").toInt(), 1);
        QVERIFY(one.value(u"physical").toObject().contains(u"angle"));
        const QJsonObject all = QJsonDocument::fromJson(obey(QStringLiteral("truth")).toUtf8()).object();
        QCOMPARE(all.value(u"servos").toArray().size(), 3);
    }

private:
    double angle()
    {
        const QJsonObject truth = QJsonDocument::fromJson(obey(QStringLiteral("truth base")).toUtf8()).object();
        return truth.value(u"physical").toObject().value(u"angle").toDouble();
    }

    QString obey(const QString &line)
    {
        Control control({[] { return QJsonObject(); }, [this] { ++m_quit; }},
                        {QStringLiteral("base"), QStringLiteral("tilt"), QString()});
        return QString::fromUtf8(control.obey(line.toUtf8(), *m_bus, m_bus->now()));
    }

    const Catalog m_catalog = test::builtInCatalog();
    std::unique_ptr<SimulatedBus> m_bus;
    int m_quit = 0;
};

DYNASCOPE_CORE_TEST(TestControl)
#include "tst_control.moc"
