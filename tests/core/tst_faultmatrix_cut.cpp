// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/table/catalog.h"
#include "tests/support/builtincatalog.h"
#include "tests/support/faultmatrix.h"
#include "tests/support/testmain.h"

using namespace faultmatrix;

namespace {

constexpr const char *Places[] = {"first", "middle", "last"};
constexpr const char *Found[] = {"- = =", "= - =", "= = -"};
constexpr int LongestReply = 16; ///< of one device, of all requests here

/// What is seen of an answer of which so many bytes came: FF FF FD 00 make a header.
const char *seen(int bytes)
{
    return bytes == 0 ? "NothingReceived" : bytes < 4 ? "NoHeader" : "CutOff";
}

/// The first `bytes` of `id`'s answer come, once.
Case cutOnce(int id, int bytes, bool atAdapter)
{
    const QString where = atAdapter ? QStringLiteral(" at the adapter") : QString();
    return {.name = QStringLiteral("%1 cut after %2%3").arg(QString::fromLatin1(Places[id - 1])).arg(bytes).arg(where),
            .faults = {.replies = {{.kind = Fault::Cut, .id = id, .amount = bytes, .atAdapter = atAdapter}}},
            .cells = {{"idempotent", 1, "="},
                      {"commands", 0, seen(bytes)},
                      {"Broadcast Ping", 0, Found[id - 1]},
                      {"chained, fast", 1, "= = ="},
                      {"unanswered", 0, "."}},
            .target = id};
}

/// Always: it alone is lost, the others are read, and it is the one that is blamed.
Case cutAlways(int id, int bytes)
{
    Case one = cutOnce(id, bytes, false);
    const char *groups[] = {"CutOff = =", "= CutOff =", "= = CutOff"};
    one.name += QStringLiteral(" always");
    one.faults.replies.front().times = -1;
    one.cells = {{"idempotent", 2, "CutOff"},
                 {"commands", 0, "CutOff"},
                 {"Broadcast Ping", 0, Found[id - 1]},
                 {"chained, fast", 2, groups[id - 1]},
                 {"unanswered", 0, "."}};
    return one;
}

/// Pulled out: the whole exchange ends at once, and nothing is sent again.
Case unplugged(const QString &name, const sim::LineFaults &faults, bool answers)
{
    Case one{.name = name,
             .faults = faults,
             .cells = {{"unicast, Broadcast Ping, chained, fast", 0, "!PortLost"}},
             .settle = 1s}; // nobody plugs it in again sooner
    one.cells.push_back({"unanswered", 0, answers ? "." : "!PortLost"});
    return one;
}

} // namespace

/// Truncation and unplugging at every byte of every request and answer.
class TestFaultMatrixCut : public QObject
{
    Q_OBJECT

private slots:
    /// One row each request and place; every byte within.
    void answerCut_data()
    {
        QTest::addColumn<int>("id");
        QTest::addColumn<bool>("atAdapter");
        QTest::addColumn<int>("request");
        for (int id = 1; id <= 3; ++id) {
            for (const bool atAdapter : {false, true}) {
                for (const Kind kind : kindsOf("all")) {
                    const char *where = atAdapter ? "at the adapter" : "on the wire";
                    QTest::addRow("%s, %s: %s", Places[id - 1], where, qPrintable(nameOf(kind)))
                        << id << atAdapter << static_cast<int>(kind);
                }
            }
        }
    }

    void answerCut()
    {
        QFETCH(int, id);
        QFETCH(bool, atAdapter);
        QFETCH(int, request);
        const auto kind = static_cast<Kind>(request);
        const int size = std::min(LongestReply, static_cast<int>(replySize(kind, id)));
        for (int bytes = 0; bytes < size; ++bytes) {
            run(m_catalog, cutOnce(id, bytes, atAdapter), kind);
            QVERIFY2(!QTest::currentTestFailed(), qPrintable(QStringLiteral("after %1 bytes").arg(bytes)));
        }
    }

    void answerAlwaysCut_data()
    {
        m_cases.clear();
        for (int id = 1; id <= 3; ++id)
            m_cases.push_back(cutAlways(id, 5));
        addRows(m_cases);
    }

    void answerAlwaysCut()
    {
        QFETCH(int, number);
        QFETCH(int, request);
        run(m_catalog, m_cases.at(static_cast<std::size_t>(number)), static_cast<Kind>(request));
    }

    void requestUnplugged_data() { addKinds(); }

    void requestUnplugged()
    {
        QFETCH(int, request);
        const auto kind = static_cast<Kind>(request);
        const auto size = static_cast<int>(requestSize(kind, 2));
        for (int byte = 0; byte < size; ++byte) {
            run(m_catalog, unplugged(QStringLiteral("request"), {.unplugAtSent = byte}, false), kind);
            QVERIFY2(!QTest::currentTestFailed(), qPrintable(QStringLiteral("at byte %1").arg(byte)));
        }
    }

    void answerUnplugged_data() { addKinds(); }

    void answerUnplugged()
    {
        QFETCH(int, request);
        const auto kind = static_cast<Kind>(request);
        const auto size = static_cast<int>(allRepliesSize(kind, 2));
        for (int byte = 0; byte < std::max(1, size); ++byte) {
            run(m_catalog, unplugged(QStringLiteral("answer"), {.unplugAtAnswered = byte}, true), kind);
            QVERIFY2(!QTest::currentTestFailed(), qPrintable(QStringLiteral("at byte %1").arg(byte)));
        }
    }

    /// Noticed at once, not at the deadline.
    void unpluggedIsNoticedAtOnce()
    {
        for (const Kind kind : kindsOf("all")) {
            World world(m_catalog, 0us);
            world.simulated.setFaults({.unplugAtSent = 5});
            const LineTime begin = world.line->now();
            QCOMPARE(outcomeOf(world, kind, 2), QStringLiteral("0 retries: !PortLost"));
            QCOMPARE(world.line->now() - begin, LineTime(50us));
            QVERIFY(world.bus->lost());
            QCOMPARE(outcomeOf(world, kind, 2), QStringLiteral("0 retries: !PortLost"));
            QCOMPARE(world.line->now() - begin, LineTime(50us));
        }
    }

private:
    void addKinds()
    {
        QTest::addColumn<int>("request");
        for (const Kind kind : kindsOf("all"))
            QTest::newRow(qPrintable(nameOf(kind))) << static_cast<int>(kind);
    }

    const Catalog m_catalog = test::builtInCatalog();
    std::vector<Case> m_cases;
};

DYNASCOPE_CORE_TEST(TestFaultMatrixCut)
#include "tst_faultmatrix_cut.moc"
