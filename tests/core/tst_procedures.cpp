// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/procedures/procedures.h"
#include "tests/support/sessionfixture.h"
#include "tests/support/testmain.h"

using namespace dynascope;

namespace {

constexpr std::uint16_t TorqueEnable = 64;
constexpr std::uint16_t IdRegister = 7;
constexpr std::uint16_t BaudRegister = 8;

DevicePlace place(std::uint8_t id, int baud = 57600)
{
    return {id, baud, 1020, TorqueEnable, QStringLiteral("XM430-W350 #%1").arg(id)};
}

} // namespace

/// Procedures against simulated servos in virtual time.
class TestProcedures : public QObject
{
    Q_OBJECT

private slots:
    void initTestCase()
    {
        auto catalog = Catalog::builtIn();
        QVERIFY2(catalog, catalog ? "" : qPrintable(catalog.error().text));
        m_catalog = std::move(*catalog);
    }

    void changesAnId()
    {
        VirtualBus wire(m_catalog, QStringLiteral("XM430-W350@57600:1,XM430-W350@57600:2"));
        DirectContext context(*wire.bus);
        const auto found = changeId(context, {place(1), 7, IdRegister, false});
        QVERIFY2(found, found ? "" : qPrintable(found.error().text));
        QCOMPARE(found->id, 7);
        QCOMPARE(found->modelNumber, 1020);
        QVERIFY(context.wasExclusive);
        QVERIFY(ping(*wire.bus, 7));
        QCOMPARE(ping(*wire.bus, 1).error().kind, ErrorKind::NothingReceived);
        QVERIFY(ping(*wire.bus, 2));
    }

    void refusesATakenId()
    {
        VirtualBus wire(m_catalog, QStringLiteral("XM430-W350@57600:1,XL430-W250@57600:2"));
        wire.simulated.setLogging(true);
        DirectContext context(*wire.bus);
        const auto found = changeId(context, {place(1), 2, IdRegister, true});
        QVERIFY(!found);
        QCOMPARE(found.error().text,
                 QStringLiteral("ID 2 at 57600 bps is taken: something answers there; nothing was written"));
        for (const sim::WireEntry &entry : wire.simulated.log()) {
            if (entry.fromController)
                QVERIFY(entry.bytes[7] != 0x03);
        }
        QVERIFY(ping(*wire.bus, 1));
    }

    void aTorqueHeldEeprom_data()
    {
        QTest::addColumn<bool>("mayTurnOff");
        QTest::newRow("refused unless it may be turned off") << false;
        QTest::newRow("turned off where it may be") << true;
    }
    void aTorqueHeldEeprom()
    {
        QFETCH(bool, mayTurnOff);
        VirtualBus wire(m_catalog, QStringLiteral("XM430-W350@57600:1"));
        QVERIFY(write(*wire.bus, {1, TorqueEnable, {1}}));
        DirectContext context(*wire.bus);
        const auto found = changeId(context, {place(1), 3, IdRegister, mayTurnOff});
        QCOMPARE(found.has_value(), mayTurnOff);
        const std::uint8_t now = mayTurnOff ? 3 : 1;
        const auto torque = read(*wire.bus, {now, TorqueEnable, 1});
        QVERIFY(torque);
        QCOMPARE(int(torque->data[0]), mayTurnOff ? 0 : 1);
        if (!mayTurnOff)
            QVERIFY(found.error().text.contains(QStringLiteral("under torque")));
    }

    void changesABaudRate()
    {
        VirtualBus wire(m_catalog, QStringLiteral("XM430-W350@57600:1,XM430-W350@57600:2"));
        DirectContext context(*wire.bus);
        const auto found = changeBaud(context, {place(1), 1000000, 3, BaudRegister, false});
        QVERIFY2(found, found ? "" : qPrintable(found.error().text));
        QCOMPARE(found->baudRate, 1000000);
        QCOMPARE(wire.line->baudRate(), 57600); // the line came back
        QVERIFY(ping(*wire.bus, 2));
        QVERIFY(!ping(*wire.bus, 1));
        QVERIFY(wire.bus->setBaudRate(1000000));
        QVERIFY(ping(*wire.bus, 1));
    }

    void refusesABaudThePortCannotDo()
    {
        VirtualBus wire(m_catalog, QStringLiteral("XM430-W350@57600:1"));
        wire.line->refuseBaudRate(4500000);
        DirectContext context(*wire.bus);
        const auto found = changeBaud(context, {place(1), 4500000, 7, BaudRegister, true});
        QVERIFY(!found);
        QCOMPARE(found.error().kind, ErrorKind::PortUnsuitable);
        QVERIFY(found.error().text.endsWith(QStringLiteral("nothing was written")));
        QCOMPARE(wire.line->baudRate(), 57600);
        QVERIFY(ping(*wire.bus, 1));
    }

    void refusesABaudWhereTheIdIsTaken()
    {
        VirtualBus wire(m_catalog, QStringLiteral("XM430-W350@57600:1,XM430-W350@1000000:1"));
        DirectContext context(*wire.bus);
        const auto found = changeBaud(context, {place(1), 1000000, 3, BaudRegister, false});
        QVERIFY(!found);
        QVERIFY(found.error().text.startsWith(QStringLiteral("ID 1 at 1000000 bps is taken")));
        QVERIFY(ping(*wire.bus, 1));
    }

    void resetsToFactory()
    {
        VirtualBus wire(m_catalog, QStringLiteral("XM430-W350@1000000:5"), 1000000);
        DirectContext context(*wire.bus);
        const DevicePlace after = place(1);
        const auto sent = resetToFactory(context, {place(5, 1000000), ResetOption::All, after});
        QVERIFY2(sent, sent ? "" : qPrintable(sent.error().text));
        wire.line->advance(std::chrono::seconds(1));
        const auto found = look(context, after);
        QVERIFY2(found, found ? "" : qPrintable(found.error().text));
        QCOMPARE(found->baudRate, 57600);
        QCOMPARE(wire.line->baudRate(), 1000000);
    }

    void refusesAResetOntoAnother()
    {
        VirtualBus wire(m_catalog, QStringLiteral("XM430-W350@1000000:5,XL430-W250@57600:1"), 1000000);
        DirectContext context(*wire.bus);
        const auto sent = resetToFactory(context, {place(5, 1000000), ResetOption::All, place(1)});
        QVERIFY(!sent);
        QVERIFY(sent.error().text.endsWith(QStringLiteral("nothing was written")));
        QVERIFY(ping(*wire.bus, 5));
    }

    void aWriteIsReadBackWithWhatItMoved()
    {
        VirtualBus wire(m_catalog, QStringLiteral("XM430-W350@57600:1"));
        DirectContext context(*wire.bus);
        const WriteFieldPlan plan{place(1), {1, 116, {0x00, 0x04, 0, 0}}, {{1, 112, 4}}};
        const auto values = writeField(context, plan);
        QVERIFY2(values, values ? "" : qPrintable(values.error().text));
        QCOMPARE(values->size(), std::size_t(2));
        QCOMPARE(values->front().data, Bytes({0x00, 0x04, 0, 0}));
        QCOMPARE(int(values->back().address), 112);
    }

    void stopEndsAChangeBeforeItsWrite()
    {
        VirtualBus wire(m_catalog, QStringLiteral("XM430-W350@57600:1"));
        DirectContext context(*wire.bus);
        context.atCheckpoint = [&wire]() -> Result<void> {
            wire.stop = true;
            return failure(ErrorKind::Stopped, QStringLiteral("stopped"));
        };
        const auto found = changeId(context, {place(1), 9, IdRegister, false});
        QVERIFY(!found);
        QCOMPARE(found.error().kind, ErrorKind::Stopped);
        wire.stop = false;
        QVERIFY(ping(*wire.bus, 1));
    }

    void aLostPortIsSaid()
    {
        VirtualBus wire(m_catalog, QStringLiteral("XM430-W350@57600:1"));
        wire.line->unplug();
        DirectContext context(*wire.bus);
        const auto values = readSpans(context, {place(1), {{1, 64, 4}}});
        QVERIFY(!values);
        QCOMPARE(values.error().kind, ErrorKind::PortLost);
    }

private:
    Catalog m_catalog;
};

DYNASCOPE_CORE_TEST(TestProcedures)
#include "tst_procedures.moc"
