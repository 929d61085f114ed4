// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/operations.h"
#include "core/bus/scan.h"
#include "core/session/volatilespan.h"
#include "tests/support/builtincatalog.h"
#include "tests/support/busworld.h"
#include "tests/support/oracle.h"
#include "tests/support/sessionfixture.h"
#include "tests/support/testmain.h"

#include <QSemaphore>

using namespace dynascope;
using namespace std::chrono_literals;

namespace {

/// The first 16 registers: Realtime Tick at 0, Present Position at 2.
VolatileSpan fakeSpan()
{
    return {0, 16, 0, {{2, 4, 100, 1000}}};
}

/// One Read of `fakeSpan()`.
Bytes volatileData(int tick, int position)
{
    Bytes data;
    appendLittleEndian(data, static_cast<std::uint32_t>(tick), 2);
    appendLittleEndian(data, static_cast<std::uint32_t>(position), 4);
    data.resize(16);
    return data;
}

} // namespace

/// What a scan finds, and what it doubts.
class TestScan : public QObject
{
    Q_OBJECT

    const Catalog m_catalog = test::builtInCatalog();

    ScanHooks comparing() const
    {
        ScanHooks hooks;
        hooks.volatileOf = [this](const Found &found) {
            return volatileSpanOf(*m_catalog.find(found.modelNumber, found.firmware));
        };
        return hooks;
    }

private slots:
    void scans()
    {
        FakeLine line;
        FakeServos devices(line);
        for (const int id : {0, 1, 7, 200})
            devices.servos[id];
        devices.servos[9].baudRate = 57600;
        Bus bus(line);
        std::vector<int> shown;
        const auto found = scanBaud(bus, {1, 252}, {[&](const Found &device) { shown.push_back(device.id); }, {}, {}});
        QVERIFY(found);
        QCOMPARE(shown, (std::vector<int>{1, 7, 200}));
        QCOMPARE(found->devices.size(), std::size_t(3));
        QCOMPARE(found->devices[1], (Found{7, 1'000'000, 1025, 45, false, {}}));
        QVERIFY(line.now() < 900ms);
    }

    void scanTakesNoErrorForADevice()
    {
        FakeLine line;
        line.answer(oracle::status(9, 0xFF, {6, 4, 38}));
        Bus bus(line);
        QCOMPARE(scanBaud(bus, {0, 252}, {}).value().devices.size(), std::size_t(0));
    }

    void scanDoubtsWhoSharesAnId()
    {
        // Two voices under ID 1: the second comes behind the first, in the scan and when asked alone.
        FakeLine line;
        line.handler = [](const Bytes &) -> FakeLine::Answer {
            return {{500us, oracle::status(1, 0, {6, 4, 38})}, {600us, oracle::status(1, 0, {6, 4, 38})}};
        };
        Bus bus(line);
        const auto found = scanBaud(bus, {0, 252}, {});
        QCOMPARE(found->devices.size(), std::size_t(1));
        QVERIFY2(found->devices.front().doubt.contains(QStringLiteral("share ID 1")),
                 qPrintable(found->devices.front().doubt));
    }

    void scanFindsWhoCanNotBeRead()
    {
        // Their bits collide: nothing but damaged packets.
        FakeLine line;
        line.handler = [](const Bytes &request) -> FakeLine::Answer {
            if (request[4] != 1 && request[4] != 254)
                return {};
            Bytes packet = oracle::status(1, 0, {6, 4, 38});
            packet[10] ^= 0x11;
            return {{500us, packet}};
        };
        Bus bus(line);
        const auto found = scanBaud(bus, {0, 252}, {});
        QCOMPARE(found->devices.size(), std::size_t(1));
        QCOMPARE(found->devices.front().id, std::uint8_t(1));
        QVERIFY2(found->devices.front().doubt.contains(QStringLiteral("share ID 1")),
                 qPrintable(found->devices.front().doubt));
    }

    void scanSaysThatSomebodyIsThere()
    {
        FakeLine line;
        line.answer({0x12, 0xFE, 0x40, 0x81, 0x22, 0x97}); // nobody's packet, and nobody answers a Ping of its own
        Bus bus(line);
        const auto found = scanBaud(bus, {0, 252}, {});
        QVERIFY(found && found->devices.empty());
        QVERIFY2(found->unreadable.contains(QStringLiteral("6 bytes came")), qPrintable(found->unreadable));
    }

    void noiseIsNobody_data()
    {
        QTest::addColumn<bool>("sweep");
        QTest::newRow("broadcast") << false;
        QTest::newRow("sweep") << true;
    }

    void noiseIsNobody()
    {
        QFETCH(bool, sweep);
        FakeLine line;
        for (int i = 0; i < 4000; ++i)
            line.babble(i * 500us, {static_cast<std::uint8_t>(i * 7)});
        Bus bus(line);
        const auto found = scanBaud(bus, {0, 40, sweep}, {});
        QVERIFY(found && found->devices.empty());
        QVERIFY(!found->unreadable.isEmpty());
    }

    // A Read of three bytes is still unanswered: an answer to the broadcast Ping might be its own.
    void aScanLosesNobodyOverALateAnswer()
    {
        FakeLine line;
        line.silence();
        Bus bus(line);
        QVERIFY(!read(bus, {1, 144, 3}));
        line.handler = [](const Bytes &request) -> FakeLine::Answer {
            if (request[7] == 2)
                return {{500us, oracle::status(1, 0, Bytes(request[10], 7))}};
            return {{500us, oracle::status(1, 0, {6, 4, 38})}};
        };
        const auto found = scanBaud(bus, {0, 252}, {});
        QVERIFY(found);
        QCOMPARE(found->devices.size(), std::size_t(1));
        QCOMPARE(found->devices.front().modelNumber, std::uint16_t(1030));
    }

    void anEchoIsNobody_data()
    {
        QTest::addColumn<bool>("sweep");
        QTest::newRow("broadcast") << false;
        QTest::newRow("sweep") << true;
    }

    void anEchoIsNobody()
    {
        QFETCH(bool, sweep);
        FakeLine line;
        line.echo = true;
        Bus bus(line);
        const auto found = scanBaud(bus, {0, 252, sweep}, {});
        QVERIFY(found && found->devices.empty());
        QCOMPARE(found->unreadable, QString());
    }

    void sweepsWhereABroadcastFails()
    {
        FakeLine line;
        line.handler = [](const Bytes &request) -> FakeLine::Answer {
            if (request[4] != 1 && request[4] != 7)
                return {};
            return {{500us, oracle::status(request[4], 0, {6, 4, 38})}};
        };
        Bus bus(line);
        std::vector<int> shown;
        const auto found
            = scanBaud(bus, {0, 20, true}, {[&](const Found &device) { shown.push_back(device.id); }, {}, {}});
        QVERIFY(found);
        QCOMPARE(shown, (std::vector<int>{1, 7}));
        QCOMPARE(line.sent.size(), std::size_t(21));
        QVERIFY(line.now() < 60ms);
    }

    void scanOfNobody()
    {
        FakeLine line;
        Bus bus(line);
        const auto found = scanBaud(bus, {0, 252}, {});
        QVERIFY(found && found->devices.empty() && found->unreadable.isEmpty());
    }

    void twoAlikeUnderOneIdAreDoubted_data()
    {
        QTest::addColumn<QString>("servos");
        QTest::addColumn<bool>("sweep");
        for (const bool sweep : {false, true}) {
            const char *way = sweep ? ", sweep" : "";
            QTest::addRow("two fresh ones%s", way) << "XM430-W350@57600:1,XM430-W350@57600:1" << sweep;
            QTest::addRow("three%s", way) << "XL330-M288@57600:1,XL330-M288@57600:1,XL330-M288@57600:1" << sweep;
            QTest::addRow("beside others%s", way)
                << "XL430-W250@57600:1,XM430-W350@57600:0,XL430-W250@57600:1,XM430-W350@57600:2" << sweep;
        }
    }

    /// As they come from the factory: same model, same ID, same rate. Their answers to Ping are the same, bit for bit.
    void twoAlikeUnderOneIdAreDoubted()
    {
        QFETCH(QString, servos);
        QFETCH(bool, sweep);
        VirtualBus world(m_catalog, servos);
        std::vector<Found> told;
        ScanHooks hooks = comparing();
        hooks.found = [&](const Found &found) { told.push_back(found); };
        const auto found = scanBaud(*world.bus, {0, 10, sweep}, hooks);
        QVERIFY(found);
        for (const Found &device : found->devices) {
            const bool doubted = device.doubt.contains(QStringLiteral("two devices seem to share ID 1"));
            QVERIFY2(doubted == (device.id == 1),
                     qPrintable(QStringLiteral("%1: %2").arg(device.id).arg(device.doubt)));
            QCOMPARE(std::ranges::count(told, device), 1);
        }
    }

    void oneOfEachIsNotDoubted()
    {
        VirtualBus world(m_catalog, QStringLiteral("XM430-W350@57600:1,XM430-W350@57600:2,XL430-W250@57600:3,"
                                                   "XL330-M288@57600:4"));
        QVERIFY(write(*world.bus, {1, 64, {1}}));
        QVERIFY(write(*world.bus, {1, 116, {0, 0, 0, 0}})); // it runs while it is looked at
        const auto found = scanBaud(*world.bus, {0, 10}, comparing());
        QVERIFY(found);
        QCOMPARE(found->devices.size(), std::size_t(4));
        for (const Found &device : found->devices)
            QCOMPARE(device.doubt, QString());
    }

    void readsAreCompared_data()
    {
        QTest::addColumn<QList<int>>("ticks");     // of each read, milliseconds off; −1: damaged, −2: none
        QTest::addColumn<QList<int>>("positions"); // the last goes on
        QTest::addColumn<bool>("doubted");
        QTest::newRow("one") << QList<int>{0} << QList<int>{500} << false;
        QTest::newRow("moving") << QList<int>{0} << QList<int>{500, 540} << false;
        QTest::newRow("jumping once") << QList<int>{0} << QList<int>{500, 4000} << false;
        QTest::newRow("one of two each time") << QList<int>{0} << QList<int>{500, 4000, 500, 4000, 500, 4000} << true;
        QTest::newRow("ticks of two") << QList<int>{0, 900, 0, 900, 0, 900} << QList<int>{500} << true;
        QTest::newRow("rebooted") << QList<int>{900, 0} << QList<int>{500} << false;
        QTest::newRow("one damaged by noise") << QList<int>{-1, 0} << QList<int>{500} << false;
        QTest::newRow("all damaged") << QList<int>{-1} << QList<int>{500} << true;
        QTest::newRow("one of two each time, the first lost") << QList<int>{-2, 0, 900, 0, 900, 0, 900} << QList<int>{500}
                                                              << true;
        QTest::newRow("answers no Read") << QList<int>{-2} << QList<int>{500} << false;
    }

    void readsAreCompared()
    {
        QFETCH(QList<int>, ticks);
        QFETCH(QList<int>, positions);
        QFETCH(bool, doubted);
        FakeLine line;
        qsizetype reads = 0;
        line.handler = [&](const Bytes &request) -> FakeLine::Answer {
            if (request[7] != 2)
                return {{500us, oracle::status(1, 0, {6, 4, 38})}};
            const int tick = ticks[std::min(reads, ticks.size() - 1)];
            const int position = positions[std::min(reads, positions.size() - 1)];
            ++reads;
            if (tick == -2)
                return {};
            const auto now = static_cast<int>(line.now() / 1ms) + 32760; // goes round meanwhile
            Bytes packet = oracle::status(1, 0, volatileData((now + std::max(tick, 0)) % 32768, position));
            packet[12] ^= tick == -1 ? 0x10 : 0;
            return {{500us, packet}};
        };
        Bus bus(line);
        int between = 0;
        const auto doubt = compareReads(bus, {1, 1'000'000, 1030, 38, false, {}}, fakeSpan(), [&]() -> Result<void> {
            ++between;
            return bus.wait(3ms);
        });
        QVERIFY(doubt);
        QVERIFY2(doubt->isEmpty() != doubted, qPrintable(*doubt));
        QVERIFY(between >= reads && reads <= 7);
    }

    void aSecondVoiceShowsInASweep()
    {
        FakeLine line;
        line.handler = [](const Bytes &request) -> FakeLine::Answer {
            if (request[4] != 1)
                return {};
            return {{500us, oracle::status(1, 0, {6, 4, 38})}, {900us, oracle::status(1, 0, {6, 4, 38})}};
        };
        Bus bus(line);
        const auto found = scanBaud(bus, {0, 5, true});
        QVERIFY(found);
        QCOMPARE(found->devices.size(), std::size_t(1));
        QVERIFY2(found->devices.front().doubt.contains(QStringLiteral("share ID 1")),
                 qPrintable(found->devices.front().doubt));
    }

    void othersUseTheLineMeanwhile_data()
    {
        QTest::addColumn<bool>("sweep");
        QTest::newRow("broadcast") << false;
        QTest::newRow("sweep") << true;
    }

    /// Between two exchanges; what they hear makes nobody doubtful.
    void othersUseTheLineMeanwhile()
    {
        QFETCH(bool, sweep);
        VirtualBus world(m_catalog, QStringLiteral("XM430-W350@57600:1,XM430-W350@57600:2,XM430-W350@57600:3"));
        world.simulated.setLogging(true);
        ScanHooks hooks = comparing();
        int others = 0;
        double last = 0;
        hooks.between = [&](double part) -> Result<void> {
            if (part < last || part > 1)
                return failure(ErrorKind::InvalidArgument, QStringLiteral("%1 after %2").arg(part).arg(last));
            last = part;
            ++others;
            if (const auto reply = read(*world.bus, {2, 132, 4}); !reply)
                return tl::unexpected(reply.error());
            return {};
        };
        const auto found = scanBaud(*world.bus, {0, 10, sweep}, hooks);
        QVERIFY2(found, found ? "" : qPrintable(found.error().text));
        QCOMPARE(found->devices.size(), std::size_t(3));
        for (const Found &device : found->devices)
            QCOMPARE(device.doubt, QString());
        int exchanges = 0;
        for (const sim::WireEntry &entry : world.simulated.log())
            exchanges += entry.fromController ? 1 : 0;
        QCOMPARE(others, exchanges - others - (sweep ? 0 : 1)); // one before each but the broadcast Ping
    }

    void whatComesBetweenMayEndIt()
    {
        for (const bool sweep : {false, true}) {
            for (int last = 1; last < 6; ++last) {
                VirtualBus world(m_catalog, QStringLiteral("XM430-W350@57600:1,XM430-W350@57600:2"));
                ScanHooks hooks = comparing();
                int calls = 0;
                hooks.between = [&](double) -> Result<void> {
                    return ++calls < last ? Result<void>() : failure(ErrorKind::Cancelled, QStringLiteral("enough"));
                };
                const auto found = scanBaud(*world.bus, {0, 10, sweep}, hooks);
                QVERIFY(!found);
                QCOMPARE(found.error().text, QStringLiteral("enough"));
                QCOMPARE(calls, last);
            }
        }
    }

    /// A click's write goes out before the next Ping but one.
    void aClickWaitsForOnePingOfASweep()
    {
        BusWorld world;
        QSemaphore isUnderWay, isQueued;
        world.run(Priority::Scan, [&](JobContext &context) -> Result<int> {
            ScanHooks hooks;
            int pings = 0;
            hooks.between = [&](double) {
                if (++pings == 20) {
                    isUnderWay.release();
                    isQueued.acquire();
                }
                return context.checkpoint();
            };
            const auto found = scanBaud(context.bus(), {0, 60, true}, hooks);
            return found ? Result<int>(static_cast<int>(found->devices.size())) : tl::unexpected(found.error());
        });
        QVERIFY(isUnderWay.tryAcquire(1, 10'000));
        world.run(Priority::Click, [](JobContext &context) -> Result<int> {
            const Result<void> written = write(context.bus(), {2, 65, {1}});
            return written ? Result<int>(100) : tl::unexpected(written.error());
        });
        isQueued.release();
        QTRY_COMPARE(world.outcomes.join(QLatin1Char(' ')), QStringLiteral("100 3"));
        world.thread.close();
        const std::vector<FakeLine::Sent> &sent = *world.factory.log;
        const auto written = std::ranges::find_if(sent, [](const FakeLine::Sent &one) { return one.bytes[7] == 3; });
        QVERIFY(written != sent.end());
        QCOMPARE(written - sent.begin(), 19);
    }
};

DYNASCOPE_CORE_TEST(TestScan)
#include "tst_scan.moc"
