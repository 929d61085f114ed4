// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/demoscript.h"
#include "core/table/catalog.h"
#include "tests/support/builtincatalog.h"
#include "tests/support/simclient.h"
#include "tests/support/testmain.h"

using namespace dynascope;
using namespace dynascope::sim;
using namespace simclient;

/// The demo's script against a person on the wire, in virtual time.
class TestDemoScript : public QObject
{
    Q_OBJECT

private slots:
    void init()
    {
        m_bus = std::make_unique<SimulatedBus>(m_catalog);
        m_client.emplace(Client{*m_bus, 1000000, 1s});
        m_script = std::make_unique<DemoScript>();
        for (const int id : {1, 2}) {
            auto servo = m_bus->add({QStringLiteral("XM430-W350"), -1, 1000000, id});
            QVERIFY(servo);
            m_script->add(**servo, {2048, 400, 4.0, 0.25 * id, 0, 0});
        }
        m_script->resume(m_client->now);
        run(1s);
    }

    void cleanup()
    {
        m_bus.reset(); // before the script that watches it
        m_script.reset();
    }

    void takesOverSmoothlyAndFollows()
    {
        QVERIFY(isHeld(0) && isHeld(1));
        std::int64_t lowest = 4096, highest = 0;
        for (int i = 0; i < 200; ++i) {
            run(50ms);
            const std::int64_t goal = servo(0).value(u"Goal Position");
            const std::int64_t position = servo(0).value(u"Present Position");
            QVERIFY(qAbs(goal - position) < 120);
            lowest = std::min(lowest, position);
            highest = std::max(highest, position);
        }
        QVERIFY(highest - lowest > 600);
        QCOMPARE(servo(0).value(u"Hardware Error Status"), 0);
    }

    void letsGo_data()
    {
        QTest::addColumn<QString>("packet");
        QTest::addColumn<bool>("firstHeld");
        QTest::addColumn<bool>("secondHeld");
        QTest::newRow("reading is nothing") << "01 02 84 00 04 00" << true << true;
        QTest::newRow("a goal takes the joint") << "01 03 74 00 00 08 00 00" << false << true;
        QTest::newRow("a Sync Write too") << "FE 83 74 00 04 00 01 00 08 00 00" << false << true;
        QTest::newRow("any other register too") << "01 03 41 00 01" << false << true;
        QTest::newRow("what was refused does not") << "01 03 09 00 00" << true << true;
        QTest::newRow("torque off lets all go") << "01 03 40 00 00" << false << false;
        QTest::newRow("as STOP does") << "FE 83 40 00 01 00 01 00 02 00" << false << false;
        QTest::newRow("a reboot takes the torque of one") << "01 08" << false << true;
    }

    void letsGo()
    {
        QFETCH(QString, packet);
        QFETCH(bool, firstHeld);
        QFETCH(bool, secondHeld);
        m_client->exchange(packet);
        run(100ms);
        QCOMPARE(isHeld(0), firstHeld);
        QCOMPARE(isHeld(1), secondHeld);
        const std::int64_t goal = servo(0).value(u"Goal Position");
        run(500ms);
        QCOMPARE(servo(0).value(u"Goal Position") != goal, firstHeld);
    }

    void resumes()
    {
        m_client->exchange(QStringLiteral("FE 83 40 00 01 00 01 00 02 00"));
        run(1s);
        QCOMPARE(servo(0).value(u"Torque Enable"), 0);
        m_script->resume(m_client->now);
        run(100ms);
        QVERIFY(isHeld(0) && isHeld(1));
        QCOMPARE(servo(0).value(u"Torque Enable"), 1);
        QVERIFY(qAbs(servo(0).value(u"Goal Position") - servo(0).value(u"Present Position")) < 40); // no jump
    }

private:
    void run(LineTime duration)
    {
        for (const LineTime end = m_client->now + duration; m_client->now < end; m_client->now += 10ms) {
            m_bus->advanceTo(m_client->now);
            m_script->tick(m_client->now);
        }
    }
    Servo &servo(std::size_t index) { return *m_bus->servos()[index]; }
    bool isHeld(std::size_t index) { return m_script->isHeld(servo(index)); }

    const Catalog m_catalog = test::builtInCatalog();
    std::unique_ptr<SimulatedBus> m_bus;
    std::unique_ptr<DemoScript> m_script;
    std::optional<Client> m_client;
};

DYNASCOPE_CORE_TEST(TestDemoScript)
#include "tst_demoscript.moc"
