// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/poller.h"
#include "core/bus/pollprediction.h"
#include "core/sim/servo.h"
#include "core/sim/simulatedline.h"
#include "tests/support/builtincatalog.h"
#include "tests/support/testmain.h"

#include <map>

using namespace dynascope;
using namespace std::chrono_literals;

namespace {

struct Model {
    const char *name;
    int first;  ///< address of Present Position
    int slow;   ///< Present Temperature
    bool fast;
    int many = 0; ///< what is farther away
};
constexpr Model X430{"XM430-W350", 132, 146, true, 64};
constexpr Model X330{"XL330-M288", 132, 146, true, 64};
constexpr Model Mx{"MX-28(2.0)", 132, 146, false, 64};
constexpr Model Pro{"PH54-200-S500-R", 580, 594, true, 512};

enum class Read { Position, SixFields, Scattered };

struct Setup {
    std::vector<Model> models = {X430};
    int count = 1; ///< servos, the models in turn
    int baudRate = 1'000'000;
    int returnDelay = 0; ///< the register's
    LineTime latency{};
    Read read = Read::Position;
    bool fast = true;
    bool slow = false; ///< temperature at 1 Hz, too, and the state at 10 Hz
    int silent = 0;    ///< ID
};

/// Servos on a line in virtual time, and a plan that reads them.
class World
{
public:
    World(const Catalog &catalog, const Setup &setup)
        : m_setup(setup), m_wire(catalog), m_line(m_wire, setup.baudRate), m_bus(m_line), m_poller(m_bus)
    {
        for (int id = 1; id <= setup.count; ++id)
            add(id, setup.models[static_cast<std::size_t>(id - 1) % setup.models.size()]);
        sim::LineFaults faults;
        faults.latencyTimer = setup.latency;
        if (setup.silent > 0)
            faults.silent = {setup.silent};
        m_wire.setFaults(faults);
        m_line.setHostAllowance(setup.latency + 5ms);
        plan.baudRate = setup.baudRate;
        m_poller.setPlan(plan);
    }

    PollPrediction predicted() const
    {
        LineDelays delays;
        delays.latencyTimer = m_setup.latency;
        std::vector<std::uint8_t> silent;
        if (m_setup.silent > 0)
            silent.push_back(static_cast<std::uint8_t>(m_setup.silent));
        return predictPoll(plan, m_setup.baudRate, delays, silent);
    }

    struct Achieved {
        double rate = 0, load = 0;
        LineTime shortest = LineTime::max(), longest{};
        std::map<std::pair<quint32, int>, int> values; ///< by device and address
        LineTime took{};
    };
    /// Cycles as they come due.
    Achieved run(LineTime duration)
    {
        Achieved result;
        Batch batch;
        int cycles = 0;
        const LineTime begin = m_line.now(), busy = m_bus.statistics().busy;
        while (m_line.now() < begin + duration) {
            m_line.advance(std::max(LineTime(), m_poller.nextDue() - m_line.now()));
            if (!m_poller.runCycle(batch))
                qFatal("the line failed");
            cycles += batch.fullRate ? 1 : 0;
            result.shortest = std::min(result.shortest, batch.end - batch.begin);
            result.longest = std::max(result.longest, batch.end - batch.begin);
            for (const PollValue &value : batch.values)
                result.values[{value.device, value.address}] += value.data.size() == value.length ? 1 : 0;
        }
        result.took = m_line.now() - begin;
        const double seconds = std::chrono::duration<double>(result.took).count();
        result.rate = cycles / seconds;
        result.load = std::chrono::duration<double>(m_bus.statistics().busy - busy).count() / seconds;
        return result;
    }

    /// The dearest exchange that a slow turn alone would take.
    LineTime dearestTurn() const
    {
        ReadCosts costs{m_line.byteTime(), {}, true, {}};
        costs.delays.latencyTimer = m_setup.latency;
        LineTime dearest{};
        for (const PollTurn &turn : turnsOf(plan, costs)) {
            if (turn.interval.count() == 0)
                continue;
            const auto exchanges = planCycle(plan, turn.spans, plan.traits, costs);
            if (exchanges.size() != 1)
                qFatal("a turn is one exchange");
            dearest = std::max(dearest, costOf(exchanges, plan.traits, costs).total());
        }
        return dearest;
    }

    PollPlan plan;

private:
    void add(int id, const Model &model)
    {
        const auto servo = m_wire.add({QString::fromLatin1(model.name), -1, m_setup.baudRate, id});
        if (!servo)
            qFatal("%s", qPrintable(servo.error().text));
        (*servo)->write(u"Return Delay Time", m_setup.returnDelay);
        Traits traits;
        traits.id = static_cast<std::uint8_t>(id);
        traits.returnDelay = std::chrono::microseconds(2 * m_setup.returnDelay);
        traits.returnDelayKnown = true;
        traits.fastReads = model.fast && m_setup.fast;
        plan.traits.push_back(traits);
        const auto read = [&](int address, int length, std::chrono::milliseconds interval) {
            plan.spans.push_back({static_cast<quint32>(id),
                                  {traits.id, static_cast<std::uint16_t>(address), static_cast<std::uint16_t>(length)},
                                  interval});
        };
        read(model.first, 4, 0ms);
        if (m_setup.read != Read::Position) { // current, velocity, voltage and so on
            read(model.first - 6, 2, 0ms);
            read(model.first - 4, 4, 0ms);
            read(model.first + 12, 2, 0ms);
            read(model.first + 14, 1, 0ms);
            read(model.first - 10, 1, 0ms);
        }
        if (m_setup.read == Read::Scattered)
            read(model.many, 1, 0ms);
        if (m_setup.slow) {
            read(model.slow + 1, 1, 1000ms); // beside what is read in every cycle
            read(model.many, 7, 100ms);
        }
    }

    Setup m_setup;
    sim::SimulatedBus m_wire;
    sim::SimulatedLine m_line;
    Bus m_bus;
    Poller m_poller;
};

} // namespace

Q_DECLARE_METATYPE(Setup)

/// What is predicted comes true, in virtual time.
class TestPollPrediction : public QObject
{
    Q_OBJECT

    const Catalog m_catalog = test::builtInCatalog();

private slots:
    void comesTrue_data()
    {
        QTest::addColumn<Setup>("setup");
        const auto row = [](const char *name, const Setup &setup) { QTest::newRow(name) << setup; };
        const std::vector<Model> mixed{X430, Mx, X330, Pro};
        row("one servo", {});
        row("one servo, 57600", {.baudRate = 57'600});
        row("one servo, 4 Mbps", {.baudRate = 4'000'000});
        row("one servo as it comes", {.baudRate = 57'600, .returnDelay = 250, .latency = 16ms});
        row("one servo, scattered", {.read = Read::Scattered});
        row("one servo and slow ones", {.slow = true});
        row("20 x 6 fast", {.count = 20, .baudRate = 4'000'000, .read = Read::SixFields});
        row("20 x 6 fast, return delay",
            {.count = 20, .baudRate = 4'000'000, .returnDelay = 250, .read = Read::SixFields});
        row("20 x 6 sync", {.count = 20, .baudRate = 4'000'000, .read = Read::SixFields, .fast = false});
        row("20 x 6 sync, 1 Mbps, 1 ms", {.count = 20, .latency = 1ms, .read = Read::SixFields, .fast = false});
        row("20 x 6 sync, return delay", {.count = 20, .returnDelay = 250, .read = Read::SixFields, .fast = false});
        row("20 x 6 fast, 16 ms", {.count = 20, .latency = 16ms, .read = Read::SixFields});
        row("20 x 6 and slow ones", {.count = 20, .baudRate = 4'000'000, .read = Read::SixFields, .slow = true});
        row("20 x 6 and slow ones, 16 ms", {.count = 20, .latency = 16ms, .read = Read::SixFields, .slow = true});
        row("20 and slow ones, 57600", {.count = 20, .baudRate = 57'600, .slow = true});
        row("mixed", {.models = mixed, .count = 12});
        row("mixed, scattered", {.models = mixed, .count = 12, .read = Read::Scattered});
        row("mixed, scattered, 16 ms", {.models = mixed, .count = 12, .latency = 16ms, .read = Read::Scattered});
        row("mixed, slow ones, return delay", {.models = mixed, .count = 12, .returnDelay = 250, .slow = true});
        row("mixed, 1 ms, return delay",
            {.models = mixed, .count = 12, .returnDelay = 250, .latency = 1ms, .read = Read::SixFields});
        row("a silent one", {.count = 12, .read = Read::SixFields, .silent = 5});
        row("a silent one, sync", {.count = 12, .read = Read::SixFields, .fast = false, .silent = 1});
        row("a silent one, 16 ms", {.count = 6, .latency = 16ms, .read = Read::SixFields, .silent = 6});
    }

    void comesTrue()
    {
        QFETCH(Setup, setup);
        World world(m_catalog, setup);
        (void)world.run(setup.silent > 0 ? 10s : 1s); // who is silent is known
        const PollPrediction predicted = world.predicted();
        const World::Achieved achieved = world.run(setup.silent > 0 ? 6s : 2s);
        const double rate = achieved.rate / predicted.cycleRate;
        const double load = achieved.load / predicted.busLoad;
        qInfo("achieved %.1f Hz, predicted %.1f Hz: %.3f; load %.3f, predicted %.3f; cycles %.2f to %.2f ms",
              achieved.rate, predicted.cycleRate, rate, achieved.load, predicted.busLoad,
              static_cast<double>(achieved.shortest.count()) * 1e-6,
              static_cast<double>(achieved.longest.count()) * 1e-6);
        QVERIFY2(rate >= 0.95 && rate <= 1.05, qPrintable(QString::number(rate)));
        QVERIFY2(load >= 0.95 && load <= 1.05, qPrintable(QString::number(load)));
        QVERIFY(std::abs(predicted.shares.sum() - 1) < 0.001);
        for (const auto &[where, count] : achieved.values)
            QVERIFY(count > 0 || static_cast<int>(where.first) == setup.silent);
    }

    void slowWatchesMakeNoCycleMuchLonger_data()
    {
        QTest::addColumn<Setup>("setup");
        const auto row = [](const char *name, const Setup &setup) { QTest::newRow(name) << setup; };
        const std::vector<Model> mixed{X430, Mx, X330, Pro};
        row("one servo", {.slow = true});
        row("20, fast", {.count = 20, .baudRate = 4'000'000, .read = Read::SixFields, .slow = true});
        row("20, sync", {.count = 20, .read = Read::SixFields, .fast = false, .slow = true});
        row("20, 16 ms", {.count = 20, .latency = 16ms, .read = Read::SixFields, .slow = true});
        row("mixed", {.models = mixed, .count = 12, .returnDelay = 250, .slow = true});
    }

    /// And come as often as they are wanted.
    void slowWatchesMakeNoCycleMuchLonger()
    {
        QFETCH(Setup, setup);
        World world(m_catalog, setup);
        (void)world.run(1500ms);
        const World::Achieved second = world.run(1s);
        const LineTime most = second.shortest + world.dearestTurn();
        qInfo("cycles of %.3f to %.3f ms, at most %.3f", static_cast<double>(second.shortest.count()) * 1e-6,
              static_cast<double>(second.longest.count()) * 1e-6, static_cast<double>(most.count()) * 1e-6);
        QVERIFY(second.longest <= most + most / 50); // what is stuffed is not foreseen
        const World::Achieved more = world.run(5s);
        for (const PollSpan &span : world.plan.spans) {
            if (span.interval.count() == 0)
                continue;
            constexpr double Fastest = 10; // Hz; of that less may come where the line is too slow, as is predicted
            const double often =
                std::min(1000.0 / static_cast<double>(span.interval.count()), Fastest * world.predicted().met);
            const int wanted = qRound(5 * often);
            const auto at = more.values.find({span.device, span.span.address});
            const int came = at == more.values.end() ? 0 : at->second;
            QVERIFY2(std::abs(came - wanted) <= 1 + wanted / 20,
                     qPrintable(QStringLiteral("%1, not %2").arg(came).arg(wanted)));
        }
    }

    /// The state of all devices is not read at one go.
    void turnsAreSpread()
    {
        World world(m_catalog, {.count = 20, .read = Read::SixFields, .slow = true});
        ReadCosts costs{10us, {}, true, {}};
        std::map<std::chrono::milliseconds, int> turns;
        for (const PollTurn &turn : turnsOf(world.plan, costs))
            ++turns[turn.interval];
        QCOMPARE(turns[0ms], 1);
        QVERIFY(turns[100ms] > 1);
        PollPlan slow = world.plan; // nothing in every cycle: nothing to be kept even
        std::erase_if(slow.spans, [](const PollSpan &span) { return span.interval.count() == 0; });
        QCOMPARE(turnsOf(slow, costs).size(), std::size_t(2));
    }
};

DYNASCOPE_CORE_TEST(TestPollPrediction)
#include "tst_pollprediction.moc"
