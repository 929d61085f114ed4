// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/poller.h"
#include "tests/support/fakeservos.h"
#include "tests/support/oracle.h"
#include "tests/support/testmain.h"

using namespace dynascope;
using namespace std::chrono_literals;

namespace {

PollSpan span(std::uint8_t id, std::chrono::milliseconds interval = 0ms)
{
    return {static_cast<quint32>(100 + id), {id, 132, 4}, interval};
}

Traits traits(std::uint8_t id, bool fast = false)
{
    Traits result;
    result.id = id;
    result.fastReads = fast;
    return result;
}

/// "101=1 102=2 103:silent"
QString toText(const Result<Batch> &batch)
{
    if (!batch)
        return batch.error().text;
    QStringList parts;
    for (const PollValue &value : batch->values)
        parts << QStringLiteral("%1%2")
                     .arg(value.device)
                     .arg(value.data.empty() ? QStringLiteral(":silent") : QStringLiteral("=%1").arg(value.data[0]));
    return parts.join(QLatin1Char(' '));
}

} // namespace

class TestPoller : public QObject
{
    Q_OBJECT

    /// A bus with servos 1, 2, 3 that hold their ID at 132.
    struct World {
        World() : servos(line), bus(line), poller(bus)
        {
            for (const int id : {1, 2, 3})
                servos.servos[id].registers[132] = static_cast<std::uint8_t>(id);
        }
        void plan(std::vector<PollSpan> spans, bool fast = false)
        {
            poller.setPlan({AnyRate, std::move(spans), {traits(1, fast), traits(2, fast), traits(3, fast)}, {}});
        }
        int sentOf(Instruction code) const
        {
            int count = 0;
            for (const FakeLine::Sent &sent : line.sent)
                count += sent.bytes[7] == static_cast<std::uint8_t>(code);
            return count;
        }
        /// Cycles as they come due, for so long; the text of the last error of device 1.
        QString run(LineTime duration)
        {
            QString text;
            for (const LineTime end = line.now() + duration; line.now() < end;) {
                Bytes ignored;
                while (line.now() < std::min(poller.nextDue(), end))
                    (void)line.read(ignored, std::min(poller.nextDue(), end));
                const auto batch = poller.runCycle();
                for (const PollValue &value : batch ? batch->values : std::vector<PollValue>()) {
                    if (value.device == 101)
                        text = value.data.empty() ? value.error.text : QStringLiteral("answers");
                }
            }
            return text;
        }
        quint64 timeouts() const { return bus.statistics().timeouts; }
        FakeLine line;
        FakeServos servos;
        Bus bus;
        Poller poller;
    };

private slots:
    void readsAllInOneExchange()
    {
        World world;
        QVERIFY(world.poller.isIdle());
        world.plan({span(1), span(2), span(3)}, true);
        QVERIFY(!world.poller.isIdle());
        const auto batch = world.poller.runCycle();
        QCOMPARE(toText(batch), QStringLiteral("101=1 102=2 103=3"));
        QVERIFY(batch->fullRate);
        QVERIFY(batch->end > batch->begin);
        QCOMPARE(world.line.sent.size(), std::size_t(1));
        QCOMPARE(world.sentOf(Instruction::FastSyncRead), 1);
    }

    void keepsIntervals()
    {
        World world;
        world.plan({span(1), span(2, 100ms)});
        QCOMPARE(toText(world.poller.runCycle()), QStringLiteral("101=1 102=2"));
        int both = 0, cycles = 0;
        while (world.line.now() < 1s) {
            QVERIFY(world.poller.nextDue() <= world.line.now());
            both += toText(world.poller.runCycle()).contains(QStringLiteral("102"));
            ++cycles;
        }
        QVERIFY2(both >= 9 && both <= 10, qPrintable(QString::number(both)));
        QVERIFY(cycles > 500);
    }

    void isDueWhenItSaysSo()
    {
        World world;
        world.plan({span(1, 100ms), span(2, 250ms)});
        (void)world.poller.runCycle();
        const LineTime due = world.poller.nextDue();
        QVERIFY(due > world.line.now() + 90ms && due <= world.line.now() + 100ms);
        const auto early = world.poller.runCycle();
        QCOMPARE(toText(early), QString());
        QVERIFY(!early->fullRate);
        world.poller.setPlan({});
        QVERIFY(world.poller.isIdle());
        QCOMPARE(world.poller.nextDue(), LineTime::max());
    }

    void aSilentDeviceHidesNoOther()
    {
        World world;
        world.servos.servos[1].silent = true;
        world.plan({span(1), span(2), span(3)});
        for (int i = 0; i < 3; ++i)
            QCOMPARE(toText(world.poller.runCycle()), QStringLiteral("101:silent 102=2 103=3"));
        // Then it is asked rarely, and the others at full rate.
        const std::size_t before = world.line.sent.size();
        const LineTime begin = world.line.now();
        int cycles = 0;
        for (; world.line.now() < begin + 1s; ++cycles)
            QVERIFY(toText(world.poller.runCycle()).contains(QStringLiteral("102=2 103=3")));
        const int pings = world.sentOf(Instruction::Ping);
        QVERIFY2(pings < 20, qPrintable(QString::number(pings)));
        QVERIFY(static_cast<int>(world.line.sent.size() - before) < cycles + 20);
        // It returns by itself.
        world.servos.servos[1].silent = false;
        const LineTime back = world.line.now();
        while (toText(world.poller.runCycle()) != QStringLiteral("101=1 102=2 103=3"))
            QVERIFY(world.line.now() < back + 3500ms);
    }

    void aLoneSilentDeviceIsProbedWithBackOff()
    {
        World world;
        world.servos.servos.clear();
        world.plan({span(1)});
        for (int i = 0; i < 3; ++i)
            QCOMPARE(toText(world.poller.runCycle()), QStringLiteral("101:silent"));
        LineTime before = world.line.now();
        std::vector<LineTime> gaps;
        for (int i = 0; i < 8; ++i) {
            const LineTime due = world.poller.nextDue();
            gaps.push_back(due - before);
            QVERIFY(due > world.line.now());
            Bytes ignored;
            QVERIFY(world.line.read(ignored, due));
            QCOMPARE(toText(world.poller.runCycle()), QStringLiteral("101:silent"));
            before = world.line.now();
        }
        QVERIFY(gaps.front() <= 100ms);
        QVERIFY(gaps.back() > 2900ms && gaps.back() <= 3s);
    }

    /// A table may have a hole that its device refuses to read: then it is read around it, in the same cycle.
    void aRefusedGapIsReadAround()
    {
        World world;
        world.line.handler = [&](const Bytes &request) {
            const int length = request[7] == static_cast<std::uint8_t>(Instruction::Read) ? request[10] : 0;
            if (length > 4)
                return FakeLine::Answer{{FakeLine::DefaultDelay, oracle::status(1, 7, {})}}; // Access error
            return world.servos.answer(request);
        };
        world.servos.servos[1].registers[140] = 7;
        world.plan({span(1), {101, {1, 140, 1}, 0ms}});
        QCOMPARE(toText(world.poller.runCycle()), QStringLiteral("101=1 101=7"));
        const std::size_t sent = world.line.sent.size();
        QCOMPARE(sent, std::size_t(3));
        QCOMPARE(toText(world.poller.runCycle()), QStringLiteral("101=1 101=7"));
        QCOMPARE(world.line.sent.size(), sent + 2); // it is known now
    }

    /// Where it can be read, it is one exchange, and each span gets its part.
    void aGapIsReadThrough()
    {
        World world;
        world.servos.servos[1].registers[140] = 7;
        world.plan({{101, {1, 140, 1}, 0ms}, span(1)});
        const auto batch = world.poller.runCycle();
        QCOMPARE(toText(batch), QStringLiteral("101=7 101=1"));
        QCOMPARE(batch->values[0].data.size(), std::size_t(1));
        QCOMPARE(batch->values[1].data.size(), std::size_t(4));
        QCOMPARE(world.line.sent.size(), std::size_t(1));
    }

    void aDeviceThatAnswersOnlyPingIsReadEverMoreRarely()
    {
        World world;
        world.servos.servos[1].onlyPing = true;
        world.plan({span(1), {101, {1, 146, 1}, 0ms}, span(2, 100ms)});
        const QString seen = QStringLiteral("device 1 answers Ping but no Read: is its Status Return Level 0?");
        QCOMPARE(world.run(10s), seen);
        const int before = world.sentOf(Instruction::Ping);
        const quint64 timeouts = world.timeouts();
        QCOMPARE(world.bus.quality().device(1)->timeouts, timeouts);
        QVERIFY2(timeouts < 12, qPrintable(QString::number(timeouts)));
        QCOMPARE(world.run(30s), seen);
        QVERIFY(world.sentOf(Instruction::Ping) <= before + 22);
        QCOMPARE(world.timeouts(), timeouts); // it is there, and what it does is known
        world.servos.servos[1].onlyPing = false; // it returns by itself, with all that is read of it
        QCOMPARE(world.run(3500ms), QStringLiteral("answers"));
        QVERIFY(toText(world.poller.runCycle()).startsWith(QStringLiteral("101=1 101=0")));
    }

    void aDeviceToldToAnswerOnlyPingIsLookedAtRarely()
    {
        World world;
        world.servos.servos[1].onlyPing = true;
        Traits mute = traits(1);
        mute.statusReturnLevel = 0;
        world.poller.setPlan({AnyRate, {span(1), {101, {1, 146, 1}, 0ms}, span(2, 100ms)}, {mute, traits(2)}, {}});
        const QString seen =
            QStringLiteral("device 1 did not answer: its Status Return Level 0 lets it answer only Ping");
        QCOMPARE(world.run(30s), seen);
        QVERIFY(world.sentOf(Instruction::Ping) <= 22);
        QCOMPARE(world.timeouts(), quint64(0));
        world.servos.servos[1].deaf = true; // unplugged
        QCOMPARE(world.run(10s), QStringLiteral("device 1 does not answer"));
        world.servos.servos[1].deaf = false;
        QCOMPARE(world.run(3500ms), seen);
        world.servos.servos[1].onlyPing = false; // somebody set its level back
        QCOMPARE(world.run(3500ms), QStringLiteral("answers"));
        QVERIFY(toText(world.poller.runCycle()).startsWith(QStringLiteral("101=1 101=0")));
    }

    void fallsBackFromFastReads()
    {
        World world;
        for (const int id : {1, 2, 3})
            world.servos.servos[id].knowsFast = id == 1;
        world.plan({span(1), span(2), span(3)}, true);
        for (int i = 0; i < 6; ++i)
            QCOMPARE(toText(world.poller.runCycle()), QStringLiteral("101=1 102=2 103=3"));
        const int fast = world.sentOf(Instruction::FastSyncRead);
        for (int i = 0; i < 10; ++i)
            QCOMPARE(toText(world.poller.runCycle()), QStringLiteral("101=1 102=2 103=3"));
        QCOMPARE(world.sentOf(Instruction::FastSyncRead), fast); // learned
    }

    /// What was learned of a device holds for the firmware that it had.
    void triesFastReadsAgainWithOtherFirmware()
    {
        World world;
        const auto plan = [&](int firmware) {
            std::vector<Traits> devices{traits(1, true), traits(2, true), traits(3, true)};
            for (Traits &device : devices)
                device.firmware = firmware;
            world.poller.setPlan({AnyRate, {span(1), span(2), span(3)}, devices, {}});
        };
        const auto fastReads = [&] {
            const int before = world.sentOf(Instruction::FastSyncRead);
            for (int i = 0; i < 6; ++i) {
                if (toText(world.poller.runCycle()) != QStringLiteral("101=1 102=2 103=3"))
                    return -1;
            }
            return world.sentOf(Instruction::FastSyncRead) - before;
        };
        for (const int id : {1, 2, 3})
            world.servos.servos[id].knowsFast = false;
        plan(44);
        QVERIFY(fastReads() > 0); // until it is learned
        QCOMPARE(fastReads(), 0);
        for (const int id : {1, 2, 3})
            world.servos.servos[id].knowsFast = true;
        plan(44); // the same once more: still learned
        QCOMPARE(fastReads(), 0);
        plan(45);
        QCOMPARE(fastReads(), 6);
    }

    void tellsStop()
    {
        FakeLine line;
        FakeServos servos(line);
        servos.servos[1];
        std::atomic<bool> stop = false;
        Bus bus(line, &stop);
        Poller poller(bus);
        poller.setPlan({AnyRate, {span(1)}, {traits(1)}, {}});
        stop = true;
        QCOMPARE(poller.runCycle().error().kind, ErrorKind::Stopped);
        stop = false;
        QVERIFY(poller.runCycle());
    }
};

DYNASCOPE_CORE_TEST(TestPoller)
#include "tst_poller.moc"
