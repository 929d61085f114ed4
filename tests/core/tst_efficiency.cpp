// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/cyclelimit.h"
#include "core/bus/operations.h"
#include "core/bus/poller.h"
#include "core/bus/scan.h"
#include "core/sim/servo.h"
#include "core/sim/simulatedline.h"
#include "tests/support/builtincatalog.h"
#include "tests/support/sanitized.h"
#include "tests/support/testmain.h"

using namespace dynascope;
using namespace std::chrono_literals;

namespace {

enum class Kind { Single, Sync, Fast };

constexpr int Length = 10; ///< Present Current, Velocity and Position: 126..135
constexpr LineTime Processing = 100us;
constexpr int Cycles = 10;

/// Dawdles before each request: what a needless wait in the bus would cost.
class DawdlingLine final : public Line
{
public:
    DawdlingLine(sim::SimulatedLine &line, LineTime wait) : m_line(line), m_wait(wait) { }

    QString name() const override { return m_line.name(); }
    LineTime now() const override { return m_line.now(); }
    Result<void> write(ByteView packet) override
    {
        m_line.advance(m_wait);
        return m_line.write(packet);
    }
    Result<void> read(Bytes &buffer, LineTime deadline) override { return m_line.read(buffer, deadline); }
    void discardInput() override { m_line.discardInput(); }
    int baudRate() const override { return m_line.baudRate(); }
    Result<void> setBaudRate(int bitsPerSecond) override { return m_line.setBaudRate(bitsPerSecond); }
    LineTime hostAllowance() const override { return m_line.hostAllowance(); }

private:
    sim::SimulatedLine &m_line;
    LineTime m_wait;
};

/// What the wire allows, reference "Time", with the time a simulated servo takes to think.
LineTime limitOf(Kind kind, int servos, LineTime byteTime)
{
    const auto n = static_cast<LineTime::rep>(servos);
    switch (kind) {
    case Kind::Single: return n * ((25 + Length) * byteTime + Processing);
    case Kind::Sync: return (14 + n) * byteTime + n * ((11 + Length) * byteTime + Processing);
    case Kind::Fast: return (14 + n) * byteTime + (8 + n * (Length + 4)) * byteTime + Processing;
    }
    return {};
}

/// Servos at one rate without Return Delay Time, and a plan that reads ten bytes of each in every cycle.
struct World {
    World(const Catalog &catalog, Kind kind, int servos, int baudRate, LineTime dawdle = {})
        : wire(catalog), simulated(wire, baudRate), line(simulated, dawdle), bus(line), poller(bus)
    {
        for (int id = 1; id <= servos; ++id) {
            const auto specs = sim::parseServoSpecs(QStringLiteral("XM430-W350@%1:%2").arg(baudRate).arg(id), catalog);
            if (!specs || !wire.add(specs->front()))
                qFatal("no servo");
            Traits traits;
            traits.id = static_cast<std::uint8_t>(id);
            traits.returnDelay = 0us;
            traits.returnDelayKnown = true;
            traits.fastReads = kind == Kind::Fast;
            traits.groupReads = kind != Kind::Single;
            plan.traits.push_back(traits);
            plan.spans.push_back({static_cast<quint32>(id), {traits.id, 126, Length}, 0ms});
            if (!bus.exchange(writeRequest({traits.id, 9, {0}}))->replies.front()) // Return Delay Time
                qFatal("no servo answers");
        }
        poller.setPlan(plan);
    }
    /// How long a cycle takes; how many values were missing is left in `missing`.
    LineTime cycle()
    {
        const LineTime begin = line.now();
        if (!poller.runCycle(batch))
            qFatal("the line failed");
        missing =
            std::ranges::count_if(batch.values, [](const PollValue &value) { return value.data.size() != Length; });
        return line.now() - begin;
    }

    sim::SimulatedBus wire;
    sim::SimulatedLine simulated;
    DawdlingLine line;
    Bus bus;
    Poller poller;
    PollPlan plan;
    Batch batch;
    std::ptrdiff_t missing = 0;
};

/// Limit / achieved cycle; 0 where a value was missing.
double efficiency(const Catalog &catalog, Kind kind, int servos, int baudRate, LineTime dawdle = {})
{
    World world(catalog, kind, servos, baudRate, dawdle);
    LineTime took{};
    for (int cycle = 0; cycle < Cycles; ++cycle) {
        took += world.cycle();
        if (world.missing > 0)
            return 0;
    }
    return static_cast<double>((Cycles * limitOf(kind, servos, world.line.byteTime())).count())
        / static_cast<double>(took.count());
}

/// Lets a servo hear and speak at another rate, as good as unplugged.
void takeAway(World &world, std::uint8_t id)
{
    QVERIFY(world.bus.exchange(writeRequest({id, 8, {1}}), 0)); // Baud Rate 57 600
}

} // namespace

Q_DECLARE_METATYPE(Kind)

/// A poll cycle takes what wire and servos take, and nothing more. In virtual time: only waits cost.
class TestEfficiency : public QObject
{
    Q_OBJECT

    const Catalog m_catalog = test::builtInCatalog();

private slots:
    void cycle_data()
    {
        QTest::addColumn<Kind>("kind");
        QTest::addColumn<int>("baudRate");
        QTest::addColumn<int>("servos");
        const std::vector<std::pair<Kind, const char *>> kinds{
            {Kind::Single, "single"}, {Kind::Sync, "sync"}, {Kind::Fast, "fast"}};
        for (const auto &[kind, name] : kinds) {
            for (const int baudRate : {57'600, 1'000'000, 4'000'000}) {
                for (const int servos : {1, 6, 20, 60})
                    QTest::addRow("%s, %d baud, %d servos", name, baudRate, servos) << kind << baudRate << servos;
            }
        }
    }

    void cycle()
    {
        QFETCH(Kind, kind);
        QFETCH(int, baudRate);
        QFETCH(int, servos);
        // One servo alone gets a Read, whatever it could do: there is nothing to group.
        const double part = efficiency(m_catalog, servos == 1 ? Kind::Single : kind, servos, baudRate);
        qInfo("%.4f of what the wire allows", part);
        QVERIFY2(part >= 0.98 && part <= 1.02, qPrintable(QString::number(part)));
    }

    /// What the status bar calls possible is what the formulas say.
    void thePossibleRate_data() { cycle_data(); }
    void thePossibleRate()
    {
        QFETCH(Kind, kind);
        QFETCH(int, baudRate);
        QFETCH(int, servos);
        World world(m_catalog, kind, servos, baudRate);
        const LineTime limit = limitOf(servos == 1 ? Kind::Single : kind, servos, world.line.byteTime());
        const double wanted = 1 / std::chrono::duration<double>(limit).count();
        const double rate = possibleCycleRate(world.plan, baudRate);
        QVERIFY2(std::abs(rate / wanted - 1) < 0.01, qPrintable(QStringLiteral("%1, not %2").arg(rate).arg(wanted)));

        PollPlan plan = world.plan; // and as much ten times a second, and with slower devices
        for (const PollSpan &span : world.plan.spans)
            plan.spans.push_back({span.device, {span.span.id, 146, 1}, 100ms});
        QVERIFY(possibleCycleRate(plan, baudRate) < rate);
        plan = world.plan;
        plan.traits.front().returnDelay = 500us;
        const double slower = 1 / (1 / rate + 500e-6);
        QVERIFY(std::abs(possibleCycleRate(plan, baudRate) / slower - 1) < 0.01);
        plan.traits.back().returnDelayKnown = false;
        QCOMPARE(possibleCycleRate(plan, baudRate), 0.0);
        plan = world.plan;
        plan.spans.clear();
        QCOMPARE(possibleCycleRate(plan, baudRate), 0.0);
    }

    void aNeedlessWaitShows()
    {
        QVERIFY(efficiency(m_catalog, Kind::Fast, 6, 1'000'000) >= 0.98);
        QVERIFY(efficiency(m_catalog, Kind::Fast, 6, 1'000'000, 200us) < 0.9);
        QVERIFY(efficiency(m_catalog, Kind::Single, 6, 57'600, 1ms) < 0.9);
    }

    void aMissingServoCostsLittle_data()
    {
        QTest::addColumn<Kind>("kind");
        QTest::addColumn<int>("missing");
        for (const int missing : {1, 6, 12}) {
            if (test::Sanitized && missing != 6)
                continue; // 13 s on the line each; the others run without sanitizers
            QTest::addRow("fast, %d of 12", missing) << Kind::Fast << missing;
            QTest::addRow("sync, %d of 12", missing) << Kind::Sync << missing;
            QTest::addRow("single, %d of 12", missing) << Kind::Single << missing;
        }
    }

    /// On a line that may be as slow as an FTDI adapter as it comes, and isn't.
    void aMissingServoCostsLittle()
    {
        QFETCH(Kind, kind);
        QFETCH(int, missing);
        World world(m_catalog, kind, 12, 1'000'000);
        world.simulated.setHostAllowance(21ms);
        LineTime whole{};
        for (int i = 0; i < 50; ++i)
            whole = world.cycle();
        takeAway(world, static_cast<std::uint8_t>(missing));
        LineTime worst{};
        int cycles = 0;
        for (; cycles < 3; ++cycles) {
            worst = std::max(worst, world.cycle() - whole);
            QCOMPARE(world.missing, 1);
        }
        qInfo("%.2f ms more, of %.2f ms", static_cast<double>(worst / 1us) / 1000,
              static_cast<double>(whole / 1us) / 1000);
        QVERIFY(worst <= 5ms);
        const LineTime begin = world.line.now() + 7s; // the probes have become rare
        while (world.line.now() < begin)
            (void)world.cycle();
        LineTime later{};
        for (cycles = 0; world.line.now() < begin + 6s; ++cycles)
            later += world.cycle();
        QVERIFY(later / cycles < whole + whole / 100);
    }

    void aScanTakesItsSlots_data()
    {
        QTest::addColumn<int>("baudRate");
        QTest::addColumn<int>("servos");
        for (const int baudRate : {57'600, 1'000'000, 4'000'000}) {
            for (const int servos : {0, 1, 10, 40})
                QTest::addRow("%d baud, %d servos", baudRate, servos) << baudRate << servos;
        }
    }

    void aScanTakesItsSlots()
    {
        QFETCH(int, baudRate);
        QFETCH(int, servos);
        World world(m_catalog, Kind::Sync, servos, baudRate);
        const LineTime byteTime = world.line.byteTime();
        const LineTime begin = world.line.now();
        const auto found = scanBaud(world.bus, {0, MaximumId}, {});
        QVERIFY(found);
        QCOMPARE(found->devices.size(), std::size_t(servos));
        const auto n = static_cast<LineTime::rep>(servos);
        const LineTime limit = 10 * byteTime + (253 - n) * 3ms + n * (14 * byteTime + Processing)
                               + n * (24 * byteTime + Processing); // the confirmation: a Ping and its answer
        const double part =
            static_cast<double>((world.line.now() - begin).count()) / static_cast<double>(limit.count());
        qInfo("%.4f of what the slots ask for", part);
        QVERIFY2(part <= 1.02, qPrintable(QString::number(part)));
    }

    void comparingTakesTwoReadsOfEach_data() { aScanTakesItsSlots_data(); }

    /// What comes behind the scan, to tell two alike devices under one ID.
    void comparingTakesTwoReadsOfEach()
    {
        QFETCH(int, baudRate);
        QFETCH(int, servos);
        World world(m_catalog, Kind::Sync, servos, baudRate);
        const auto scanned = [&](const ScanHooks &hooks) {
            const LineTime begin = world.line.now();
            return scanBaud(world.bus, {0, MaximumId}, hooks) ? world.line.now() - begin : LineTime();
        };
        const LineTime without = scanned({});
        ScanHooks comparing;
        comparing.volatileOf = [](const Found &) { return VolatileSpan{120, 27, 0, {}}; };
        const LineTime with = scanned(comparing);
        const LineTime limit
            = servos * 2 * ((14 + 11 + 27) * world.line.byteTime() + Processing); // the data may have to be stuffed
        const LineTime more = with - without;
        QVERIFY2(more <= limit + limit / 50 + 1us, qPrintable(QString::number(more.count())));
        QVERIFY(more >= limit - limit / 50);
    }
};

DYNASCOPE_CORE_TEST(TestEfficiency)
#include "tst_efficiency.moc"
