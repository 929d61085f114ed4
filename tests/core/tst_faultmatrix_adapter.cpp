// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/table/catalog.h"
#include "tests/support/builtincatalog.h"
#include "tests/support/faultmatrix.h"
#include "tests/support/testmain.h"

using namespace faultmatrix;
using sim::PacketPart;

namespace {

/// The fault costs nothing: every exchange comes to what it would on a sound line.
Case harmless(const QString &name, const sim::LineFaults &faults, LineTime allowance = {}, LineTime settle = {})
{
    return {.name = name,
            .faults = faults,
            .cells = {{"unicast", 0, "="}, {"Broadcast Ping, chained, fast", 0, "= = ="}, {"unanswered", 0, "."}},
            .allowance = allowance,
            .settle = settle};
}

std::vector<Case> echoes()
{
    std::vector<Case> cases{
        harmless(QStringLiteral("sound line"), {}), harmless(QStringLiteral("echo"), {.echo = {.on = true}}),
        harmless(QStringLiteral("echo, late, before the answer"), {.echo = {.on = true, .delay = 300us}}),
        harmless(QStringLiteral("echo, late, the answer behind it"), {.echo = {.on = true, .delay = 2ms}}, 5ms)};
    const std::pair<const char *, sim::Damage> changed[] = {
        {"header", {PacketPart::Header, 1, 0, 9}},
        {"ID", {PacketPart::Id, 1, 0, 2}},
        {"LEN, longer by 1 or 2", {PacketPart::Length, 1, 0, 1}},
        {"LEN, as long as echo and answer", {PacketPart::Length, 1, 0, 4}},
        {"LEN, longer than what comes", {PacketPart::Length, 1, 0, 5}},
        {"LEN, absurd", {PacketPart::Length, 1, 0, 15}},
        {"instruction", {PacketPart::Instruction, 1, 0, 6}},
        {"parameters", {PacketPart::Data, 3}},
        {"CRC", {PacketPart::Crc, 2}},
    };
    for (const auto &[part, damage] : changed) {
        const QString name = QStringLiteral("echo changed in its %1").arg(QString::fromLatin1(part));
        cases.push_back(harmless(name, {.echo = {.on = true, .damage = damage}}));
    }
    return cases;
}

std::vector<Case> latencyAndNoise()
{
    std::vector<Case> cases{
        harmless(QStringLiteral("latency timer 16 ms"), {.latencyTimer = 16ms}, 17ms),
        harmless(QStringLiteral("latency timer 16 ms, small buffer"), {.latencyTimer = 16ms, .latencyBuffer = 5}, 17ms),
        harmless(QStringLiteral("latency timer 16 ms, echo"), {.echo = {.on = true}, .latencyTimer = 16ms}, 17ms)};
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
        const QString name = QStringLiteral("noise between the packets, seed %1").arg(seed);
        cases.push_back(harmless(name, {.seed = seed, .noisePerSecond = 2000}));
    }
    return cases;
}

/// What stands before an answer is skipped. Inside a fast packet it shifts the blocks behind it: these are asked again.
std::vector<Case> noiseBefore()
{
    const std::pair<const char *, Bytes> noises[] = {
        {"a zero", {0x00}},
        {"FF", {0xFF}},
        {"FF FF", {0xFF, 0xFF}},
        {"FF FF FD", {0xFF, 0xFF, 0xFD}},
        {"FF FF FD 00", {0xFF, 0xFF, 0xFD, 0x00}},
        {"a header of the target's with a small LEN", {0xFF, 0xFF, 0xFD, 0x00, 0x02, 0x02, 0x00}},
        {"a header of the target's that swallows the answer", {0xFF, 0xFF, 0xFD, 0x00, 0x02, 0x08, 0x00}},
        {"a header of the target's that wants more than comes", {0xFF, 0xFF, 0xFD, 0x00, 0x02, 0x28, 0x00}},
        {"a header with an absurd LEN", {0xFF, 0xFF, 0xFD, 0x00, 0x02, 0xFF, 0xFF}},
        {"twenty bytes", Bytes(20, 0xA5)},
    };
    std::vector<Case> cases;
    for (const auto &[name, bytes] : noises) {
        const QString text = QString::fromLatin1(name);
        Case middle = harmless(text + QStringLiteral(" before the middle's answer"),
                               {.replies = {{.kind = Fault::NoiseBefore, .id = 2, .noise = bytes}}});
        middle.cells = {
            {"unicast", 0, "="}, {"Broadcast Ping, chained", 0, "= = ="}, {"fast", 1, "= = ="}, {"unanswered", 0, "."}};
        cases.push_back(middle);
        Case first = harmless(text + QStringLiteral(" before the first's answer"),
                              {.replies = {{.kind = Fault::NoiseBefore, .id = 1, .noise = bytes}}});
        first.target = 1;
        cases.push_back(first);
    }
    // Noise where the answer should be: bytes, but no header.
    cases.push_back({.name = QStringLiteral("noise instead of the middle's answer"),
                     .faults = {.replies = {{.kind = Fault::Lost, .id = 2},
                                            {.kind = Fault::NoiseBefore, .id = 2, .noise = Bytes(20, 0xA5)}}},
                     .cells = {{"idempotent", 1, "="},
                               {"commands", 0, "NoHeader"},
                               {"Broadcast Ping", 0, "= - ="},
                               {"chained, fast", 1, "= = ="},
                               {"unanswered", 0, "."}}});
    return cases;
}

sim::LineFaults late(LineTime time)
{
    return {.replies = {{.kind = Fault::Late, .id = 2, .time = time}}};
}

/// The middle's answer comes late, and with it all that follow: the adapter keeps the order.
std::vector<Case> lateAnswers()
{
    const char *stuck = "= NothingReceived NothingReceived";
    return {
        // Within the 50 ms that a write may take and the 1.5 ms that a fast packet may pause; past the 0.1 ms of a
        // read: quiet is waited for, then asked again.
        {.name = QStringLiteral("late by 1 ms, before the next request"),
         .faults = late(1ms),
         .cells = {{"Ping, Read", 1, "="},
                   {"Write, commands", 0, "="},
                   {"Broadcast Ping, fast", 0, "= = ="},
                   {"chained", 1, "= = ="},
                   {"unanswered", 0, "."}}},
        // Whatever is asked meanwhile is answered behind it.
        {.name = QStringLiteral("late by 20 ms, after the last retry"),
         .faults = late(20ms),
         .cells = {{"Ping, Read", 2, "NothingReceived"},
                   {"Write, commands", 0, "="},
                   {"Broadcast Ping", 0, "= = ="},
                   {"chained, fast", 2, stuck},
                   {"unanswered", 0, "."}},
         .settle = 20ms},
        {.name = QStringLiteral("late by 10 s"),
         .faults = late(10s),
         .cells = {{"idempotent", 2, "NothingReceived"},
                   {"commands", 0, "NothingReceived"},
                   {"Broadcast Ping", 0, "= - -"},
                   {"chained, fast", 2, stuck},
                   {"unanswered", 0, "."}},
         .settle = 10s},
    };
}

} // namespace

/// What adapters and cables do to the bytes: echo, latency, noise, lateness.
class TestFaultMatrixAdapter : public QObject
{
    Q_OBJECT

private slots:
    void initTestCase()
    {
        for (const auto &family : {echoes(), latencyAndNoise(), noiseBefore(), lateAnswers()})
            m_cases.insert(m_cases.end(), family.begin(), family.end());
    }

    void exchange_data() { addRows(m_cases); }

    void exchange()
    {
        QFETCH(int, number);
        QFETCH(int, request);
        run(m_catalog, m_cases.at(static_cast<std::size_t>(number)), static_cast<Kind>(request));
    }

    /// Wherever the late answer falls, into the wait for quiet, the proving Ping, the retry or the next request: no
    /// later request takes it for its own. Reads of 3 bytes answer as long as a Ping does.
    void aLateAnswerIsNeverTheNextValue_data()
    {
        QTest::addColumn<int>("length");
        for (const int length : {1, 2, 3, 4})
            QTest::addRow("%d bytes", length) << length;
    }

    void aLateAnswerIsNeverTheNextValue()
    {
        QFETCH(int, length);
        constexpr std::uint16_t ProfileVelocity = 112;
        const Request read = readRequest({2, ProfileVelocity, static_cast<std::uint16_t>(length)});
        QStringList lies;
        for (LineTime lateness = 0us; lateness < 12ms; lateness += 40us) {
            World world(m_catalog, 0us);
            world.simulated.setFaults(late(lateness));
            for (int value = 0x010101; value < 0x060606; value += 0x010101) {
                (void)world.servo(2).write(u"Profile Velocity", value % 0x7FFF);
                const auto result = world.bus->exchange(read, value % 2);
                Bytes truth;
                appendLittleEndian(truth, static_cast<std::uint32_t>(value % 0x7FFF), length);
                if (result && result->replies.front() && result->replies.front()->data != truth)
                    lies << QStringLiteral("%1 us").arg(lateness / 1us);
            }
        }
        QVERIFY2(lies.isEmpty(), qPrintable(QStringLiteral("late by ") + lies.join(u", ")));
    }

private:
    const Catalog m_catalog = test::builtInCatalog();
    std::vector<Case> m_cases;
};

DYNASCOPE_CORE_TEST(TestFaultMatrixAdapter)
#include "tst_faultmatrix_adapter.moc"
