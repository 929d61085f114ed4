// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/table/catalog.h"
#include "tests/support/builtincatalog.h"
#include "tests/support/faultmatrix.h"
#include "tests/support/testmain.h"

using namespace faultmatrix;
using sim::Damage;
using sim::PacketPart;

namespace {

constexpr const char *Found[] = {"- = =", "= - =", "= = -"};
constexpr const char *Places[] = {"first", "middle", "last"};

/// `id`'s answer comes damaged once. `command`: what was seen where nothing may be asked again.
Case damagedOnce(const char *name, int id, const Damage &damage, const char *command)
{
    Case one{.name =
                 QStringLiteral("%1's %2 damaged").arg(QString::fromLatin1(Places[id - 1]), QString::fromLatin1(name)),
             .faults = {.replies = {{.kind = Fault::Damaged, .id = id, .damage = damage}}},
             .cells = commandsSeeing(command),
             .target = id};
    one.cells.insert(one.cells.end(), {{"idempotent", 1, "="},
                                       {"Broadcast Ping", 0, Found[id - 1]},
                                       {"chained, fast", 1, "= = ="},
                                       {"unanswered", 0, "."}});
    return one;
}

std::vector<Case> onTheWire()
{
    std::vector<Case> cases;
    for (int id = 1; id <= 3; ++id) {
        cases.push_back(damagedOnce("ID", id, {PacketPart::Id, 1, 0, 4}, "DamagedCrc"));
        cases.push_back(damagedOnce("ID, then another's that was asked,", id, {PacketPart::Id, 1, 0, 0}, "DamagedCrc"));
        cases.push_back(damagedOnce("ERR", id, {PacketPart::Error, 1, 0, 7}, "DamagedCrc"));
        cases.push_back(damagedOnce("CRC", id, {PacketPart::Crc, 1, 0, 3}, "DamagedCrc"));
        cases.push_back(damagedOnce("CRC (burst of 16)", id, {PacketPart::Crc, 1, 16}, "DamagedCrc"));
        cases.push_back(damagedOnce("CRC (3 bits)", id, {PacketPart::Crc, 3}, "DamagedCrc"));
    }
    return cases;
}

/// Parts that not every answer has. A status without data can't be damaged there; of a fast reply the first device
/// alone sends header, LEN and instruction.
std::vector<Case> partsOfSome()
{
    std::vector<Case> cases;
    for (int id = 1; id <= 3; ++id) {
        Case data = damagedOnce("data", id, {PacketPart::Data, 1, 0, 5}, "=");
        data.cells = {{"Ping, Read", 1, "="},
                      {"Write, commands", 0, "="},
                      {"Broadcast Ping", 0, Found[id - 1]},
                      {"chained, fast", 1, "= = ="},
                      {"unanswered", 0, "."}};
        cases.push_back(data);
        const char *fast = id == 1 ? "chained, fast" : "chained";
        const char *healthyFast = id == 1 ? nullptr : "fast";
        // LEN is 4 in a status without data: bit 2 makes it 0, bit 4 makes it 20, which no more bytes come for.
        const std::tuple<const char *, Damage, const char *> lengths[] = {
            {"header", {PacketPart::Header, 1, 0, 12}, "NoHeader"},
            {"LEN (below the least)", {PacketPart::Length, 1, 0, 2}, "NoHeader"},
            {"LEN (more than comes)", {PacketPart::Length, 1, 0, 4}, "CutOff"},
            {"LEN (absurd)", {PacketPart::Length, 1, 0, 15}, "NoHeader"},
            {"instruction", {PacketPart::Instruction, 1, 0, 1}, "DamagedCrc"},
        };
        for (const auto &[name, damage, command] : lengths) {
            Case one = damagedOnce(name, id, damage, command);
            one.cells = commandsSeeing(command);
            one.cells.insert(one.cells.end(), {{"idempotent", 1, "="},
                                               {"Broadcast Ping", 0, Found[id - 1]},
                                               {fast, 1, "= = ="},
                                               {"unanswered", 0, "."}});
            if (healthyFast)
                one.cells.push_back({healthyFast, 0, "= = ="});
            cases.push_back(one);
        }
    }
    return cases;
}

/// Every answer of `id` comes damaged: it alone is lost, the others are read, and it is the one that is blamed.
std::vector<Case> always()
{
    std::vector<Case> cases;
    const char *groups[] = {"DamagedCrc = =", "= DamagedCrc =", "= = DamagedCrc"};
    for (int id = 1; id <= 3; ++id) {
        for (const bool atAdapter : {false, true}) {
            Case one = damagedOnce(atAdapter ? "CRC, always, at the adapter," : "CRC, always,", id,
                                   {PacketPart::Crc, 1, 0, 3}, "DamagedCrc");
            one.faults.replies.front().times = -1;
            one.faults.replies.front().atAdapter = atAdapter;
            one.cells = commandsSeeing("DamagedCrc");
            one.cells.insert(one.cells.end(), {{"idempotent", 2, "DamagedCrc"},
                                               {"Broadcast Ping", 0, Found[id - 1]},
                                               {"chained, fast", 2, groups[id - 1]},
                                               {"unanswered", 0, "."}});
            cases.push_back(one);
        }
    }
    return cases;
}

} // namespace

/// Answers that come, but not as they were sent.
class TestFaultMatrixDamage : public QObject
{
    Q_OBJECT

private slots:
    void initTestCase()
    {
        for (const auto &family : {onTheWire(), partsOfSome(), always()})
            m_cases.insert(m_cases.end(), family.begin(), family.end());
    }

    void exchange_data() { addRows(m_cases); }

    void exchange()
    {
        QFETCH(int, number);
        QFETCH(int, request);
        run(m_catalog, m_cases.at(static_cast<std::size_t>(number)), static_cast<Kind>(request));
    }

    /// Whoever babbles can't hold an exchange longer than its deadline.
    void aBabbler()
    {
        Bytes packets;
        while (packets.size() < 20000) { // 0.2 s of damaged answers
            const Bytes packet = encode(StatusPacket{2, DeviceError::None, false, {}});
            packets.insert(packets.end(), packet.begin(), packet.end() - 1);
            packets.push_back(static_cast<std::uint8_t>(~packet.back()));
        }
        World world(m_catalog, 0us);
        world.simulated.setFaults({.replies = {{.kind = Fault::NoiseBefore, .noise = packets}}});
        const QString outcome = outcomeOf(world, Kind::Read, 2);
        QCOMPARE(outcome, QStringLiteral("2 retries: DamagedCrc"));
    }

    /// Any three bits or any burst of 16 bits, anywhere in the answer: what may be asked again is, and is right.
    void anywhere_data()
    {
        QTest::addColumn<Damage>("damage");
        QTest::newRow("1 bit") << Damage{};
        QTest::newRow("2 bits") << Damage{PacketPart::Any, 2};
        QTest::newRow("3 bits") << Damage{PacketPart::Any, 3};
        QTest::newRow("a burst of 16") << Damage{PacketPart::Any, 1, 16};
    }

    void anywhere()
    {
        QFETCH(Damage, damage);
        for (std::uint64_t seed = 1; seed <= 40; ++seed) {
            for (const Kind kind : kindsOf("idempotent, chained, fast")) {
                World world(m_catalog, 0us);
                world.simulated.setFaults(
                    {.seed = seed, .replies = {{.kind = Fault::Damaged, .id = 2, .damage = damage}}});
                const QString outcome = outcomeOf(world, kind, 2);
                const bool isGroup = kind >= Kind::SyncRead;
                const QString right = isGroup ? QStringLiteral("1 retries: = = =") : QStringLiteral("1 retries: =");
                QVERIFY2(outcome == right,
                         qPrintable(QStringLiteral("seed %1, %2: %3").arg(seed).arg(nameOf(kind), outcome)));
            }
        }
    }

private:
    const Catalog m_catalog = test::builtInCatalog();
    std::vector<Case> m_cases;
};

DYNASCOPE_CORE_TEST(TestFaultMatrixDamage)
#include "tst_faultmatrix_damage.moc"
