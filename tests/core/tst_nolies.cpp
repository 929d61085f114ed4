// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/bus.h"
#include "tests/support/hex.h"
#include "tests/support/hostileline.h"
#include "tests/support/oracle.h"
#include "tests/support/sanitized.h"
#include "tests/support/testmain.h"

#include <future>

using namespace dynascope;
using namespace std::chrono_literals;

namespace {

constexpr int Exchanges = test::Sanitized ? 200'000 : 1'000'000; ///< the first 200 000 of the same
constexpr int ExchangesOfAWorld = 2'000; ///< then another line, rate, adapter

/// What a run came to.
struct Tally {
    quint64 exchanges = 0, values = 0, failures = 0, fences = 0, clean = 0;
    QStringList lies;
    QStringList excused; ///< wrong, but the bytes were a complete valid answer
    void add(const Tally &other)
    {
        exchanges += other.exchanges;
        values += other.values;
        failures += other.failures;
        clean += other.clean;
        lies += other.lies;
        excused += other.excused;
    }
};

/// Are there bytes that make a complete valid answer with this value? By the oracle; ordinary and fast.
bool answersWith(const Bytes &stream, std::uint8_t id, const Bytes &value)
{
    const Bytes plain = oracle::status(id, 0, value);
    const Bytes alert = oracle::status(id, 0x80, value);
    const auto holds = [&stream](const Bytes &packet) { // clang 14 can't do std::ranges::search
        return std::search(stream.begin(), stream.end(), packet.begin(), packet.end()) != stream.end();
    };
    if (holds(plain) || holds(alert))
        return true;
    static const Bytes header{0xFF, 0xFF, 0xFD, 0, 0xFE};
    for (auto at = stream.begin();; ++at) { // blocks of fast answers: the CRC covers all from the header on
        at = std::search(at, stream.end(), header.begin(), header.end());
        if (at == stream.end())
            return false;
        for (auto block = at + 8; stream.end() - block >= static_cast<std::ptrdiff_t>(value.size()) + 4; ++block) {
            const auto data = block + 2, crcAt = data + static_cast<std::ptrdiff_t>(value.size());
            if (block[1] == id && std::equal(value.begin(), value.end(), data)
                && oracle::crc({at, crcAt}) == crcAt[0] + 256 * crcAt[1])
                return true;
        }
    }
}

class World
{
public:
    World(quint64 seed, HostileLine::Damage kind)
        : m_random(seed)
        , m_line(seed, pick({57'600, 1'000'000, 4'000'000}), LineTime(pick({0, 2, 16}) * 1ms), chance(4))
        , m_bus(m_line)
    {
        if (chance(2)) {
            m_mute = static_cast<std::uint8_t>(1 + upTo(HostileLine::Servos));
            m_line.setMute(m_mute);
            Traits traits;
            traits.id = m_mute;
            traits.statusReturnLevel = 1;
            m_bus.setTraits({traits});
        }
        m_manners = {0.06, 0.06, 0.06, 0.06, 0.08, kind, pick({0, 1}) ? LineTime(1s) : LineTime(40ms)};
    }

    Tally run(int exchanges)
    {
        for (int i = 0; i < exchanges && m_tally.lies.size() < 5; ++i) {
            const bool clean = chance(10);
            if (clean)
                m_line.calm();
            m_line.setManners(clean ? HostileLine::Manners() : m_manners);
            one(clean);
        }
        return m_tally;
    }

private:
    int upTo(int count) { return static_cast<int>(m_random() % static_cast<quint64>(count)); }
    bool chance(int oneIn) { return upTo(oneIn) == 0; }
    int pick(std::initializer_list<int> from) { return from.begin()[upTo(static_cast<int>(from.size()))]; }

    /// Mostly those who are there; few addresses and lengths, so that answers can be mistaken for each other.
    Span span(std::uint8_t id)
    {
        const auto address = static_cast<std::uint16_t>(pick({132, 116, 7}));
        return {id, address, static_cast<std::uint16_t>(pick({1, 2, 3, 4, 4, 4, 10}))};
    }
    std::vector<std::uint8_t> ids(int lastId)
    {
        std::vector<std::uint8_t> all;
        for (int id = 1; id <= lastId; ++id) {
            if (!chance(3))
                all.push_back(static_cast<std::uint8_t>(id));
        }
        if (all.empty())
            all.push_back(1);
        std::ranges::shuffle(all, m_random);
        return all;
    }

    /// `alive`: asks only those who are there.
    Request request(bool alive, std::vector<Span> &spans)
    {
        const int lastId = HostileLine::Servos + (alive || !chance(6) ? 0 : 1);
        const auto id = static_cast<std::uint8_t>(1 + upTo(lastId));
        spans = {span(id)};
        switch (upTo(10)) {
        case 8: return regWriteRequest({id, spans.front().address, {1, 2}});
        case 9: return actionRequest(id);
        case 0: spans = {{id, 0, 3}}; return pingRequest(id);
        case 1: return writeRequest({id, spans.front().address, {1, 2}});
        case 2:
        case 3: {
            const std::vector<std::uint8_t> all = ids(lastId);
            const Span first = spans.front();
            spans.clear();
            for (const std::uint8_t each : all)
                spans.push_back({each, first.address, first.length});
            return syncReadRequest(first.address, first.length, all, chance(2));
        }
        case 4: {
            spans.clear();
            for (const std::uint8_t each : ids(lastId))
                spans.push_back(span(each));
            return bulkReadRequest(spans, chance(2));
        }
        default: return readRequest(spans.front());
        }
    }

    void one(bool clean)
    {
        m_line.forgetDelivered();
        const LineTime begin = m_line.now();
        ++m_tally.exchanges;
        if (!clean && chance(200)) {
            const auto found = m_bus.broadcastPing(HostileLine::Servos, {});
            for (std::size_t i = 0; found && i < found->replies.size(); ++i)
                check(pingRequest(BroadcastId), {found->replies[i]->id, 0, 3}, found->replies[i], begin, false);
            return;
        }
        std::vector<Span> spans;
        const Request request = this->request(clean, spans);
        const int retries = clean ? 0 : upTo(3);
        const auto result = m_bus.exchange(request, retries);
        const LineTime took = m_line.now() - begin;
        if (!result) {
            lie(QStringLiteral("the line failed: ") + result.error().text);
            return;
        }
        if (took > longest(request, retries))
            lie(QStringLiteral("%1 ms for %2").arg(took / 1ms).arg(instructionName(request.packet.instruction)));
        m_tally.clean += clean ? 1 : 0;
        for (std::size_t i = 0; i < result->replies.size(); ++i)
            check(request, spans[i], result->replies[i], begin, clean);
    }

    /// Settling, a Ping as fence and the request itself, each with its answers and what the adapter may add.
    LineTime longest(const Request &request, int retries) const
    {
        const auto devices = static_cast<LineTime::rep>(request.replies.size());
        const LineTime bytes = static_cast<LineTime::rep>(4 * (request.maximumReplySize() + 100)) * m_line.byteTime();
        const LineTime processing = request.isWrite() ? 50ms : 1ms;
        return (retries + 1) * (2 * 51ms + bytes + (devices + 1) * (3 * 16ms + 100ms + processing + 10ms));
    }

    void check(const Request &request, const Span &span, const Result<Reply> &reply, LineTime begin, bool clean)
    {
        if (!reply) {
            ++m_tally.failures;
            if (clean)
                lie(QStringLiteral("a clean exchange failed: ") + reply.error().text);
            return;
        }
        ++m_tally.values;
        bool good = false;
        // By its Status Return Level: nothing is claimed.
        const bool saysNothing = span.id == m_mute && reply->bytes == 0;
        switch (request.packet.instruction) {
        case Instruction::Ping: good = reply->data == Bytes{6, 4, span.id} && span.id <= HostileLine::Servos; break;
        case Instruction::Write:
        case Instruction::RegWrite: good = saysNothing || m_line.wasWritten(span.id, span.address); break;
        case Instruction::Action: good = saysNothing || m_line.wasActedOn(span.id); break;
        default:
            good = reply->data.size() == span.length
                && HostileLine::held(reply->data, begin, m_line.now(), span.id, span.address);
        }
        if (good)
            return;
        const QString what = QStringLiteral("device %1 address %2: %3 (%4)")
                                 .arg(span.id)
                                 .arg(span.address)
                                 .arg(hex::text(reply->data), instructionName(request.packet.instruction));
        const bool wild = m_manners.kind == HostileLine::Damage::Wild;
        if (wild && answersWith(m_line.delivered(), span.id, reply->data))
            m_tally.excused << what;
        else
            lie(what);
    }

    void lie(const QString &what) { m_tally.lies << what; }

    std::mt19937_64 m_random;
    HostileLine m_line;
    Bus m_bus;
    HostileLine::Manners m_manners;
    std::uint8_t m_mute = 0; ///< 0: nobody
    Tally m_tally;
};

Tally runWorlds(quint64 firstSeed, quint64 step, int exchanges, HostileLine::Damage kind)
{
    Tally tally;
    for (quint64 seed = firstSeed; exchanges > 0 && tally.lies.isEmpty(); seed += step) {
        tally.add(World(seed, kind).run(ExchangesOfAWorld));
        exchanges -= ExchangesOfAWorld;
    }
    return tally;
}

} // namespace

/// Whatever an adapter does to the bytes, no wrong value is returned as a right one, and nothing hangs.
class TestNoLies : public QObject
{
    Q_OBJECT

private slots:
    void everyValueWasTrue_data()
    {
        QTest::addColumn<bool>("wild");
        QTest::addColumn<int>("exchanges");
        QTest::newRow("damage that the CRC sees") << false << Exchanges;
        QTest::newRow("any damage") << true << Exchanges / 4;
    }

    void everyValueWasTrue()
    {
        QFETCH(bool, wild);
        QFETCH(int, exchanges);
        const HostileLine::Damage kind = wild ? HostileLine::Damage::Wild : HostileLine::Damage::Seen;
        const auto first = qEnvironmentVariable("DYNASCOPE_SEED", QStringLiteral("1")).toULongLong(); // to search on
        auto other = std::async(std::launch::async, runWorlds, first + 1, 2, exchanges / 2, kind);
        Tally tally = runWorlds(first, 2, exchanges / 2, kind);
        tally.add(other.get());
        qInfo("%llu exchanges, %llu values, %llu failures, %llu after a calm; wrong though valid: %lld",
            static_cast<unsigned long long>(tally.exchanges), static_cast<unsigned long long>(tally.values),
            static_cast<unsigned long long>(tally.failures), static_cast<unsigned long long>(tally.clean),
            static_cast<long long>(tally.excused.size()));
        for (const QString &excused : tally.excused)
            qInfo("  %s", qPrintable(excused));
        QCOMPARE(tally.lies.join(u'\n'), QString());
        QVERIFY(tally.exchanges >= static_cast<quint64>(exchanges));
        QVERIFY(tally.values > tally.failures); // it is not by refusing everything
    }
};

DYNASCOPE_CORE_TEST(TestNoLies)
#include "tst_nolies.moc"
