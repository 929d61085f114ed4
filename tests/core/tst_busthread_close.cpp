// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/operations.h"
#include "core/bus/scan.h"
#include "tests/support/busworld.h"
#include "tests/support/testmain.h"

#include <QSemaphore>
#include <QSignalSpy>

using namespace dynascope;
using namespace std::chrono_literals;

namespace {

using Operation = Result<void> (*)(Bus &);

/// At three rates; 9 is nobody.
const std::vector<StopTarget> Targets{{11, 1, 1'000'000, 64}, {12, 2, 57600, 64}, {13, 3, 9600, 64}, {14, 9, 9600, 64}};

template <typename T>
Result<void> outcome(const Result<T> &result)
{
    return result ? Result<void>() : tl::unexpected(result.error());
}

} // namespace

/// A line is closed at once, whatever it waits for.
class TestBusThreadClose : public QObject
{
    Q_OBJECT

private slots:
    void initTestCase() { qRegisterMetaType<std::vector<StopOutcome>>(); }

    void whatIsWaitedForEnds_data()
    {
        QTest::addColumn<Operation>("operation");
        const auto row = [](const char *name, Operation operation) { QTest::newRow(name) << operation; };
        row("Clear", [](Bus &bus) { return clear(bus, 9, ClearOption::Position); });
        row("Backup", [](Bus &bus) { return backup(bus, 9, BackupOption::Store); });
        row("Factory Reset", [](Bus &bus) { return factoryReset(bus, 9, ResetOption::All); });
        row("Read with its retries", [](Bus &bus) { return outcome(read(bus, {9, 64, 1})); });
        row("write and read back", [](Bus &bus) { return outcome(writeVerified(bus, {1, 64, {1}})); });
        row("broadcast Ping", [](Bus &bus) { return outcome(scanBaud(bus, {0, 252}, {})); });
        row("a wait", [](Bus &bus) {
            (void)bus.exchange(pingRequest(9), 0);
            return bus.wait(1s);
        });
    }
    void whatIsWaitedForEnds()
    {
        QFETCH(Operation, operation);
        FakeLine line(57600);
        line.allowance = 50ms;
        FakeServos servos(line);
        servos.servos[1].baudRate = 57600;
        std::atomic<bool> cancel = false;
        LineTime left{};
        line.handler = [&, inner = line.handler](const Bytes &request) {
            cancel = true; // 9 is nobody
            left = line.now() + static_cast<LineTime::rep>(request.size()) * line.byteTime();
            return inner(request);
        };
        Bus bus(line, nullptr);
        bus.setCancel(&cancel);
        const Result<void> result = operation(bus);
        QVERIFY(!result);
        QCOMPARE(result.error().kind, ErrorKind::Cancelled);
        QCOMPARE(line.sent.size(), std::size_t(1));
        QVERIFY(line.now() >= left); // not cut in the middle
        QVERIFY(line.now() - left <= 2ms);
        cancel = false;
        line.handler = [&servos](const Bytes &request) { return servos.answer(request); };
        QVERIFY(ping(bus, 1)); // nothing is left over
    }

    void aRunningJobEndsAtOnce_data()
    {
        QTest::addColumn<bool>("isExclusive");
        QTest::newRow("as it is") << false;
        QTest::newRow("between the writes of a change") << true;
    }
    void aRunningJobEndsAtOnce()
    {
        QFETCH(bool, isExclusive);
        Closing closing(1);
        closing.world.run(Priority::Click, [isExclusive](JobContext &context) -> Result<int> {
            std::optional<JobContext::Exclusive> scope;
            if (isExclusive)
                scope.emplace(context);
            for (;;) { // nobody is there
                const Result<void> cleared = clear(context.bus(), 9, ClearOption::Position);
                if (!cleared && cleared.error().kind == ErrorKind::Cancelled)
                    return tl::unexpected(cleared.error());
            }
        });
        QCOMPARE(closing.packetsAfter(), 0);
        QVERIFY(closing.world.outcomes.contains(QStringLiteral("cancelled")));
    }

    void pollingEndsAtOnce()
    {
        Closing closing(5);
        PollPlan plan; // six are missing
        for (std::uint8_t id = 1; id < 10; ++id)
            plan.spans.push_back({id, {id, static_cast<std::uint16_t>(130 + id), 1}, 0ms});
        closing.world.thread.setPollPlan(plan);
        QCOMPARE(closing.packetsAfter(), 0);
    }

    void stopsPacketsStillGoOutButNobodyIsAskedAnyMore()
    {
        Closing closing(1); // STOP's first packet
        closing.world.thread.setStopTargets(Targets);
        closing.world.thread.stop();
        QCOMPARE(closing.packetsAfter(), 5); // two each at three rates
        for (const FakeLine::Sent &sent : *closing.world.factory.log)
            QCOMPARE(static_cast<Instruction>(sent.bytes[7]), Instruction::SyncWrite);
    }

    void readingBackEndsAtOnce()
    {
        Closing closing(7); // the first after those of STOP
        QSignalSpy finished(&closing.world.thread, &BusThread::stopFinished);
        closing.world.thread.setStopTargets(Targets);
        closing.world.thread.stop();
        QCOMPARE(closing.packetsAfter(), 0);
        QCOMPARE(finished.size(), 1);
        for (const StopOutcome &each : finished.front().front().value<std::vector<StopOutcome>>())
            QVERIFY(!each.off);
    }

private:
    /// Closes the line while its n-th packet goes out.
    struct Closing {
        explicit Closing(int packet)
            : world([this, packet](FakeLine &line, FakeServos &) {
                line.handler = [this, packet, inner = line.handler](const Bytes &request) {
                    if (++count == packet) {
                        arrived.release();
                        isClosing.acquire();
                    }
                    return inner(request);
                };
            })
        {
        }

        /// How many went out after it.
        int packetsAfter()
        {
            arrived.acquire();
            // Closing takes a waiting job apart before it waits for the thread.
            std::shared_ptr<void> guard(nullptr, [this](void *) { isClosing.release(); });
            world.run(Priority::Scan, [guard = std::move(guard)](JobContext &) -> Result<int> { return 0; });
            const int before = count;
            world.thread.close();
            return count - before;
        }

        QSemaphore arrived, isClosing;
        std::atomic<int> count = 0;
        BusWorld world;
    };
};

DYNASCOPE_CORE_TEST(TestBusThreadClose)
#include "tst_busthread_close.moc"
