// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/readchoice.h"
#include "tests/support/testmain.h"

#include <QElapsedTimer>
#include <QRandomGenerator>

#include <algorithm>
#include <functional>

using namespace dynascope;
using namespace std::chrono_literals;

namespace {

struct Case {
    std::vector<Span> spans;
    std::vector<Traits> traits;
    ReadCosts costs;
};

QString text(const std::vector<ChosenRead> &reads)
{
    QStringList lines;
    for (const ChosenRead &read : reads) {
        QStringList parts{instructionName(read.request().packet.instruction)};
        for (const Span &span : read.asked)
            parts << QStringLiteral("%1@%2+%3").arg(span.id).arg(span.address).arg(span.length);
        lines << parts.join(u' ');
    }
    return lines.join(QStringLiteral(", "));
}

const Traits &traitsOf(const Case &world, std::uint8_t id)
{
    return *std::ranges::find(world.traits, id, &Traits::id);
}

/// What these pieces cost in one exchange, the cheapest kind there is; max: they can't be read by one.
LineTime costOfGroup(const Case &world, const std::vector<Span> &pieces)
{
    std::vector<AskedDevice> asked;
    bool sync = true, fast = true;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const Traits &traits = traitsOf(world, pieces[i].id);
        if (pieces.size() > 1 && (!traits.groupReads || traits.statusReturnLevel < 1))
            return LineTime::max();
        for (std::size_t other = 0; other < i; ++other) {
            if (pieces[other].id == pieces[i].id)
                return LineTime::max();
        }
        sync = sync && pieces[i].address == pieces[0].address && pieces[i].length == pieces[0].length;
        fast = fast && traits.fastReads;
        asked.push_back({pieces[i].length, traits.returnDelay});
    }
    const auto cost = [&](ReadKind kind) {
        return costOf(kind, asked, world.costs.byteTime, world.costs.delays).total();
    };
    if (pieces.size() == 1)
        return cost(ReadKind::Single);
    LineTime least = std::min(cost(ReadKind::Bulk), sync ? cost(ReadKind::Sync) : LineTime::max());
    if (fast)
        least = std::min({least, cost(ReadKind::FastBulk), sync ? cost(ReadKind::FastSync) : LineTime::max()});
    return least;
}

/// Every way to share the pieces among exchanges.
LineTime cheapestGrouping(const Case &world, const std::vector<Span> &pieces)
{
    const std::size_t all = (std::size_t(1) << pieces.size()) - 1;
    std::vector<LineTime> group(all + 1, LineTime::max()), best(all + 1, LineTime::max());
    for (std::size_t mask = 1; mask <= all; ++mask) {
        std::vector<Span> members;
        for (std::size_t i = 0; i < pieces.size(); ++i) {
            if (mask >> i & 1)
                members.push_back(pieces[i]);
        }
        group[mask] = costOfGroup(world, members);
    }
    best[0] = {};
    for (std::size_t mask = 1; mask <= all; ++mask) {
        const std::size_t lowest = mask & (~mask + 1);
        for (std::size_t part = mask; part > 0; part = (part - 1) & mask) {
            if ((part & lowest) != 0 && group[part] < LineTime::max())
                best[mask] = std::min(best[mask], group[part] + best[mask ^ part]);
        }
    }
    return best[all];
}

/// And every way to read gaps through.
LineTime cheapest(const Case &world)
{
    std::vector<Span> spans = world.spans; // by ID, then address
    std::vector<std::size_t> gaps;         // behind which span
    for (std::size_t i = 0; i + 1 < spans.size(); ++i) {
        if (spans[i].id == spans[i + 1].id && world.costs.mayJoin)
            gaps.push_back(i);
    }
    LineTime least = LineTime::max();
    for (std::size_t bits = 0; bits < std::size_t(1) << gaps.size(); ++bits) {
        std::vector<Span> pieces;
        for (std::size_t i = 0; i < spans.size(); ++i) {
            const auto gap = i > 0 ? std::ranges::find(gaps, i - 1) : gaps.end();
            if (gap != gaps.end() && (bits >> (gap - gaps.begin()) & 1) != 0)
                pieces.back().length =
                    static_cast<std::uint16_t>(spans[i].address + spans[i].length - pieces.back().address);
            else
                pieces.push_back(spans[i]);
        }
        least = std::min(least, cheapestGrouping(world, pieces));
    }
    return least;
}

Case randomCase(QRandomGenerator &random, std::size_t most = 7)
{
    Case world;
    const int devices = random.bounded(1, static_cast<int>(most) - 2);
    const std::array places{Span{0, 126, 2}, Span{0, 132, 4}, Span{0, 146, 1}, Span{0, 64, 1}, Span{0, 70, 1}};
    for (int id = 1; id <= devices && world.spans.size() < most; ++id) {
        Traits traits;
        traits.id = static_cast<std::uint8_t>(id);
        traits.fastReads = random.bounded(2) == 0;
        traits.groupReads = random.bounded(8) != 0;
        traits.returnDelay = std::chrono::microseconds(random.bounded(2) == 0 ? 0 : 500);
        world.traits.push_back(traits);
        std::vector<Span> own;
        const int count = random.bounded(1, 4);
        for (int i = 0; i < count; ++i) {
            Span span = places[static_cast<std::size_t>(random.bounded(int(places.size())))];
            span.id = traits.id;
            if (std::ranges::find(own, span) == own.end() && world.spans.size() + own.size() < most)
                own.push_back(span);
        }
        std::ranges::sort(own, {}, &Span::address);
        world.spans.insert(world.spans.end(), own.begin(), own.end());
    }
    const std::array bauds{57'600, 1'000'000, 4'000'000};
    world.costs.byteTime = LineTime(10'000'000'000LL / bauds[static_cast<std::size_t>(random.bounded(3))]);
    const std::array latencies{LineTime(0), LineTime(1ms), LineTime(16ms)};
    world.costs.delays.latencyTimer = latencies[static_cast<std::size_t>(random.bounded(3))];
    world.costs.delays.perExchange = LineTime(random.bounded(2) * 200us);
    world.costs.mayJoin = random.bounded(4) != 0;
    return world;
}

} // namespace

/// The reads that are chosen are the cheapest there are.
class TestReadChoice : public QObject
{
    Q_OBJECT

private slots:
    void noOtherWayIsCheaper()
    {
        QRandomGenerator random(7);
        int dearer = 0;
        double worst = 1;
        const int cases = 1500;
        for (int i = 0; i < cases; ++i) {
            const Case world = randomCase(random);
            const std::vector<ChosenRead> reads = chooseReads(world.spans, world.traits, world.costs);
            const LineTime chosen = costOf(reads, world.traits, world.costs).total();
            const LineTime least = cheapest(world);
            if (chosen > least) {
                ++dearer;
                const double by = static_cast<double>(chosen.count()) / static_cast<double>(least.count());
                if (by > worst)
                    qInfo("%s: %.4f", qPrintable(text(reads)), by);
                worst = std::max(worst, by);
            }
            QVERIFY2(chosen >= least, qPrintable(text(reads))); // or the brute force misses one
        }
        QVERIFY2(dearer == 0, qPrintable(QStringLiteral("%1 of %2, at worst %3").arg(dearer).arg(cases).arg(worst)));
    }

    /// Where not every way is tried.
    void ofManyItIsNearTheCheapest()
    {
        QRandomGenerator random(9);
        double worst = 1, sum = 0;
        int count = 0;
        while (count < 40) {
            Case world = randomCase(random, 10);
            if (world.spans.size() < 9)
                continue;
            world.costs.delays.latencyTimer = {}; // 62 bytes exactly would be a matter of luck
            const LineTime chosen =
                costOf(chooseReads(world.spans, world.traits, world.costs), world.traits, world.costs).total();
            const double by = static_cast<double>(chosen.count()) / static_cast<double>(cheapest(world).count());
            QVERIFY(by >= 1);
            worst = std::max(worst, by);
            sum += by;
            ++count;
        }
        qInfo("at worst %.4f, on average %.4f of the cheapest", worst, sum / count);
        QVERIFY(worst < 1.1 && sum / count < 1.01);
    }

    void eachSpanIsAnsweredOnce()
    {
        QRandomGenerator random(8);
        for (int i = 0; i < 1000; ++i) {
            const Case world = randomCase(random);
            std::vector<int> answers(world.spans.size());
            for (const ChosenRead &read : chooseReads(world.spans, world.traits, world.costs)) {
                QCOMPARE(read.spans.size(), read.replies.size());
                QVERIFY(std::ranges::is_sorted(read.replies));
                for (std::size_t at = 0; at < read.spans.size(); ++at) {
                    const Span &span = world.spans[read.spans[at]];
                    const Span &asked = read.asked[read.replies[at]];
                    ++answers[read.spans[at]];
                    QVERIFY(span.id == asked.id && span.address >= asked.address
                            && span.address + span.length <= asked.address + asked.length);
                }
            }
            QCOMPARE(answers, std::vector<int>(world.spans.size(), 1));
        }
    }

    void whatCostsDecides_data()
    {
        QTest::addColumn<int>("baudRate");
        QTest::addColumn<int>("latency"); // ms
        QTest::addColumn<QString>("reads");
        // Ten bytes lie between: dearer than asking twice only where a byte is slow and asking is not.
        QTest::newRow("4 Mbps") << 4'000'000 << 0 << QStringLiteral("Read 1@132+15");
        QTest::newRow("57600") << 57'600 << 0 << QStringLiteral("Read 1@132+15");
    }
    void whatCostsDecides()
    {
        QFETCH(int, baudRate);
        QFETCH(int, latency);
        QFETCH(QString, reads);
        ReadCosts costs{LineTime(10'000'000'000LL / baudRate), {}, true, {}};
        costs.delays.latencyTimer = LineTime(latency * 1ms);
        Traits traits;
        traits.id = 1;
        const std::vector<Span> spans{{1, 132, 4}, {1, 146, 1}};
        QCOMPARE(text(chooseReads(spans, std::vector{traits}, costs)), reads);
    }

    void aDeviceThatRefusesGapsIsReadByThePiece()
    {
        ReadCosts costs{10us, {}, true, {}};
        costs.unjoined.set(1);
        Traits traits;
        traits.id = 1;
        const std::vector<Span> spans{{1, 132, 4}, {1, 146, 1}};
        QCOMPARE(text(chooseReads(spans, std::vector{traits}, costs)), QStringLiteral("Read 1@132+4, Read 1@146+1"));
    }

    /// A humanoid's plan is made in less time than a few cycles of it take.
    void manyArePlannedQuickly()
    {
        std::vector<Span> spans;
        std::vector<Traits> devices;
        for (int id = 1; id <= 30; ++id) {
            Traits traits;
            traits.id = static_cast<std::uint8_t>(id);
            traits.fastReads = id % 3 != 0;
            devices.push_back(traits);
            const int base = id % 4 == 0 ? 570 : 126;
            for (const auto &[address, length] : {std::pair(0, 2), {2, 4}, {6, 4}, {18, 2}, {20, 1}})
                spans.push_back(
                    {traits.id, static_cast<std::uint16_t>(base + address), static_cast<std::uint16_t>(length)});
        }
        ReadCosts costs{2500ns, {}, true, {}};
        QElapsedTimer timer;
        timer.start();
        const auto reads = chooseReads(spans, devices, costs);
        qInfo("%.1f ms: %s", static_cast<double>(timer.nsecsElapsed()) * 1e-6, qPrintable(text(reads).left(200)));
        QVERIFY(reads.size() <= 4);
    }
};

DYNASCOPE_CORE_TEST(TestReadChoice)
#include "tst_readchoice.moc"
