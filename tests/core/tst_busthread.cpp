// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/busthread.h"
#include "core/bus/operations.h"
#include "tests/support/busworld.h"
#include "tests/support/testmain.h"

#include <QSemaphore>
#include <QSignalSpy>
#include <QThread>

using namespace dynascope;
using namespace std::chrono_literals;

namespace {

Traits traits(std::uint8_t id)
{
    Traits result;
    result.id = id;
    return result;
}

} // namespace

class TestBusThread : public QObject
{
    Q_OBJECT

    using World = BusWorld;

private slots:
    void opensAndCloses()
    {
        World world;
        QSignalSpy changes(&world.thread, &BusThread::stateChanged);
        QCOMPARE(world.thread.state(), BusThread::State::Opening);
        QTRY_COMPARE(world.thread.state(), BusThread::State::Open);
        QCOMPARE(world.thread.baudRate(), 1'000'000);
        world.thread.close();
        QCOMPARE(world.thread.state(), BusThread::State::Closed);
        QCOMPARE(changes.size(), 2);
    }

    void saysWhyItCanNotOpen()
    {
        FakeFactory factory;
        BusThread thread(factory, QStringLiteral("nowhere"), 57600);
        QTRY_COMPARE(thread.state(), BusThread::State::Closed);
        QCOMPARE(thread.error().kind, ErrorKind::PortNotFound);
        QString outcome;
        thread.run<int>(
            Priority::Normal, this, [](JobContext &) -> Result<int> { return 1; },
            [&](const Result<int> &result) { outcome = World::text(result); });
        QTRY_COMPARE(outcome, QStringLiteral("there is no port nowhere"));
    }

    void runsAJobThereAndDeliversHere()
    {
        World world;
        QThread *there = nullptr;
        QThread *here = nullptr;
        int value = 0;
        world.thread.run<Bytes>(
            Priority::Normal, this,
            [&](JobContext &context) -> Result<Bytes> {
                there = QThread::currentThread();
                const Result<ReadReply> reply = read(context.bus(), {2, 132, 4});
                if (!reply)
                    return tl::unexpected(reply.error());
                return reply->data;
            },
            [&](const Result<Bytes> &data) {
                here = QThread::currentThread();
                value = data ? (*data)[0] : -1;
            });
        QTRY_COMPARE(value, 2);
        QCOMPARE(here, QThread::currentThread());
        QVERIFY(there && there != here);
    }

    void deliversNothingToTheDead()
    {
        World world;
        auto context = std::make_unique<QObject>();
        QSemaphore go;
        world.run(
            Priority::Normal,
            [&](JobContext &) -> Result<int> {
                go.acquire();
                return 1;
            },
            context.get());
        world.run(Priority::Normal, [](JobContext &) -> Result<int> { return 2; });
        context.reset();
        go.release();
        QTRY_COMPARE(world.outcomes, QStringList(QStringLiteral("2")));
    }

    void highestPriorityFirstThenInOrder()
    {
        World world;
        QSemaphore go;
        QSemaphore started;
        world.run(Priority::Click, [&](JobContext &) -> Result<int> {
            started.release();
            go.acquire();
            return 0;
        });
        started.acquire();
        const auto job = [&](int value) { return [value](JobContext &) -> Result<int> { return value; }; };
        world.run(Priority::Scan, job(1));
        world.run(Priority::Normal, job(2));
        world.run(Priority::Click, job(3));
        world.run(Priority::Normal, job(4));
        world.run(Priority::Click, job(5));
        go.release();
        QTRY_COMPARE(world.outcomes.join(QLatin1Char(' ')), QStringLiteral("0 3 5 2 4 1"));
    }

    void aCheckpointLetsTheUrgentInAndRestoresTheBaud()
    {
        World world;
        QSemaphore started, go;
        std::vector<int> bauds;
        world.run(Priority::Scan, [&](JobContext &context) -> Result<int> {
            if (!context.bus().setBaudRate(57600))
                return -1;
            started.release();
            go.acquire();
            if (!context.checkpoint())
                return -2;
            bauds.push_back(context.bus().line().baudRate());
            return 1;
        });
        started.acquire();
        world.run(Priority::Click, [&](JobContext &context) -> Result<int> {
            bauds.push_back(context.bus().line().baudRate());
            return 2;
        });
        world.run(Priority::Scan, [&](JobContext &context) -> Result<int> {
            bauds.push_back(context.bus().line().baudRate());
            return 3;
        });
        go.release();
        QTRY_COMPARE(world.outcomes.join(QLatin1Char(' ')), QStringLiteral("2 1 3"));
        QCOMPARE(bauds, (std::vector<int>{1'000'000, 57600, 1'000'000}));
    }

    void anExclusiveScopeLetsNobodyIn()
    {
        World world;
        QSemaphore started, go;
        world.run(Priority::Scan, [&](JobContext &context) -> Result<int> {
            {
                const JobContext::Exclusive scope(context);
                started.release();
                go.acquire();
                if (!context.checkpoint())
                    return -1;
                context.post([&] { world.outcomes << QStringLiteral("scope ends"); });
            }
            (void)context.checkpoint();
            return 1;
        });
        started.acquire();
        world.run(Priority::Click, [](JobContext &) -> Result<int> { return 2; });
        go.release();
        QTRY_COMPARE(world.outcomes.join(QLatin1Char(' ')), QStringLiteral("scope ends 2 1"));
    }

    void cancelsTheWaitingAndTheRunning()
    {
        World world;
        QSemaphore started, go;
        const JobId running = world.run(Priority::Normal, [&](JobContext &context) -> Result<int> {
            started.release();
            go.acquire();
            if (const Result<void> on = context.checkpoint(); !on)
                return tl::unexpected(on.error());
            return 1;
        });
        const JobId waiting = world.run(Priority::Normal, [](JobContext &) -> Result<int> { return 2; });
        started.acquire();
        world.thread.cancel(waiting);
        QTRY_COMPARE(world.outcomes, QStringList(QStringLiteral("cancelled")));
        world.thread.cancel(running);
        go.release();
        QTRY_COMPARE(world.outcomes, (QStringList{QStringLiteral("cancelled"), QStringLiteral("cancelled")}));
    }

    void polls()
    {
        World world;
        QSignalSpy ready(&world.thread, &BusThread::batchesReady);
        PollPlan plan;
        for (const std::uint8_t id : {1, 2, 3}) {
            plan.spans.push_back({id, {id, 132, 4}, 0ms});
            plan.traits.push_back(traits(id));
        }
        world.thread.setPollPlan(plan);
        QTRY_COMPARE(ready.size(), 1);
        world.run(Priority::Normal, [](JobContext &) -> Result<int> { return 1; }); // gets in between two cycles
        QTRY_COMPARE(world.outcomes.size(), 1);
        QCOMPARE(ready.size(), 1); // one notice until somebody takes them
        const std::vector<Batch> batches = world.thread.takeBatches();
        QVERIFY(!batches.empty());
        QVERIFY(batches.size() <= 2000);
        QCOMPARE(batches.front().values.size(), std::size_t(3));
        QCOMPARE(batches.front().values[1].data[0], std::uint8_t(2));
        QTRY_VERIFY(ready.size() >= 2);
        QVERIFY(world.thread.statistics().exchanges > 0);
        world.thread.setPollPlan({});
    }

    void movesToAnotherBaud()
    {
        World world;
        QTRY_COMPARE(world.thread.state(), BusThread::State::Open);
        world.thread.setWorkingBaudRate(57600);
        QCOMPARE(world.thread.baudRate(), 57600);
        world.run(Priority::Normal, [](JobContext &context) -> Result<int> { return context.bus().line().baudRate(); });
        QTRY_COMPARE(world.outcomes, QStringList(QStringLiteral("57600")));
    }

    void aRateThatThePortCanNotDoIsGivenUp()
    {
        World world([](FakeLine &line, FakeServos &) { line.refusedBaud = 4'500'000; });
        world.thread.setWorkingBaudRate(4'500'000);
        world.thread.setWorkingBaudRate(1'000'000);
        QTRY_COMPARE(world.thread.state(), BusThread::State::Open);
        world.thread.setWorkingBaudRate(4'500'000);
        QTRY_COMPARE(world.thread.baudRate(), 1'000'000);
    }

    void aLostPortEndsEverythingQueued()
    {
        FakeLine *line = nullptr;
        World world([&](FakeLine &made, FakeServos &) { line = &made; });
        QSemaphore go;
        world.run(Priority::Normal, [&](JobContext &context) -> Result<int> {
            go.acquire();
            line->unplugged = true;
            const Result<PingReply> reply = ping(context.bus(), 1);
            return reply ? Result<int>(1) : tl::unexpected(reply.error());
        });
        world.run(Priority::Normal, [](JobContext &) -> Result<int> { return 2; });
        go.release();
        QTRY_COMPARE(world.thread.state(), BusThread::State::Lost);
        QCOMPARE(world.thread.error().kind, ErrorKind::PortLost);
        QTRY_COMPARE(world.outcomes, (QStringList{QStringLiteral("fake is gone"), QStringLiteral("fake is gone")}));
        world.run(Priority::Normal, [](JobContext &) -> Result<int> { return 3; });
        QTRY_COMPARE(world.outcomes.size(), 3);
        QCOMPARE(world.outcomes.last(), QStringLiteral("fake is gone"));
    }

    void closingCancelsWhatWaits()
    {
        World world;
        QSemaphore started;
        world.run(Priority::Normal, [&](JobContext &context) -> Result<int> {
            started.release();
            for (;;) {
                if (const Result<void> on = context.checkpoint(); !on)
                    return tl::unexpected(on.error());
            }
        });
        world.run(Priority::Normal, [](JobContext &) -> Result<int> { return 2; });
        started.acquire();
        world.thread.close();
        QCOMPARE(world.outcomes, (QStringList{QStringLiteral("fake was closed"), QStringLiteral("fake was closed")}));
    }

    void aDeliveryMayDestroyTheThread()
    {
        FakeFactory factory;
        auto thread = std::make_unique<BusThread>(factory, QStringLiteral("fake"), 1'000'000);
        int deliveries = 0;
        for (int i = 0; i < 3; ++i) {
            thread->run<int>(
                Priority::Normal, this, [](JobContext &) -> Result<int> { return 1; },
                [&](const Result<int> &) {
                    ++deliveries;
                    thread.reset();
                });
        }
        QTRY_VERIFY(!thread);
        QCOMPARE(deliveries, 1);
    }
};

DYNASCOPE_CORE_TEST(TestBusThread)
#include "tst_busthread.moc"
