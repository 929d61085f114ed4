// SPDX-License-Identifier: GPL-3.0-or-later
// Every model of the library, simulated: found by a scan, read whole, one register of each kind written and read back.
#include "core/bus/operations.h"
#include "core/table/catalog.h"
#include "tests/support/builtincatalog.h"
#include "tests/support/sessionfixture.h"
#include "tests/support/testmain.h"

#include <set>

using namespace dynascope;
using namespace dynascope::test;

namespace {

constexpr int LongestRead = 200; ///< bytes at once

/// What a write to these does is more than a value in a register, and has tests of its own.
bool isSpecial(const Field &field)
{
    static const std::set<QString> names{QStringLiteral("ID"),
                                         QStringLiteral("Baud Rate"),
                                         QStringLiteral("Protocol Type"),
                                         QStringLiteral("Return Delay Time"),
                                         QStringLiteral("Status Return Level"),
                                         QStringLiteral("Torque Enable"),
                                         QStringLiteral("Operating Mode"),
                                         QStringLiteral("Control Mode"),
                                         QStringLiteral("Bus Watchdog"),
                                         QStringLiteral("Hybrid Save"),
                                         QStringLiteral("Secondary ID"),
                                         QStringLiteral("Startup Configuration")};
    return names.count(field.name) > 0 || field.name.startsWith(u"Indirect ");
}

/// Registers next to each other, as (address, length).
std::vector<std::pair<int, int>> spansOf(const ControlTable &table)
{
    std::vector<std::pair<int, int>> spans;
    for (const Field &field : table.fields()) {
        const bool follows = !spans.empty() && spans.back().first + spans.back().second == field.address;
        if (follows && spans.back().second + field.size <= LongestRead)
            spans.back().second += field.size;
        else
            spans.emplace_back(field.address, field.size);
    }
    return spans;
}

} // namespace

class TestSimLibrary : public QObject
{
    Q_OBJECT

    const Catalog m_catalog = builtInCatalog();

    std::optional<std::int64_t> rawOf(VirtualBus &virtualBus, const Field &field)
    {
        const auto reply = read(*virtualBus.bus, {1, field.address, field.size});
        return reply ? std::optional(rawFromBytes(field, reply->data)) : std::nullopt;
    }

    void writeAndReadBack(VirtualBus &virtualBus, const ControlTable &table, const Field &field)
    {
        const EffectiveField now = effective(field, [&](QStringView name) -> std::optional<std::int64_t> {
            const Field *other = table.find(name);
            return other ? rawOf(virtualBus, *other) : std::nullopt;
        });
        const std::int64_t low = now.minimum.value_or(smallestRaw(field)),
                           high = now.maximum.value_or(largestRaw(field));
        const std::optional<std::int64_t> before = rawOf(virtualBus, field);
        QVERIFY2(before, qPrintable(field.name));
        std::int64_t wanted = *before < high ? *before + 1 : *before - 1;
        for (const EnumValue &value : field.values) {
            if (value.value != *before)
                wanted = value.value;
        }
        wanted = std::clamp(wanted, low, high);
        const auto back = writeVerified(*virtualBus.bus, {1, field.address, bytesFromRaw(field, wanted)});
        QVERIFY2(back, back ? "" : qPrintable(field.name + QStringLiteral(": ") + back.error().text));
        QCOMPARE(rawFromBytes(field, *back), wanted);
    }

private slots:
    void everyModel_data()
    {
        QTest::addColumn<QString>("model");
        for (const Catalog::ModelInfo &info : m_catalog.models()) {
            if (!info.addressesOnly)
                QTest::addRow("%s", qPrintable(info.model)) << info.model;
        }
    }

    void everyModel()
    {
        QFETCH(QString, model);
        const Catalog::ModelInfo &info = *m_catalog.model(QStringView(model));
        const ControlTablePtr table = m_catalog.find(info.modelNumber, info.newestFirmware);
        VirtualBus virtualBus(m_catalog,
                              model + (table->axes() == 2 ? QStringLiteral("@57600:1+2") : QStringLiteral("@57600:1")));
        const auto found = scanBaud(*virtualBus.bus, {}, {});
        QVERIFY2(found, found ? "" : qPrintable(found.error().text));
        QCOMPARE(found->devices.size(), std::size_t(table->axes()));
        QCOMPARE(found->devices.front().modelNumber, info.modelNumber);
        QCOMPARE(int(found->devices.front().firmware), info.newestFirmware);

        for (const auto &span : spansOf(*table)) {
            const auto reply = read(
                *virtualBus.bus, {1, static_cast<std::uint16_t>(span.first), static_cast<std::uint16_t>(span.second)});
            QVERIFY2(reply, reply ? "" : qPrintable(reply.error().text));
            QCOMPARE(reply->data.size(), std::size_t(span.second));
        }
        for (const Field &field : table->fields()) {
            if (field.area == Area::Eeprom && field.initial && field.name != u"Baud Rate")
                QCOMPARE(rawOf(virtualBus, field), field.initial);
        }
        std::set<std::tuple<Area, int, bool, bool, bool>> kinds;
        for (const Field &field : table->fields()) {
            const auto kind =
                std::tuple(field.area, int(field.size), field.isSigned, field.values.empty(), field.bits.empty());
            if (!field.isWritable() || isSpecial(field) || !kinds.insert(kind).second)
                continue;
            writeAndReadBack(virtualBus, *table, field);
            if (QTest::currentTestFailed())
                return;
        }
        QVERIFY(kinds.size() > 3);
    }
};

DYNASCOPE_CORE_TEST(TestSimLibrary)
#include "tst_simlibrary.moc"
