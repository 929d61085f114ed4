// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/messages.h"
#include "core/bus/operations.h"
#include "core/bus/scan.h"
#include "core/bus/poller.h"
#include "core/bus/stopsequence.h"
#include "core/session/procedures/atbaud.h"
#include "tests/support/builtincatalog.h"
#include "tests/support/busworld.h"
#include "tests/support/sessionfixture.h"
#include "tests/support/testmain.h"

#include <QSemaphore>
#include <QSignalSpy>

using namespace dynascope;
using namespace std::chrono_literals;

Q_DECLARE_METATYPE(StopTarget)

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
    void initTestCase()
    {
        qRegisterMetaType<std::vector<StopOutcome>>();
    }

    void writesToEachModelsOwnRegister()
    {
        const StopPlan plan({{11, 1, 1'000'000, 64}, {12, 2, 1'000'000, 64}, {13, 3, 57600, 562}, {14, 1, 57600, 24}});
        QCOMPARE(plan.bauds(), (std::vector<int>{57600, 1'000'000}));
        // Only to those who stand there: ID 3 may at 1 Mbps be a model of which 562 is something else.
        QCOMPARE(toText(plan.packets(1'000'000)), QStringLiteral("64: 1 2"));
        QCOMPARE(toText(plan.packets(57600)), QStringLiteral("24: 1, 562: 3"));
        QVERIFY(plan.packets(9600).empty());
        QVERIFY(StopPlan().packets(57600).empty());
    }

    void confirmsTheDeviceItselfOnly_data()
    {
        QTest::addColumn<QString>("servos"); ///< on the wire, all under torque
        QTest::addColumn<StopTarget>("target");
        QTest::addColumn<int>("lost"); ///< so many of its first answers
        QTest::addColumn<QString>("outcome");
        QTest::addColumn<bool>("writtenTo"); ///< the first servo's torque is off in the end
        constexpr std::uint16_t XM430 = 1020;
        constexpr std::uint16_t XL330 = 1200;
        QTest::newRow("there") << QStringLiteral("XM430-W350@1000000:1") << StopTarget{7, 1, 1'000'000, 64, XM430} << 0
                               << QStringLiteral("off") << true;
        QTest::newRow("there, with a host that was busy") << QStringLiteral("XM430-W350@1000000:1")
                                                          << StopTarget{7, 1, 1'000'000, 64, XM430} << 3
                                                          << QStringLiteral("off") << true;
        QTest::newRow("parked") << QStringLiteral("XM430-W350@57600:1") << StopTarget{7, 1, 57600, 64, XM430} << 0
                                << QStringLiteral("off") << true;
        QTest::newRow("gone, its ID taken at the line's rate")
            << QStringLiteral("XM430-W350@1000000:1") << StopTarget{7, 1, 57600, 64, XL330} << 0
            << QStringLiteral("device 1 did not answer") << false;
        QTest::newRow("gone, a servo like it at the line's rate")
            << QStringLiteral("XM430-W350@1000000:1") << StopTarget{7, 1, 57600, 64, XM430} << 0
            << QStringLiteral("device 1 did not answer") << false;
        QTest::newRow("another one in its place") // at 146 it keeps a temperature
            << QStringLiteral("XM430-W350@57600:1") << StopTarget{7, 1, 57600, 146, XL330} << 0
            << QStringLiteral("device 1 answers as model number 1020, not 1200") << false;
    }
    void confirmsTheDeviceItselfOnly()
    {
        QFETCH(QString, servos);
        QFETCH(StopTarget, target);
        QFETCH(int, lost);
        VirtualBus wire(m_catalog, servos, 1'000'000);
        sim::Servo &servo = *wire.simulated.servos().front();
        servo.write(u"Torque Enable", 1);
        if (lost > 0)
            wire.simulated.setFaults({.replies = {{.kind = sim::ReplyFault::Kind::Lost, .times = lost}}});
        const StopPlan plan({target});
        QVERIFY(sendTorqueOff(*wire.bus, plan, 1'000'000));
        const std::vector<StopOutcome> outcomes = verifyTorqueOff(*wire.bus, plan, 1'000'000);
        QCOMPARE(outcomes.size(), std::size_t(1));
        QTEST(outcomes.front().off ? QStringLiteral("off") : outcomes.front().text.section(QLatin1Char(':'), 0, 0),
            "outcome");
        QTEST(servo.value(u"Torque Enable") == 0, "writtenTo");
        QCOMPARE(wire.line->baudRate(), 1'000'000);
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
        const QStringList sent = toText(*world.factory.log).mid(0, 6);
        QCOMPARE(sent,
            (QStringList{QStringLiteral("1000000 Sync Write 254"), QStringLiteral("1000000 Sync Write 254"),
                QStringLiteral("1000000 Sync Write 254"), QStringLiteral("1000000 Sync Write 254"),
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
                const auto found = scanBaud(context.bus(), {0, 252}, {});
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

private:

    const Catalog m_catalog = test::builtInCatalog();
};

DYNASCOPE_CORE_TEST(TestBusThreadStop)
#include "tst_busthread_stop.moc"
