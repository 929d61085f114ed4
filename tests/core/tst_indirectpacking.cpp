// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/bus.h"
#include "core/session/indirectpacking.h"
#include "core/sim/servo.h"
#include "core/sim/simulatedbus.h"
#include "core/sim/simulatedline.h"
#include "core/table/indirect.h"
#include "tests/support/builtincatalog.h"
#include "tests/support/testmain.h"

#include <algorithm>
#include <map>

using namespace dynascope;

/// Scattered registers, seen as one stretch.
class TestIndirectPacking : public QObject
{
    Q_OBJECT

    const Catalog m_catalog = test::builtInCatalog();
    ControlTablePtr m_table;

    int at(const char *name) const { return m_table->indexOf(QString::fromLatin1(name)); }
    const Field &field(int index) const { return m_table->fields()[std::size_t(index)]; }
    /// Of a fresh servo, but for these.
    std::function<std::optional<std::int64_t>(int)> fresh(const std::map<int, std::int64_t> &but = {}) const
    {
        return [this, but](int index) {
            const auto other = but.find(index);
            return other == but.end() ? field(index).initial : std::optional(other->second);
        };
    }

private slots:
    void init()
    {
        m_table = m_catalog.find(1020, 45);
        QVERIFY(m_table);
    }

    void threeRegistersInOneStretch()
    {
        const std::vector<int> wanted{at("Present Temperature"), at("Goal Position"), at("Torque Enable")};
        const auto packing = packIndirect(*m_table, wanted, fresh());
        QVERIFY2(packing, packing ? "" : qPrintable(packing.error().text));
        QCOMPARE(packing->length, std::uint16_t(1 + 4 + 1));
        QCOMPARE(packing->address, field(at("Indirect Data 1")).address);
        QCOMPARE(packing->addressOf(at("Torque Enable")), int(packing->address));
        QCOMPARE(packing->addressOf(at("Goal Position")), packing->address + 1);
        QCOMPARE(packing->addressOf(at("Present Temperature")), packing->address + 5);
        QCOMPARE(packing->addressOf(at("LED")), -1);
        QCOMPARE(packing->bytesSpared, 146 - 64 + 1 - 6);
        std::vector<std::int64_t> to;
        for (const IndirectPacking::Entry &entry : packing->entries) {
            QCOMPARE(entry.before, *field(entry.field).initial);
            to.push_back(entry.to);
        }
        QCOMPARE(to, (std::vector<std::int64_t>{64, 116, 117, 118, 119, 146}));
    }

    /// A servo shows there what stands in the registers, and after putting back what it showed before.
    void aServoShowsIt()
    {
        sim::SimulatedBus bus(m_catalog);
        const auto servo = bus.add({QStringLiteral("XM430-W350"), 45, 57600, 1});
        QVERIFY(servo);
        const std::vector<int> wanted{at("Present Temperature"), at("Goal PWM"), at("LED")};
        const auto packing = packIndirect(*m_table, wanted, fresh());
        QVERIFY(packing);
        for (const IndirectPacking::Entry &entry : packing->entries)
            QCOMPARE((*servo)->write(field(entry.field).name, entry.to), DeviceError::None);
        QCOMPARE((*servo)->write(u"LED", 1), DeviceError::None);
        sim::SimulatedLine line(bus);
        Bus wire(line);
        const auto read = wire.exchange(readRequest({1, packing->address, packing->length}));
        QVERIFY(read && read->replies.front());
        const ByteView data = read->replies.front()->data;
        for (const int index : wanted) {
            const auto offset = static_cast<std::size_t>(packing->addressOf(index) - packing->address);
            QCOMPARE(rawFromBytes(field(index), data.subspan(offset)), (*servo)->value(field(index).name));
        }
        QVERIFY((*servo)->value(u"Present Temperature") > 0);
        for (const IndirectPacking::Entry &entry : packing->entries)
            QCOMPARE((*servo)->write(field(entry.field).name, entry.before), DeviceError::None);
        QCOMPARE((*servo)->value(u"Indirect Address 1"), *field(at("Indirect Address 1")).initial);
    }

    void whatOthersUseIsLeftAlone()
    {
        const int third = at("Indirect Address 3");
        const auto used = fresh({{third, 132}});
        auto packing = packIndirect(*m_table, {at("Torque Enable"), at("LED")}, used); // there is room before it
        QVERIFY(packing);
        QCOMPARE(packing->address, field(at("Indirect Data 1")).address);
        packing = packIndirect(*m_table, {at("Present Position")}, used);
        QVERIFY(packing);
        QCOMPARE(packing->address, field(at("Indirect Data 4")).address);
        packing = packIndirect(*m_table, {at("Present Position")}, used, UsedEntries::Take);
        QVERIFY(packing);
        QCOMPARE(packing->address, field(at("Indirect Data 1")).address);
        QCOMPARE(packing->entries[2].before, std::int64_t(132)); // to be put back
    }

    /// The two blocks stand apart: no stretch crosses from one into the other.
    void aStretchStaysInItsBlock()
    {
        std::map<int, std::int64_t> used;
        for (int number = 1; number <= 26; ++number)
            used[m_table->indexOf(QStringLiteral("Indirect Address %1").arg(number))] = 132;
        const auto packing = packIndirect(*m_table, {at("Present Position")}, fresh(used));
        QVERIFY(packing);
        QCOMPARE(packing->address, field(at("Indirect Data 29")).address);
    }

    void saysWhyNot_data()
    {
        QTest::addColumn<QStringList>("registers");
        QTest::addColumn<bool>("read");
        QTest::addColumn<QString>("why");
        QTest::newRow("EEPROM") << QStringList{QStringLiteral("ID")} << true << QStringLiteral("ID is in EEPROM");
        QTest::newRow("itself") << QStringList{QStringLiteral("Indirect Data 5")} << true
                                << QStringLiteral("the indirect block itself");
        QTest::newRow("twice") << QStringList{QStringLiteral("LED"), QStringLiteral("LED")} << true
                               << QStringLiteral("once");
        QTest::newRow("nothing") << QStringList{} << true << QStringLiteral("one at least");
        QTest::newRow("unread") << QStringList{QStringLiteral("LED")} << false << QStringLiteral("has not been read");
    }
    void saysWhyNot()
    {
        QFETCH(QStringList, registers);
        QFETCH(bool, read);
        QFETCH(QString, why);
        std::vector<int> fields;
        for (const QString &name : registers)
            fields.push_back(m_table->indexOf(name));
        const auto packing =
            packIndirect(*m_table, fields, [&](int index) { return read ? fresh()(index) : std::nullopt; });
        QVERIFY(!packing);
        QVERIFY2(packing.error().text.contains(why), qPrintable(packing.error().text));
    }

    void aModelWithoutIndirectAddresses()
    {
        const ControlTablePtr table = m_catalog.find(350, 2); // XL-320
        QVERIFY(table);
        const auto packing = packIndirect(*table, {0}, [](int) { return std::nullopt; });
        QVERIFY(!packing);
        QCOMPARE(packing.error().kind, ErrorKind::NotSupported);
    }
};

DYNASCOPE_CORE_TEST(TestIndirectPacking)
#include "tst_indirectpacking.moc"
