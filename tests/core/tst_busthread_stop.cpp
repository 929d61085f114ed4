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

/// Sets the stop flag when a while has passed since the n-th packet began.
class PressingLine final : public Line
{
public:
    PressingLine(Line &line, std::atomic<bool> &stop, int packet, LineTime after)
        : m_line(line), m_stop(stop), m_packet(packet), m_after(after)
    {
    }

    LineTime pressedAt() const { return m_pressAt.value_or(LineTime{}); }
    int packets() const { return m_packets; } ///< written so far

    QString name() const override { return m_line.name(); }
    LineTime now() const override { return m_line.now(); }
    Result<void> write(ByteView packet) override
    {
        if (++m_packets == m_packet)
            m_pressAt = now() + m_after;
        look();
        return m_line.write(packet);
    }
    Result<void> read(Bytes &buffer, LineTime deadline) override
    {
        const Result<void> read = m_line.read(buffer, deadline);
        look();
        return read;
    }
    void discardInput() override { m_line.discardInput(); }
    int baudRate() const override { return m_line.baudRate(); }
    Result<void> setBaudRate(int bitsPerSecond) override { return m_line.setBaudRate(bitsPerSecond); }
    LineTime hostAllowance() const override { return m_line.hostAllowance(); }

private:
    void look()
    {
        if (m_pressAt && now() >= *m_pressAt && !std::exchange(m_pressed, true))
            m_stop = true;
    }

    Line &m_line;
    std::atomic<bool> &m_stop;
    int m_packet;
    LineTime m_after;
    int m_packets = 0;
    std::optional<LineTime> m_pressAt;
    bool m_pressed = false;
};

/// What STOP comes into; the bus is at the working rate before it.
using Work = void (*)(Bus &);

void poll(Bus &bus)
{
    Poller poller(bus);
    PollPlan plan; // the second is missing
    for (const std::uint8_t id : {1, 2, 3})
        plan.spans.push_back({id, {id, 132, 4}, 0ms});
    poller.setPlan(plan);
    for (int cycle = 0; cycle < 10 && !bus.isStopped(); ++cycle)
        (void)poller.runCycle();
}

void scanTwoRates(Bus &bus)
{
    const int home = bus.line().baudRate();
    for (const int baudRate : {57600, 1'000'000}) {
        const AtBaud there(bus, baudRate);
        (void)scanBaud(bus, {0, 252}, {});
    }
    QCOMPARE(bus.line().baudRate(), home);
}

/// There and back again.
void changeItsBaud(Bus &bus)
{
    DirectContext context(bus);
    const int home = bus.line().baudRate();
    const int other = home == 57600 ? 1'000'000 : 57600;
    const auto code = [](int baudRate) { return static_cast<std::uint8_t>(baudRate == 57600 ? 1 : 3); };
    const DevicePlace place{1, home, 1020, 64, QStringLiteral("one")};
    DevicePlace moved = place;
    moved.baudRate = other;
    (void)changeBaud(context, {place, other, code(other), 8, true});
    (void)changeBaud(context, {moved, home, code(home), 8, true});
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

    void isOnTheWireInTime_data()
    {
        QTest::addColumn<Work>("work");
        QTest::addColumn<int>("packets"); ///< of which each is one to press at
        QTest::newRow("polling") << Work(&poll) << 20;
        QTest::newRow("scan") << Work(&scanTwoRates) << 9;
        QTest::newRow("change of baud rate") << Work(&changeItsBaud) << 8;
    }
    // Issue: on the wire within 5 ms and the rest of the packet in flight, whatever is waited for.
    void isOnTheWireInTime()
    {
        QFETCH(Work, work);
        QFETCH(int, packets);
        for (const int baudRate : {57600, 1'000'000}) {
            for (const LineTime allowance : {LineTime(0), LineTime(50ms)}) {
                for (int at = 1; at <= packets; ++at) {
                    for (const LineTime after : {LineTime(0), LineTime(2ms), LineTime(9ms)})
                        pressAt({at, after, baudRate, allowance}, work);
                    if (QTest::currentTestFailed())
                        return;
                }
            }
        }
    }

    /// The host has nothing of an answer while that is on the wire; it is let end all the same.
    void talksIntoNoAnswer_data()
    {
        QTest::addColumn<int>("length"); // of what is read when it is pressed
        QTest::newRow("short") << 4;
        QTest::newRow("long") << 128;
    }
    void talksIntoNoAnswer()
    {
        QFETCH(int, length);
        for (LineTime after{}; after < 2500us; after += 50us) {
            VirtualBus wire(m_catalog, QStringLiteral("XM430-W350@1000000:1"), 1'000'000);
            wire.simulated.servo(1, 1'000'000)->write(u"Torque Enable", 1);
            wire.simulated.setLogging(true);
            wire.line->setHostAllowance(50ms);
            PressingLine line(*wire.line, wire.stop, 2, after);
            Bus bus(line, &wire.stop);
            while (!wire.stop)
                (void)read(bus, {1, 0, static_cast<std::uint16_t>(length)});
            const int before = line.packets();
            QVERIFY(sendTorqueOff(bus, StopPlan({{11, 1, 1'000'000, 64}}), 1'000'000));
            std::vector<sim::WireEntry> log = wire.simulated.log();
            std::ranges::stable_sort(log, {}, &sim::WireEntry::begin);
            int sent = 0;
            for (std::size_t i = 0; i < log.size(); ++i) {
                if (!log[i].fromController || ++sent != before + 1)
                    continue;
                QVERIFY(log[i].begin - line.pressedAt() <= 4ms);
                QVERIFY2(i == 0 || log[i - 1].end <= log[i].begin, qPrintable(messages::durationText(after)));
            }
            QCOMPARE(sent, before + 2);
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
    struct Press {
        int packet = 1;
        LineTime after{};
        int baudRate = 57600;
        LineTime allowance{};
    };

    void pressAt(const Press &press, Work work)
    {
        const int other = press.baudRate == 57600 ? 1'000'000 : 57600;
        const auto servos = QStringLiteral("XM430-W350@%1:1,XM430-W350@%1:3,XM430-W350@%2:5");
        VirtualBus wire(m_catalog, servos.arg(press.baudRate).arg(other), press.baudRate);
        wire.simulated.servo(3, press.baudRate)->write(u"Torque Enable", 1);
        wire.simulated.setLogging(true);
        wire.line->setHostAllowance(press.allowance);
        PressingLine line(*wire.line, wire.stop, press.packet, press.after);
        Bus bus(line, &wire.stop);
        for (int round = 0; round < 20 && !wire.stop; ++round)
            work(bus);
        QVERIFY2(wire.stop, "it ended before");
        const int before = line.packets();
        const StopPlan plan({{11, 1, press.baudRate, 64}, {13, 3, press.baudRate, 64}});
        QVERIFY(sendTorqueOff(bus, plan, press.baudRate));
        // Where answers to a broadcast Ping fell on both packets, reading back finds it out and writes again.
        wire.stop = false;
        (void)verifyTorqueOff(bus, plan, press.baudRate);
        QCOMPARE(wire.simulated.servo(3, press.baudRate)->value(u"Torque Enable"), 0);

        std::vector<sim::WireEntry> log = wire.simulated.log(); // by their ends
        std::ranges::stable_sort(log, {}, &sim::WireEntry::begin);
        const LineTime pressed = line.pressedAt();
        LineTime inFlight{};
        int sent = 0;
        for (const sim::WireEntry &entry : log) {
            if (entry.fromController && ++sent > before) {
                QVERIFY2(entry.begin - pressed <= 5ms + inFlight,
                    qPrintable(QStringLiteral("%1 after the press, %2 after packet %3, at %4 bps")
                                   .arg(messages::durationText(entry.begin - pressed))
                                   .arg(messages::durationText(press.after))
                                   .arg(press.packet)
                                   .arg(press.baudRate)));
                return;
            }
            if (entry.begin <= pressed)
                inFlight = std::max(inFlight, entry.end - pressed);
        }
        QFAIL("nothing was sent");
    }

    const Catalog m_catalog = test::builtInCatalog();
};

DYNASCOPE_CORE_TEST(TestBusThreadStop)
#include "tst_busthread_stop.moc"
