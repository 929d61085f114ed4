// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/operations.h"
#include "core/bus/poller.h"
#include "core/bus/scan.h"
#include "tests/support/builtincatalog.h"
#include "tests/support/sessionfixture.h"
#include "tests/support/testmain.h"

using namespace dynascope;
using namespace std::chrono_literals;

namespace {

Traits traits(std::uint8_t id, bool fast)
{
    Traits result;
    result.id = id;
    result.fastReads = fast;
    return result;
}

} // namespace

/// Bus, operations and poller against servos that behave, in virtual time: what FakeLine's scripts can't know.
class TestBusSimulated : public QObject
{
    Q_OBJECT

    const Catalog &catalog() { return m_catalog; }
    const Catalog m_catalog = test::builtInCatalog();

private slots:
    void scansAllAtOneRate()
    {
        VirtualBus world(catalog(),
            QStringLiteral("XM430-W350@57600:1,XL430-W250@57600:7,XL330-M288@57600:252,XL330-M288@1000000:3"));
        std::vector<int> shown;
        const LineTime begin = world.line->now();
        const auto found
            = scanBaud(*world.bus, {0, 252}, {[&](const Found &device) { shown.push_back(device.id); }, {}, {}});
        QVERIFY(found);
        QCOMPARE(shown, (std::vector<int>{1, 7, 252}));
        QCOMPARE(found->devices[0].modelNumber, 1020);
        QCOMPARE(found->devices[2].modelNumber, 1200);
        for (const Found &device : found->devices)
            QCOMPARE(device.doubt, QString());
        QVERIFY(world.line->now() - begin < 900ms);
    }

    void twoDevicesUnderOneIdAreDoubted()
    {
        VirtualBus world(catalog(), QStringLiteral("XM430-W350@57600:1,XL330-M288@57600:1"));
        const auto found = scanBaud(*world.bus, {0, 252}, {});
        QVERIFY(found);
        QCOMPARE(found->devices.size(), std::size_t(1));
        QCOMPARE(found->devices.front().id, std::uint8_t(1));
        QVERIFY2(!found->devices.front().doubt.isEmpty(), "one healthy device");
    }

    void readsManyByEveryKindOfExchange()
    {
        VirtualBus world(catalog(), QStringLiteral("XM430-W350@57600:1,XM430-W350@57600:2,XM430-W350@57600:3"));
        for (const bool fast : {false, true}) {
            world.bus->setTraits({traits(1, fast), traits(2, fast), traits(3, fast)});
            for (const std::uint16_t other : {132, 126}) { // Sync, then Bulk
                const std::vector<Span> spans{{1, 132, 4}, {2, 132, 4}, {3, other, 4}};
                const auto values = readMany(*world.bus, spans);
                QVERIFY(values);
                for (const auto &value : *values) {
                    QVERIFY2(value, value ? "" : qPrintable(value.error().text));
                    QCOMPARE(value->data.size(), std::size_t(4));
                }
            }
        }
        QCOMPARE(world.bus->statistics().timeouts, quint64(0));
        QCOMPARE(world.bus->statistics().retries, quint64(0));
    }

    void theMissingOneIsBlamedAndTheOthersAreRead()
    {
        VirtualBus world(catalog(), QStringLiteral("XM430-W350@57600:1,XM430-W350@57600:3"));
        const std::vector<Span> spans{{1, 132, 4}, {2, 132, 4}, {3, 132, 4}};
        const auto once = world.bus->exchange(syncReadRequest(132, 4, std::vector<std::uint8_t>{1, 2, 3}, false), 0);
        QCOMPARE(once->brokenAt, 1);
        QVERIFY(once->replies[0] && !once->replies[2]); // the chain rule
        const auto values = readMany(*world.bus, spans);
        QVERIFY((*values)[0] && !(*values)[1] && (*values)[2]);
        QVERIFY((*values)[1].error().text.startsWith(QStringLiteral("device 2 did not answer")));
    }

    void writesAndRefusals()
    {
        VirtualBus world(catalog(), QStringLiteral("XM430-W350@57600:1"));
        QCOMPARE(*writeVerified(*world.bus, {1, 9, {20}}), Bytes{20}); // Return Delay Time
        QVERIFY(write(*world.bus, {1, 64, {1}}));
        const auto locked = write(*world.bus, {1, 9, {30}});
        QVERIFY(!locked);
        QCOMPARE(locked.error().number, std::uint8_t(DeviceError::Access));
        QVERIFY(locked.error().text.startsWith(QStringLiteral("device 1 refused: Access Error")));
        QVERIFY(!read(*world.bus, {1, 2000, 4}));
    }

    void aDamagedOrLostReplyIsAskedForAgain()
    {
        VirtualBus world(catalog(), QStringLiteral("XM430-W350@57600:1"));
        world.simulated.setFaults({.replies = {{.kind = sim::ReplyFault::Kind::Damaged}}});
        QVERIFY(read(*world.bus, {1, 132, 4}));
        QCOMPARE(world.bus->statistics().crcErrors, quint64(1));
        world.simulated.setFaults({.replies = {{.kind = sim::ReplyFault::Kind::Lost}}});
        QVERIFY(read(*world.bus, {1, 132, 4}));
        QCOMPARE(world.bus->statistics().retries, quint64(2));
        world.simulated.setFaults({.replies = {{.kind = sim::ReplyFault::Kind::Lost, .times = 2}}});
        QVERIFY(ping(*world.bus, 1));
        QCOMPARE(world.bus->statistics().retries, quint64(2)); // whether somebody is there is a question
    }

    void aLateReplyIsNeverTheNextValue()
    {
        for (const LineTime lateness : {LineTime(1ms), LineTime(3ms), LineTime(10ms), LineTime(40ms)}) {
            VirtualBus world(catalog(), QStringLiteral("XM430-W350@57600:1"));
            world.simulated.setFaults({.replies = {{.kind = sim::ReplyFault::Kind::Late, .time = lateness}}});
            (void)world.bus->exchange(readRequest({1, 0, 2}), 0); // 1020
            for (int i = 0; i < 5; ++i) {
                const auto baud = read(*world.bus, {1, 7, 2}); // ID, Baud Rate
                if (baud)
                    QCOMPARE(baud->data, (Bytes{1, 1}));
            }
        }
    }

    void echoAndSilenceByLevel()
    {
        VirtualBus world(catalog(), QStringLiteral("XM430-W350@57600:1"));
        world.simulated.setFaults({.echo = {.on = true}});
        QVERIFY(read(*world.bus, {1, 132, 4}));
        QVERIFY(!ping(*world.bus, 2));
        VirtualBus quiet(catalog(), QStringLiteral("XM430-W350@57600:1"));
        QVERIFY(write(*quiet.bus, {1, 68, {1}}, 0).has_value()
            || true); // whether this one is still answered is not documented
        Traits device = traits(1, false);
        device.statusReturnLevel = 1;
        quiet.bus->setTraits({device});
        QVERIFY(write(*quiet.bus, {1, 65, {1}}));
        QCOMPARE(read(*quiet.bus, {1, 65, 1})->data, Bytes{1});
    }

    void pollsAtTheSpeedOfTheWire()
    {
        VirtualBus world(
            catalog(), QStringLiteral("XM430-W350@1000000:1,XM430-W350@1000000:2,XM430-W350@1000000:3"), 1'000'000);
        for (const std::uint8_t id : {1, 2, 3})
            QVERIFY(write(*world.bus, {id, 9, {0}})); // Return Delay Time
        Poller poller(*world.bus);
        PollPlan plan;
        for (const std::uint8_t id : {1, 2, 3}) {
            plan.spans.push_back({id, {id, 126, 10}, 0ms});
            Traits device = traits(id, true);
            device.returnDelay = 0us;
            plan.traits.push_back(device);
        }
        poller.setPlan(plan);
        const LineTime begin = world.line->now();
        int cycles = 0;
        for (; world.line->now() - begin < 1s; ++cycles) {
            const auto batch = poller.runCycle();
            QVERIFY(batch);
            for (const PollValue &value : batch->values)
                QCOMPARE(value.data.size(), std::size_t(10));
        }
        // Reference: (14+N)·b + (8+N(L+4))·b for N = 3, L = 10 is 0.67 ms.
        QVERIFY2(cycles > 1100 && cycles < 1500, qPrintable(QString::number(cycles)));
        QCOMPARE(world.bus->statistics().timeouts, quint64(0));
    }

    void changesTheRate()
    {
        VirtualBus world(catalog(), QStringLiteral("XM430-W350@57600:1,XL330-M288@1000000:2"));
        QVERIFY(ping(*world.bus, 1));
        QVERIFY(!ping(*world.bus, 2));
        QVERIFY(world.bus->setBaudRate(1'000'000));
        QVERIFY(ping(*world.bus, 2));
        QVERIFY(!ping(*world.bus, 1));
        world.line->refuseBaudRate(4'500'000);
        QVERIFY(!world.bus->setBaudRate(4'500'000));
        QVERIFY(ping(*world.bus, 2));
    }

    /// Adapters hand the last bytes on a little later than computed, unless there is an answer to them.
    void theRateWaitsForWhatMayStillLeave()
    {
        VirtualBus world(catalog(), QStringLiteral("XM430-W350@1000000:1"), 1'000'000);
        world.line->setHostAllowance(5ms);
        QVERIFY(ping(*world.bus, 1)); // in less than a millisecond
        LineTime before = world.line->now();
        QVERIFY(world.bus->setBaudRate(2'000'000));
        QVERIFY(world.line->now() - before < 100us);
        QVERIFY(world.bus->sendOnly(encode(pingRequest(1).packet)));
        before = world.line->now();
        QVERIFY(world.bus->setBaudRate(1'000'000));
        QVERIFY(world.line->now() - before >= 2ms);
    }

    void aRebootingDeviceIsHeardAgain()
    {
        VirtualBus world(catalog(), QStringLiteral("XM430-W350@57600:1"));
        QVERIFY(reboot(*world.bus, 1));
        QVERIFY(!ping(*world.bus, 1));
        world.line->advance(1s);
        QVERIFY(ping(*world.bus, 1));
    }

    void unplugged()
    {
        VirtualBus world(catalog(), QStringLiteral("XM430-W350@57600:1"));
        world.line->unplug();
        QCOMPARE(ping(*world.bus, 1).error().kind, ErrorKind::PortLost);
    }
};

DYNASCOPE_CORE_TEST(TestBusSimulated)
#include "tst_bus_simulated.moc"
