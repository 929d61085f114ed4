// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/operations.h"
#include "core/bus/poller.h"
#include "core/bus/stopsequence.h"
#include "tests/support/busworld.h"
#include "tests/support/testmain.h"

#include <QSemaphore>
#include <QSignalSpy>

using namespace dynascope;
using namespace std::chrono_literals;

namespace {

/// "1000000 Sync Write 254" of each packet that went out.
QStringList toText(const std::vector<FakeLine::Sent> &log)
{
    QStringList lines;
    for (const FakeLine::Sent &sent : log)
        lines << QStringLiteral("%1 %2 %3")
                     .arg(sent.baudRate)
                     .arg(instructionName(static_cast<Instruction>(sent.bytes[7])))
                     .arg(sent.bytes[4]);
    return lines;
}

/// "64: 1 2, 24: 4", a packet each.
QString toText(const std::vector<Bytes> &packets)
{
    QStringList parts;
    for (const Bytes &packet : packets) {
        const InstructionPacket instruction{
            packet[4], static_cast<Instruction>(packet[7]), Bytes(packet.begin() + 8, packet.end() - 2)};
        const auto writes = std::get<GroupWriteCommand>(*decodeCommand(instruction)).writes;
        QStringList ids;
        for (const SpanData &write : writes)
            ids << (write.data == Bytes{0} ? QString::number(write.id) : QStringLiteral("not off!"));
        parts << QStringLiteral("%1: %2").arg(writes.front().address).arg(ids.join(QLatin1Char(' ')));
    }
    return parts.join(QStringLiteral(", "));
}

} // namespace

class TestBusThreadStop : public QObject
{
    Q_OBJECT

    using World = BusWorld;

private slots:
    void initTestCase() { qRegisterMetaType<std::vector<StopOutcome>>(); }

    void writesToEachModelsOwnRegister()
    {
        const StopPlan plan({{11, 1, 1'000'000, 64}, {12, 2, 1'000'000, 64}, {13, 3, 57600, 562}, {14, 1, 57600, 24}});
        QCOMPARE(plan.bauds(), (std::vector<int>{57600, 1'000'000}));
        // Others too, as they may be in the middle of a change; but ID 1 here is the one that stands here.
        QCOMPARE(toText(plan.packets(1'000'000)), QStringLiteral("64: 1 2, 562: 3"));
        QCOMPARE(toText(plan.packets(57600)), QStringLiteral("24: 1, 64: 2, 562: 3"));
        QCOMPARE(toText(plan.packets(9600)), QStringLiteral("24: 1, 64: 1 2, 562: 3"));
        QVERIFY(StopPlan().packets(57600).empty());
    }

    // Issue: on the wire within 5 ms and the rest of the packet in flight, whatever is waited for.
    void isOnTheWireInTime()
    {
        for (const int baudRate : {57600, 1'000'000}) {
            for (int at = 1; at < 40; ++at) {
                FakeLine line(baudRate);
                line.allowance = 50ms;
                FakeServos servos(line);
                servos.servos[1].baudRate = servos.servos[3].baudRate = baudRate;
                std::atomic<bool> stop = false;
                LineTime pressed{}, inFlight{};
                line.handler = [&, inner = line.handler](const Bytes &request) {
                    if (static_cast<int>(line.sent.size()) == at) {
                        stop = true;
                        pressed = line.now();
                        inFlight = static_cast<LineTime::rep>(request.size()) * line.byteTime();
                    }
                    return inner(request);
                };
                Bus bus(line, &stop);
                Poller poller(bus);
                PollPlan plan; // the second is missing
                for (const std::uint8_t id : {1, 2, 3})
                    plan.spans.push_back({id, {id, 132, 4}, 0ms});
                poller.setPlan(plan);
                while (!stop)
                    (void)poller.runCycle();
                const std::size_t before = line.sent.size();
                QVERIFY(sendTorqueOff(bus, StopPlan({{11, 1, baudRate, 64}}), baudRate));
                QVERIFY(line.sent[before].at - pressed <= 5ms + inFlight);
            }
        }
    }

    void stopTurnsTorqueOffEverywhere()
    {
        World world([](FakeLine &, FakeServos &servos) {
            for (auto &[id, servo] : servos.servos)
                servo.registers[64] = 1;
            servos.servos[3].baudRate = 57600;
            servos.servos[4] = servos.servos[1]; // an older model
            servos.servos[4].registers[24] = 1;
            servos.servos[5] = servos.servos[1];
            servos.servos[5].silent = true;
        });
        world.thread.setStopTargets({{11, 1, 1'000'000, 64}, {12, 2, 1'000'000, 64}, {13, 3, 57600, 64},
            {14, 4, 1'000'000, 24}, {15, 5, 1'000'000, 64}});
        QSignalSpy finished(&world.thread, &BusThread::stopFinished);
        QSemaphore started, go;
        world.run(Priority::Normal, [&](JobContext &context) -> Result<int> {
            started.release();
            go.acquire();
            const Result<PingReply> reply = ping(context.bus(), 1);
            const Result<void> on = context.checkpoint();
            return reply || on ? Result<int>(1) : tl::unexpected(reply.error());
        });
        started.acquire();
        world.run(Priority::Click, [](JobContext &context) -> Result<int> {
            (void)write(context.bus(), {1, 64, {1}});
            return 2;
        });
        world.thread.stop();
        QVERIFY(world.thread.isStopped());
        go.release();
        QTRY_COMPARE(finished.size(), 1);
        QCOMPARE(world.outcomes, (QStringList{QStringLiteral("cancelled"), QStringLiteral("ended by STOP")}));
        const auto outcomes = finished.front().front().value<std::vector<StopOutcome>>();
        QStringList said;
        for (const StopOutcome &outcome : outcomes)
            said << QStringLiteral("%1 %2")
                        .arg(outcome.device)
                        .arg(outcome.off ? QStringLiteral("off") : outcome.text.section(QLatin1Char(':'), 0, 0));
        QCOMPARE(said,
            (QStringList{QStringLiteral("11 off"), QStringLiteral("12 off"), QStringLiteral("14 off"),
                QStringLiteral("15 device 5 did not answer"), QStringLiteral("13 off")}));
        // The bus works on; what is refused from now on is the session's to say.
        world.run(Priority::Click, [](JobContext &context) -> Result<int> { return ping(context.bus(), 1) ? 3 : -3; });
        QTRY_COMPARE(world.outcomes.last(), QStringLiteral("3"));
        world.thread.release();
        QVERIFY(!world.thread.isStopped());
        world.thread.close();
        const QStringList sent = toText(*world.factory.log).mid(0, 8);
        QCOMPARE(sent,
            (QStringList{QStringLiteral("1000000 Sync Write 254"), QStringLiteral("1000000 Sync Write 254"),
                QStringLiteral("1000000 Sync Write 254"), QStringLiteral("1000000 Sync Write 254"),
                QStringLiteral("57600 Sync Write 254"), QStringLiteral("57600 Sync Write 254"),
                QStringLiteral("57600 Sync Write 254"), QStringLiteral("57600 Sync Write 254")}));
        for (const FakeLine::Sent &entry : *world.factory.log)
            QVERIFY(!(entry.bytes[7] == 3 && entry.bytes[4] == 254)); // never a broadcast Write
    }

    void stopInterruptsAScan()
    {
        std::atomic<bool> scanning = false;
        World world([&](FakeLine &line, FakeServos &servos) {
            servos.servos[1].registers[64] = 1;
            line.handler = [&, inner = line.handler](const Bytes &request) {
                if (request[7] == 1 && request[4] == 254)
                    scanning = true;
                return inner(request);
            };
        });
        world.thread.setStopTargets({{11, 1, 1'000'000, 64}});
        QSignalSpy finished(&world.thread, &BusThread::stopFinished);
        world.run(Priority::Scan, [&](JobContext &context) -> Result<int> {
            for (;;) { // virtual time: a scan is over in no time
                const auto found = scanBaud(context.bus(), 0, 252, {});
                if (!found)
                    return tl::unexpected(found.error());
                if (const Result<void> on = context.checkpoint(); !on)
                    return tl::unexpected(on.error());
            }
        });
        QTRY_VERIFY(scanning);
        world.thread.stop();
        QTRY_COMPARE(finished.size(), 1);
        QVERIFY(finished.front().front().value<std::vector<StopOutcome>>().front().off);
        QTRY_COMPARE(world.outcomes, QStringList(QStringLiteral("ended by STOP")));
    }

    void stopOnADeadLineStillAnswers()
    {
        FakeFactory factory;
        BusThread thread(factory, QStringLiteral("nowhere"), 57600);
        thread.setStopTargets({{11, 1, 57600, 64}});
        QSignalSpy finished(&thread, &BusThread::stopFinished);
        thread.stop();
        QTRY_COMPARE(finished.size(), 1);
        QTRY_COMPARE(thread.state(), BusThread::State::Closed);
        thread.stop();
        QTRY_COMPARE(finished.size(), 2);
        const auto outcomes = finished.back().front().value<std::vector<StopOutcome>>();
        QVERIFY(!outcomes.front().off);
        QCOMPARE(outcomes.front().text, QStringLiteral("there is no port nowhere"));
    }
};

DYNASCOPE_CORE_TEST(TestBusThreadStop)
#include "tst_busthread_stop.moc"
