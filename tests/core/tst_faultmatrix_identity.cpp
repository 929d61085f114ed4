// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/table/catalog.h"
#include "tests/support/builtincatalog.h"
#include "tests/support/faultmatrix.h"
#include "tests/support/testmain.h"

using namespace faultmatrix;

namespace {

constexpr int Always = -1;
constexpr int Stranger = 9; ///< an ID that nobody has

std::vector<Case> wrongIds()
{
    const sim::LineFaults once{.replies = {{.kind = Fault::WrongId, .id = 2, .amount = Stranger}}};
    const sim::LineFaults always{.replies = {{.kind = Fault::WrongId, .id = 2, .times = Always, .amount = Stranger}}};
    return {
        {.name = QStringLiteral("middle answers under another ID once"),
         .faults = once,
         .cells = {{"idempotent", 1, "="},
                   {"commands", 0, "WrongId"},
                   {"Broadcast Ping", 0, "= - = +9"},
                   {"chained, fast", 1, "= = ="},
                   {"unanswered", 0, "."}}},
        {.name = QStringLiteral("middle always answers under another ID"),
         .faults = always,
         .cells = {{"idempotent", 2, "WrongId"},
                   {"commands", 0, "WrongId"},
                   {"Broadcast Ping", 0, "= - = +9"},
                   {"chained, fast", 2, "= WrongId ="},
                   {"unanswered", 0, "."}}},
    };
}

/// Somebody else speaks first: dropped, and waited on. Inside a fast packet it shifts the blocks behind it.
std::vector<Case> strays()
{
    const auto before = [](int id, int stray) {
        return sim::LineFaults{.replies = {{.kind = Fault::StrayBefore, .id = id, .amount = stray}}};
    };
    return {
        {.name = QStringLiteral("a stray answer before the middle's"),
         .faults = before(2, Stranger),
         .cells = {{"unicast", 0, "="},
                   {"Broadcast Ping", 0, "= = = +9"},
                   {"chained", 0, "= = ="},
                   {"fast", 1, "= = ="},
                   {"unanswered", 0, "."}}},
        {.name = QStringLiteral("a stray answer before the first's"),
         .faults = before(1, Stranger),
         .cells = {{"unicast", 0, "="},
                   {"Broadcast Ping", 0, "= = = +9"},
                   {"chained, fast", 0, "= = ="},
                   {"unanswered", 0, "."}},
         .target = 1},
        // The last can't have spoken before the middle: it isn't the answer to this request.
        {.name = QStringLiteral("one of the last's before the middle's"),
         .faults = before(2, 3),
         .cells = {{"unicast", 0, "="},
                   {"chained", 0, "= = ="},
                   {"fast", 1, "= = ="},
                   {"unanswered", 0, "."}},
         .partial = true},
    };
}

std::vector<Case> lengths()
{
    const auto of = [](int more, int times) {
        return sim::LineFaults{.replies = {{.kind = Fault::WrongLength, .id = 2, .times = times, .amount = more}}};
    };
    const char *group = "= WrongLength =";
    return {
        {.name = QStringLiteral("middle a byte too long once"),
         .faults = of(1, 1),
         .cells = {{"idempotent", 1, "="},
                   {"Reg Write, Action, Reboot, Clear", 0, "WrongLength"},
                   {"Factory Reset, Backup", 0, "WrongLength"},
                   {"Broadcast Ping", 0, "= - ="},
                   {"chained, fast", 1, "= = ="},
                   {"unanswered", 0, "."}}},
        {.name = QStringLiteral("middle a byte too short once"),
         .faults = of(-1, 1),
         .cells = {{"Ping, Read", 1, "="},
                   {"Write, commands", 0, "="},
                   {"Broadcast Ping", 0, "= - ="},
                   {"chained, fast", 1, "= = ="},
                   {"unanswered", 0, "."}}},
        {.name = QStringLiteral("middle always a byte too long"),
         .faults = of(1, Always),
         .cells = {{"idempotent", 2, "WrongLength"},
                   {"Reg Write, Action, Reboot, Clear", 0, "WrongLength"},
                   {"Factory Reset, Backup", 0, "WrongLength"},
                   {"Broadcast Ping", 0, "= - ="},
                   {"chained", 2, group},
                   {"unanswered", 0, "."}},
         .partial = true},
        {.name = QStringLiteral("middle never has any data"),
         .faults = of(-8, Always),
         .cells = {{"Ping, Read", 2, "WrongLength"},
                   {"Write, commands", 0, "="},
                   {"Broadcast Ping", 0, "= - ="},
                   {"chained", 2, group},
                   {"unanswered", 0, "."}},
         .partial = true},
        {.name = QStringLiteral("middle always far too long"),
         .faults = of(50, Always),
         .cells = {{"idempotent", 2, "WrongLength"},
                   {"Reg Write, Action, Reboot, Clear", 0, "WrongLength"},
                   {"Factory Reset, Backup", 0, "WrongLength"},
                   {"Broadcast Ping", 0, "= - ="},
                   {"chained", 2, group},
                   {"unanswered", 0, "."}},
         .partial = true},
    };
}

/// The second copy is nobody's answer, now or later. In a fast packet it runs into the next device's block.
std::vector<Case> twice()
{
    const auto of = [](int id, LineTime gap) {
        return sim::LineFaults{.replies = {{.kind = Fault::Twice, .id = id, .time = gap}}};
    };
    std::vector<Case> cases;
    for (const LineTime gap : {LineTime(0us), LineTime(20us)}) {
        for (int id = 1; id <= 3; ++id) {
            const QString name = QStringLiteral("%1 answers twice, %2 us apart").arg(id).arg(gap / 1us);
            const int retries = id < 3 ? 1 : 0;
            cases.push_back({.name = name,
                             .faults = of(id, gap),
                             .cells = {{"unicast", 0, "="},
                                       {"Broadcast Ping", 0, "= = ="},
                                       {"chained", 0, "= = ="},
                                       {"fast", retries, "= = ="},
                                       {"unanswered", 0, "."}},
                             .target = id,
                             .settle = 1ms});
        }
    }
    return cases;
}

/// Two devices under one ID that answer at the same time: what is alike is whole, what differs is damaged.
std::vector<Case> duplicates()
{
    const auto second = [](World &world) {
        auto added = world.simulated.add({QStringLiteral("XM430-W350"), -1, 1'000'000, 2});
        QVERIFY(added);
        QCOMPARE((*added)->write(u"Profile Velocity", 5555), DeviceError::None);
        QCOMPARE((*added)->write(u"Profile Acceleration", 555), DeviceError::None);
    };
    const char *group = "= DamagedCrc =";
    return {{.name = QStringLiteral("two under the middle's ID"),
             .faults = {},
             .cells = {{"Ping, Write, commands", 0, "="},
                       {"Read", 2, "DamagedCrc"},
                       {"Broadcast Ping", 0, "= = ="},
                       {"chained, fast", 2, group},
                       {"unanswered", 0, "."}},
             .prepare = second}};
}

} // namespace

/// Valid answers that aren't those asked for: of another ID, another length, twice, by two devices at once.
class TestFaultMatrixIdentity : public QObject
{
    Q_OBJECT

private slots:
    void initTestCase()
    {
        for (const auto &family : {wrongIds(), strays(), lengths(), twice(), duplicates()})
            m_cases.insert(m_cases.end(), family.begin(), family.end());
    }

    void exchange_data() { addRows(m_cases); }

    void exchange()
    {
        QFETCH(int, number);
        QFETCH(int, request);
        run(m_catalog, m_cases.at(static_cast<std::size_t>(number)), static_cast<Kind>(request));
    }

    /// A refusal is an answer: no retry, no data, and nobody behind it is lost. An Alert beside a value is none.
    void refusals()
    {
        World world(m_catalog, 0us);
        const std::vector<std::uint8_t> ids{1, 2, 3};
        const Request requests[] = {readRequest({2, 2000, 4}), writeRequest({2, 0, {1, 2}}), actionRequest(2),
                                    syncReadRequest(2000, 4, ids, false), syncReadRequest(2000, 4, ids, true)};
        for (const Request &request : requests) {
            const auto result = world.bus->exchange(request);
            QVERIFY(result);
            QCOMPARE(result->seen.retries, 0);
            QCOMPARE(result->replies.size(), request.replies.size());
            for (const Result<Reply> &reply : result->replies) {
                QVERIFY(!reply);
                QCOMPARE(reply.error().kind, ErrorKind::Refused);
            }
        }
        world.servo(2).setHardwareError(0x01);
        const std::vector<Span> spans{{1, 112, 4}, {2, 112, 4}};
        for (const bool fast : {false, true}) {
            const auto read = world.bus->exchange(bulkReadRequest(spans, fast));
            QVERIFY(read && read->replies[0] && read->replies[1]);
            QVERIFY(!read->replies[0]->alert && read->replies[1]->alert);
            QCOMPARE(read->replies[1]->data.size(), std::size_t(4));
        }
    }

private:
    const Catalog m_catalog = test::builtInCatalog();
    std::vector<Case> m_cases;
};

DYNASCOPE_CORE_TEST(TestFaultMatrixIdentity)
#include "tst_faultmatrix_identity.moc"
