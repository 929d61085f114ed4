// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/demo.h"
#include "tests/support/builtincatalog.h"
#include "tests/support/ptyclient.h"
#include "tests/support/simclient.h"
#include "tests/support/testmain.h"

using namespace dynascope;
using namespace dynascope::sim;
using namespace simclient;

/// The demo as a stranger's program meets it on its terminal.
class TestPtyDemo : public QObject
{
    Q_OBJECT

private slots:
    void init()
    {
        auto started = Demo::start(m_catalog);
        QVERIFY2(started, qPrintable(started ? QString() : started.error().text));
        m_demo = std::move(*started);
    }

    void everybodyIsThere()
    {
        PtyClient arm(m_demo->path(), 1000000);
        const std::pair<int, QString> expected[] = {
            {1, QStringLiteral("FC 03 2D")}, {2, QStringLiteral("FC 03 2D")}, {3, QStringLiteral("FC 03 2D")},
            {4, QStringLiteral("24 04 2D")}, {5, QStringLiteral("24 04 2D")}, {6, QStringLiteral("B0 04 35")}};
        for (const auto &[id, data] : expected) {
            const QString number = QString::number(id).rightJustified(2, u'0');
            arm.write(instruction(number + QStringLiteral(" 01")));
            const Bytes answer = status(number + QStringLiteral(" 00 ") + data);
            QCOMPARE(hex(arm.readAtLeast(answer.size(), 5000)), hex(answer));
        }
        arm.close();
        PtyClient fresh(m_demo->path(), 57600);
        fresh.write(instruction(QStringLiteral("01 01")));
        const Bytes answer = status(QStringLiteral("01 00 B0 04 35"));
        QCOMPARE(hex(fresh.readAtLeast(answer.size(), 5000)), hex(answer));
    }

    void movesUntilTorqueGoesOffAndAgainAfterResume()
    {
        QTRY_VERIFY(goalChanges(1));
        PtyClient arm(m_demo->path(), 1000000);
        arm.write(instruction(QStringLiteral("FE 83 40 00 01 00 01 00")));
        QTRY_COMPARE(value(1, u"Torque Enable"), 0);
        QVERIFY(!goalChanges(2)); // let go as well, though nobody spoke to it
        m_demo->resume();
        QTRY_COMPARE(value(1, u"Torque Enable"), 1);
        QTRY_VERIFY(goalChanges(2));
    }

private:
    std::int64_t value(int id, QStringView name)
    {
        std::int64_t raw = 0;
        m_demo->server().call([&](SimulatedBus &bus, LineTime) { raw = bus.servo(id, 1000000)->value(name); });
        return raw;
    }
    /// In the next half second.
    bool goalChanges(int id)
    {
        const std::int64_t before = value(id, u"Goal Position");
        return QTest::qWaitFor([&] { return value(id, u"Goal Position") != before; }, 500);
    }

    const Catalog m_catalog = test::builtInCatalog();
    std::unique_ptr<Demo> m_demo;
};

DYNASCOPE_CORE_TEST(TestPtyDemo)
#include "tst_ptydemo.moc"
