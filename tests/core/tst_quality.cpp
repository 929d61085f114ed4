// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/asking.h"
#include "core/bus/operations.h"
#include "core/bus/quality.h"
#include "core/bus/stopsequence.h"
#include "core/session/answerfaults.h"
#include "core/session/linehealth.h"
#include "tests/support/busworld.h"
#include "tests/support/sessionfixture.h"
#include "tests/support/testmain.h"

#include <QSignalSpy>

#include <random>

using namespace dynascope;
using namespace std::chrono_literals;
using Kind = sim::ReplyFault::Kind;

namespace {

constexpr int Reads = 100;

/// "good 95 timeouts 5 late 2": what isn't there is 0.
QString text(const DeviceQuality &quality)
{
    QStringList words{QStringLiteral("good %1").arg(quality.good)};
    for (const AnswerFault fault : AllAnswerFaults) {
        if (countOf(quality, fault) > 0)
            words << QStringLiteral("%1 %2").arg(faultName(fault)).arg(countOf(quality, fault));
    }
    if (quality.retries > 0)
        words << QStringLiteral("retries %1").arg(quality.retries);
    return words.join(QStringLiteral(", "));
}

sim::ReplyFault fault(Kind kind, int times = 5)
{
    sim::ReplyFault one;
    one.kind = kind;
    one.id = 2;
    one.times = times;
    one.amount = kind == Kind::Cut ? 9 : kind == Kind::WrongLength ? -1 : 0;
    return one;
}

DeviceQuality device(std::uint8_t id, quint64 good, quint64 crcErrors, quint64 bytes = 0)
{
    DeviceQuality one;
    one.id = id;
    one.good = good;
    one.crcErrors = crcErrors;
    one.bytes = bytes;
    return one;
}

LineQuality line(std::vector<DeviceQuality> devices, LineTime at)
{
    LineQuality quality;
    quality.devices = std::move(devices);
    quality.at = at;
    return quality;
}

} // namespace

Q_DECLARE_METATYPE(sim::ReplyFault)

/// What the bus counts by device, how that comes to the GUI thread, and what a person makes of it.
class TestQuality : public QObject
{
    Q_OBJECT

private slots:
    void initTestCase()
    {
        Result<Catalog> loaded = Catalog::builtIn();
        QVERIFY2(loaded, loaded ? "" : qPrintable(loaded.error().text));
        m_catalog = std::make_unique<Catalog>(std::move(*loaded));
    }

    void percentilesAreRightToATwentieth_data()
    {
        QTest::addColumn<double>("median"); // µs, of a log-normal distribution
        for (const double median : {20.0, 300.0, 5'000.0, 400'000.0})
            QTest::addRow("around %g us", median) << median;
    }

    void percentilesAreRightToATwentieth()
    {
        QFETCH(double, median);
        std::mt19937 random(7); // NOLINT: the same each time
        std::lognormal_distribution<double> distribution(std::log(median), 0.6);
        DurationCounts counts;
        std::vector<double> exact;
        for (int i = 0; i < 20'000; ++i) {
            exact.push_back(distribution(random));
            counts.add(LineTime(static_cast<LineTime::rep>(exact.back() * 1000)));
        }
        std::ranges::sort(exact);
        for (const double part : {0.01, 0.5, 0.9, 0.99}) {
            const double wanted = exact[static_cast<std::size_t>(part * 20'000)];
            const double got = std::chrono::duration<double, std::micro>(counts.percentile(part)).count();
            QVERIFY2(std::abs(got - wanted) < 0.05 * wanted + 0.5,
                qPrintable(QStringLiteral("%1 for %2").arg(got).arg(wanted)));
        }
    }

    void percentilesOfTheExtremes()
    {
        DurationCounts counts;
        QCOMPARE(counts.percentile(0.5), LineTime());
        counts.add(-1ns);
        counts.add(0ns);
        QVERIFY(counts.percentile(1) <= 2us);
        counts.add(24h);
        QVERIFY(counts.percentile(1) > 16s);
        DurationCounts before = counts;
        counts.add(100us);
        const DurationCounts since = counts.since(before);
        QCOMPARE(since.count(), quint64(1));
        QVERIFY(since.percentile(0.01) > 85us && since.percentile(1) < 115us);
    }

    void countsByKindAndDevice_data()
    {
        QTest::addColumn<sim::ReplyFault>("fault");
        QTest::addColumn<QString>("expected"); ///< of device 2; the others are good throughout
        QTest::newRow("none") << fault(Kind::Lost, 0) << QStringLiteral("good 100");
        QTest::newRow("lost") << fault(Kind::Lost) << QStringLiteral("good 95, Timeouts 5");
        QTest::newRow("cut") << fault(Kind::Cut) << QStringLiteral("good 95, Cut off 5");
        QTest::newRow("damaged") << fault(Kind::Damaged) << QStringLiteral("good 95, CRC 5");
        QTest::newRow("length") << fault(Kind::WrongLength) << QStringLiteral("good 95, Length 5");
    }

    void countsByKindAndDevice()
    {
        QFETCH(sim::ReplyFault, fault);
        QFETCH(QString, expected);
        if (fault.kind == Kind::Damaged)
            fault.damage.part = sim::PacketPart::Crc;
        VirtualBus world(*m_catalog, QStringLiteral("XM430-W350@57600:1,XM430-W350@57600:2,XM430-W350@57600:3"));
        sim::LineFaults faults;
        faults.replies = {fault};
        world.simulated.setFaults(faults);
        for (int i = 0; i < Reads; ++i) {
            for (const std::uint8_t id : {1, 2, 3})
                QVERIFY(world.bus->exchange(readRequest({id, 132, 4}), 0));
        }
        const LineQuality quality = world.bus->quality();
        QCOMPARE(text(*quality.device(1)), QStringLiteral("good 100"));
        QCOMPARE(text(*quality.device(2)), expected);
        QCOMPARE(text(*quality.device(3)), QStringLiteral("good 100"));
        QCOMPARE(quality.device(1)->bytes, quint64(Reads) * 15);
        // Return delay 500 µs, processing 100 µs, 15 bytes at 57 600.
        const double median =
            std::chrono::duration<double, std::milli>(quality.device(1)->responses.percentile(0.5)).count();
        QVERIFY2(median > 2.9 && median < 3.6, qPrintable(QString::number(median)));
        QCOMPARE(quality.sum().good, quality.device(1)->good + quality.device(2)->good + quality.device(3)->good);
        QVERIFY(!quality.device(4));
    }

    /// Whether an ID is free, whether a device came back, who is at other rates: nobody there is an answer.
    void askingWhetherSomebodyIsThereIsNoFault()
    {
        VirtualBus world(*m_catalog, QStringLiteral("XM430-W350@57600:2"));
        Bus &bus = *world.bus;
        QVERIFY(read(bus, {2, 132, 4}));
        for (const std::uint8_t id : {2, 3}) {
            if (id == 2) // it was there
                QVERIFY(write(bus, {2, 8, {3}}, 0) && bus.wait(100ms));
            QVERIFY(!ping(bus, id));
            const Asking asking(bus);
            QVERIFY(!read(bus, {id, 132, 4}));
        }
        StopTarget away;
        away.id = 9;
        away.baudRate = 1'000'000;
        QCOMPARE(verifyTorqueOff(bus, StopPlan({away}), 57600).size(), std::size_t(1));
        LineQuality quality = bus.quality();
        QCOMPARE(text(*quality.device(2)), QStringLiteral("good 2"));
        QVERIFY(!quality.device(3) && !quality.device(9));
        QCOMPARE(quality.totals.timeouts, quint64(0));
        QCOMPARE(quality.totals.retries, quint64(0));
        QVERIFY(!read(bus, {2, 132, 4})); // this is one; the Ping that goes before it isn't
        quality = bus.quality();
        QVERIFY(quality.totals.timeouts <= 1);
        QCOMPARE(quality.totals.timeouts, quality.sum().timeouts);
    }

    /// Not the time that was waited.
    void theLoadIsOfTheWire()
    {
        VirtualBus world(*m_catalog, QStringLiteral("XM430-W350@57600:2"));
        const BusStatistics before = world.bus->statistics();
        QVERIFY(read(*world.bus, {2, 132, 4}));
        QVERIFY(!ping(*world.bus, 3));
        const BusStatistics after = world.bus->statistics();
        const quint64 bytes = after.bytesSent + after.bytesReceived - before.bytesSent - before.bytesReceived;
        QCOMPARE(bytes, quint64(14 + 15 + 3 * 10));
        QCOMPARE(after.busy - before.busy, static_cast<LineTime::rep>(bytes) * world.line->byteTime());
    }

    void retriesAreCounted()
    {
        VirtualBus world(*m_catalog, QStringLiteral("XM430-W350@57600:2"));
        sim::LineFaults faults;
        faults.replies = {fault(Kind::Lost, 2)};
        world.simulated.setFaults(faults);
        QVERIFY(read(*world.bus, {2, 132, 4}));
        QCOMPARE(world.bus->quality().device(2)->retries, quint64(2));
        QCOMPARE(world.bus->quality().totals.retries, quint64(2));
    }

    void comesToTheGuiThread()
    {
        BusWorld world;
        QSignalSpy told(&world.thread, &BusThread::qualityChanged);
        QTRY_COMPARE(told.size(), 1); // when it is open
        QVERIFY(world.thread.quality().devices.empty());
        world.run(Priority::Normal, [](JobContext &context) -> Result<int> {
            for (int i = 0; i < Reads; ++i)
                (void)read(context.bus(), {2, 132, 4});
            return 0;
        });
        QTRY_VERIFY(world.thread.quality().device(2));
        QCOMPARE(world.thread.quality().device(2)->good, quint64(Reads));
        QVERIFY(world.thread.quality().at > LineTime());
    }

    void comesOnceMoreWhenTheLineIsLost()
    {
        BusWorld world;
        QTRY_COMPARE(world.thread.state(), BusThread::State::Open);
        QSignalSpy told(&world.thread, &BusThread::qualityChanged);
        world.run(Priority::Normal, [](JobContext &context) -> Result<int> {
            (void)read(context.bus(), {3, 132, 4});
            static_cast<FakeLine &>(context.bus().line()).unplugged = true;
            (void)read(context.bus(), {1, 132, 4}); // or nobody would notice: an idle line's time stands still
            return 0;
        });
        QTRY_COMPARE(world.thread.state(), BusThread::State::Lost);
        QCOMPARE(world.thread.quality().device(3)->good, quint64(1));
    }

    void isToldAboutTwiceASecondHoweverMuchHappens()
    {
        BusWorld world;
        QSignalSpy told(&world.thread, &BusThread::qualityChanged);
        PollPlan plan;
        Traits traits;
        traits.id = 1;
        plan.traits = {traits};
        plan.spans = {{1, {1, 132, 4}, 0ms}};
        world.thread.setPollPlan(plan);
        std::size_t batches = 0;
        QElapsedTimer time;
        time.start();
        while (batches < 5000 && time.elapsed() < 20'000) {
            QCoreApplication::processEvents(QEventLoop::AllEvents, 10);
            batches += world.thread.takeBatches().size();
        }
        const auto most = static_cast<qsizetype>(2 + time.elapsed() / 500);
        QVERIFY(batches >= 5000);
        QVERIFY2(told.size() <= most, qPrintable(QString::number(told.size())));
    }

    void countingStartsAnew()
    {
        LineHealth health;
        health.take(line({device(1, 10, 1, 100), device(2, 10, 0, 100)}, 1s));
        QCOMPARE(health.quality().device(1)->crcErrors, quint64(1));
        QCOMPARE(health.bytesPerSecond(1), 0.0); // nothing to compare with yet
        health.take(line({device(1, 20, 2, 200), device(2, 20, 3, 400)}, 3s));
        QCOMPARE(health.bytesPerSecond(1), 50.0);
        QCOMPARE(health.bytesPerSecond(), 200.0);
        QCOMPARE(health.seconds(), 2.0);

        QSignalSpy changes(&health, &LineHealth::changed);
        health.startAnew();
        QCOMPARE(changes.size(), 1);
        QCOMPARE(health.seconds(), 0.0);
        QCOMPARE(health.quality().device(2)->asked(), quint64(0));
        health.take(line({device(1, 25, 2, 250), device(2, 20, 7, 400)}, 4s));
        QCOMPARE(text(*health.quality().device(1)), QStringLiteral("good 5"));
        QCOMPARE(text(*health.quality().device(2)), QStringLiteral("good 0, CRC 4"));

        health.startAnew(std::uint8_t(2)); // another device stands there
        QCOMPARE(text(*health.quality().device(1)), QStringLiteral("good 5"));
        QCOMPARE(text(*health.quality().device(2)), QStringLiteral("good 0"));
        health.begin(); // the line was opened again
        QVERIFY(health.quality().devices.empty());
        health.take(line({device(1, 1, 0)}, 9s));
        QCOMPARE(text(*health.quality().device(1)), QStringLiteral("good 1"));
    }

    /// What comes once a second is counted over more than one.
    void answersOfAnInterval()
    {
        LineHealth health;
        const auto report = [&health](LineTime at, quint64 slow, std::chrono::milliseconds interval = 1s) {
            LineQuality quality = line({device(1, 10, 0)}, at);
            quality.polled.taken = {{interval, slow}};
            health.take(quality);
        };
        report(1s, 0);
        QCOMPARE(health.answersPerSecond(1s), 0.0);
        for (int half = 1; half <= 20; ++half)
            report(1s + half * 500ms, static_cast<quint64>(3 * ((half + 1) / 2)));
        QVERIFY(std::abs(health.answersPerSecond(1s) - 3) < 0.5);
        report(20s, 2); // another plan
        QCOMPARE(health.answersPerSecond(1s), 0.0);
        report(21s, 12, 100ms);
        report(22s, 32, 100ms);
        QCOMPARE(health.answersPerSecond(100ms), 20.0);
        QCOMPARE(health.answersPerSecond(1s), 0.0);
    }

    void verdicts_data()
    {
        QTest::addColumn<quint64>("good");
        QTest::addColumn<quint64>("bad");
        QTest::addColumn<int>("expected");
        const auto row = [](quint64 good, quint64 bad, Verdict verdict) {
            QTest::addRow("%llu good, %llu bad", good, bad) << good << bad << int(verdict);
        };
        row(0, 0, Verdict::Unknown);
        row(1, 0, Verdict::Good);
        row(10'000, 9, Verdict::Good);
        row(9'990, 10, Verdict::Poor);
        row(10, 1, Verdict::Poor); // too few to be sure
        row(9'901, 99, Verdict::Poor);
        row(9'900, 100, Verdict::Bad);
        row(0, 3, Verdict::Bad);
    }

    void verdicts()
    {
        QFETCH(quint64, good);
        QFETCH(quint64, bad);
        QFETCH(int, expected);
        QCOMPARE(int(verdictOn(device(1, good, bad))), expected);
    }

    void aBadCableIsWorseThanAnAccident()
    {
        const auto badness = [](quint64 good, quint64 bad) { return dynascope::badness(device(1, good, bad)); };
        QVERIFY(badness(980, 20) > badness(19, 1));
        QVERIFY(badness(19, 1) > badness(999, 1));
        QVERIFY(badness(970, 30) > badness(980, 20));
        QVERIFY(badness(100'000, 1) == badness(100'000, 0)); // both are shown as 0.00 %
        QVERIFY(badness(1, 0) > badness(0, 0));
    }

    void theMainFault()
    {
        DeviceQuality quality = device(1, 10, 3);
        QCOMPARE(mainFault(device(1, 10, 0)).has_value(), false);
        QVERIFY(mainFault(quality) == AnswerFault::Damaged);
        quality.timeouts = 7; // of these, cut off:
        quality.cutOff = 5;
        QVERIFY(mainFault(quality) == AnswerFault::CutOff);
        QCOMPARE(countOf(quality, AnswerFault::Missing), quint64(2));
        quint64 sum = 0;
        for (const AnswerFault fault : AllAnswerFaults) {
            sum += countOf(quality, fault);
            QVERIFY(!faultName(fault).isEmpty() && !faultMeaning(fault).isEmpty() && !usualCauses(fault).isEmpty());
        }
        QCOMPARE(sum, quality.bad());
    }

private:
    std::unique_ptr<Catalog> m_catalog;
};

DYNASCOPE_CORE_TEST(TestQuality)
#include "tst_quality.moc"
