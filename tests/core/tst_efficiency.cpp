// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/poller.h"
#include "core/sim/servo.h"
#include "core/sim/simulatedline.h"
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

/// Limit / achieved cycle; 0 where a value was missing.
double efficiency(const Catalog &catalog, Kind kind, int servos, int baudRate, LineTime dawdle = {})
{
    sim::SimulatedBus wire(catalog);
    PollPlan plan;
    for (int id = 1; id <= servos; ++id) {
        const auto specs = sim::parseServoSpecs(QStringLiteral("XM430-W350@%1:%2").arg(baudRate).arg(id), catalog);
        if (!specs || !wire.add(specs->front()))
            return 0;
        Traits traits;
        traits.id = static_cast<std::uint8_t>(id);
        traits.returnDelay = 0us;
        traits.fastReads = kind == Kind::Fast;
        traits.groupReads = kind != Kind::Single;
        plan.traits.push_back(traits);
        plan.spans.push_back({static_cast<quint32>(id), {traits.id, 126, Length}, 0ms});
    }
    sim::SimulatedLine simulated(wire, baudRate);
    DawdlingLine line(simulated, dawdle);
    Bus bus(line);
    for (const Traits &traits : plan.traits) {
        if (!bus.exchange(writeRequest({traits.id, 9, {0}}))->replies.front()) // Return Delay Time
            return 0;
    }
    Poller poller(bus);
    poller.setPlan(plan);
    Batch batch;
    LineTime took{};
    for (int cycle = 0; cycle < Cycles; ++cycle) {
        const LineTime begin = line.now();
        if (!poller.runCycle(batch))
            return 0;
        took += line.now() - begin;
        for (const PollValue &value : batch.values) {
            if (value.data.size() != Length)
                return 0;
        }
    }
    return static_cast<double>((Cycles * limitOf(kind, servos, line.byteTime())).count())
        / static_cast<double>(took.count());
}

} // namespace

Q_DECLARE_METATYPE(Kind)

/// A poll cycle takes what wire and servos take, and nothing more. In virtual time: only waits cost.
class TestEfficiency : public QObject
{
    Q_OBJECT

    std::unique_ptr<Catalog> m_catalog;

private slots:
    void initTestCase()
    {
        Result<Catalog> loaded = Catalog::builtIn();
        QVERIFY2(loaded, loaded ? "" : qPrintable(loaded.error().text));
        m_catalog = std::make_unique<Catalog>(std::move(*loaded));
    }

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
        const double part = efficiency(*m_catalog, servos == 1 ? Kind::Single : kind, servos, baudRate);
        qInfo("%.4f of what the wire allows", part);
        QVERIFY2(part >= 0.98 && part <= 1.02, qPrintable(QString::number(part)));
    }

    void aNeedlessWaitShows()
    {
        QVERIFY(efficiency(*m_catalog, Kind::Fast, 6, 1'000'000) >= 0.98);
        QVERIFY(efficiency(*m_catalog, Kind::Fast, 6, 1'000'000, 200us) < 0.9);
        QVERIFY(efficiency(*m_catalog, Kind::Single, 6, 57'600, 1ms) < 0.9);
    }
};

DYNASCOPE_CORE_TEST(TestEfficiency)
#include "tst_efficiency.moc"
