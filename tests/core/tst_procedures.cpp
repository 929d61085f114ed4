// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/procedures/procedures.h"
#include "tests/support/builtincatalog.h"
#include "tests/support/fakeservos.h"
#include "tests/support/oracle.h"
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

    /// Nobody answered a Ping there at another rate; what is under way of that is nobody's answer at this one.
    void aPingMissedBeforeTakesNoPlace()
    {
        VirtualBus wire(m_catalog, QStringLiteral("XM430-W350@57600:1"));
        QVERIFY(wire.bus->setBaudRate(1000000));
        QVERIFY(!ping(*wire.bus, 7));
        QVERIFY(wire.bus->setBaudRate(57600));
        DirectContext context(*wire.bus);
        const auto found = changeId(context, {place(1), 7, IdRegister, false});
        QVERIFY2(found, found ? "" : qPrintable(found.error().text));
        QCOMPARE(found->id, 7);
    }

    void whatIsHeardAtTheNewPlace_data()
    {
        QTest::addColumn<Bytes>("heard");
        QTest::addColumn<int>("times"); // of the Pings there; then silence
        QTest::addColumn<QString>("refusal");
        const Bytes stray = oracle::status(9, 0, {0xFC, 3, 45});
        Bytes damaged = oracle::status(7, 0, {0xFC, 3, 45});
        damaged[9] ^= 1;
        const QString taken
            = QStringLiteral("ID 7 at 57600 bps is taken: something answers there; nothing was written");
        const QString another = QStringLiteral("device 7 did not answer, but device 9 did");
        QTest::newRow("nothing") << Bytes() << 0 << QString();
        QTest::newRow("somebody") << oracle::status(7, 0, {0xFC, 3, 45}) << 99 << taken;
        QTest::newRow("damaged") << damaged << 99 << taken;
        QTest::newRow("noise") << Bytes{1, 2, 3, 4} << 99 << taken;
        QTest::newRow("another one, once") << stray << 3 << QString(); // with its repetitions
        QTest::newRow("another one, always") << stray << 99 << another;
    }

    /// Taken is what an answer, damage or noise says; another's answer doesn't.
    void whatIsHeardAtTheNewPlace()
    {
        QFETCH(Bytes, heard);
        QFETCH(int, times);
        QFETCH(QString, refusal);
        FakeLine line(57600);
        FakeServos devices(line);
        devices.servos[1].baudRate = 57600;
        int writes = 0;
        bool hasMoved = false;
        line.handler = [&](const Bytes &request) -> FakeLine::Answer {
            if (request[7] == 3) {
                ++writes;
                hasMoved = true;
                return {{FakeLine::DefaultDelay, oracle::status(1, 0, {})}};
            }
            if (request[4] == 7 && !hasMoved)
                return times-- > 0 ? FakeLine::Answer{{FakeLine::DefaultDelay, heard}} : FakeLine::Answer{};
            if (hasMoved)
                return {{FakeLine::DefaultDelay, oracle::status(request[4], 0, {0xFC, 3, 45})}};
            return devices.answer(request);
        };
        Bus bus(line);
        DirectContext context(bus);
        const auto found = changeId(context, {place(1), 7, IdRegister, false});
        const QString text = found ? QString() : found.error().text;
        QVERIFY2(refusal.isEmpty() ? text.isEmpty() : text.startsWith(refusal), qPrintable(text));
        QVERIFY(found || text.endsWith(QStringLiteral("nothing was written")));
        QCOMPARE(writes, refusal.isEmpty() ? 1 : 0);
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
        const WriteFieldPlan plan{place(1), {1, 116, {0x00, 0x04, 0, 0}}, {{1, 112, 4}}, false};
        const auto written = writeField(context, plan);
        QVERIFY2(written, written ? "" : qPrintable(written.error().text));
        const auto &values = written->after;
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
    const Catalog m_catalog = test::builtInCatalog();
};

DYNASCOPE_CORE_TEST(TestProcedures)
#include "tst_procedures.moc"
