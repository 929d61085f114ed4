// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/journal/undoplan.h"
#include "tests/support/builtincatalog.h"
#include "tests/support/sessionfixture.h"
#include "tests/support/testmain.h"

using namespace dynascope;

namespace {

constexpr std::uint16_t TorqueEnable = 64;

bool turnsTorqueOn(ByteView packet)
{
    const bool isWrite = packet[7] == static_cast<std::uint8_t>(Instruction::Write);
    return isWrite && littleEndian(packet.subspan(8), 2) == TorqueEnable && packet[10] != 0;
}

} // namespace

/// STOP in the middle of a change of ID or baud rate: session, bus thread and simulated servos in virtual time.
class TestProceduresStop : public QObject
{
    Q_OBJECT

private slots:
    void stopAtEveryPacket_data()
    {
        QTest::addColumn<bool>("isBaud");
        QTest::addColumn<int>("again"); ///< so many packets later STOP is pressed once more
        for (const int again : {0, 1, 3, 6, 9, 12, 16}) {
            QTest::addRow("ID, again after %d", again) << false << again;
            QTest::addRow("baud rate, again after %d", again) << true << again;
        }
    }
    void stopAtEveryPacket()
    {
        QFETCH(bool, isBaud);
        QFETCH(int, again);
        bool movedOnce = false;
        bool stayedOnce = false;
        for (int at = 1; at < 100; ++at) {
            Outcome outcome;
            stopAt(at, again, isBaud, outcome);
            if (QTest::currentTestFailed()) {
                qInfo("with STOP at packet %d", at);
                return;
            }
            if (!outcome.wasStopped) {
                QVERIFY(movedOnce && stayedOnce);
                return;
            }
            (outcome.moved ? movedOnce : stayedOnce) = true;
        }
        QFAIL("the change never came to its end");
    }

    void whoWentIsNotWaitedFor()
    {
        VirtualSession all(m_catalog, QStringLiteral("XM430-W350@57600:1"));
        all.open(57600);
        const DeviceKey gone = all.line->heard({9, 57600, 1020, 45, false, {}}).key(); // was unplugged
        all.stop.press();
        QVERIFY(all.stop.isVerifying());
        QVERIFY(VirtualSession::waitFor([&] { return !all.stop.isVerifying(); }));
        QVERIFY(!all.stop.isConfirmed());
        QCOMPARE(all.stop.report(),
                 QStringLiteral("Torque is off on one device. Not confirmed: XM430-W350 #9."));
        all.line->forget(gone);
        QVERIFY(VirtualSession::waitFor([&] { return all.stop.report().endsWith(QStringLiteral("on one device.")); }));
        QVERIFY(all.stop.isConfirmed());
        all.stop.release();
        all.stop.press();
        QVERIFY(all.stop.isVerifying());
        all.close();
        QVERIFY(!all.stop.isVerifying());
        QCOMPARE(all.stop.report(), QStringLiteral("No device confirmed that its torque is off."));
    }

private:
    struct Outcome {
        bool wasStopped = false; ///< the change itself, not only what came after it
        bool moved = false;
    };

    void stopAt(int at, int again, bool isBaud, Outcome &outcome)
    {
        Journal journal;
        VirtualSession all(m_catalog, QStringLiteral("XM430-W350@57600:1,XM430-W350@57600:2"), &journal);
        for (const auto &servo : all.factory.simulated.servos())
            servo->write(u"Torque Enable", 1);
        std::atomic<bool> pressed = false;
        std::atomic<bool> turnedOn = false;
        all.factory.onPacket = [&](int count, ByteView packet) {
            if (pressed && turnsTorqueOn(packet))
                turnedOn = true;
            if (count != at && (again == 0 || count != at + again))
                return;
            // Just here, with the packet in flight.
            QMetaObject::invokeMethod(&all.stop, [&all] { all.stop.press(); }, Qt::BlockingQueuedConnection);
            pressed = true;
        };
        all.open(57600);
        Device &device = *all.line->deviceAt(1, 57600);
        std::optional<Result<void>> change;
        std::optional<Result<void>> torqueOn;
        const auto done = [&](const Result<void> &result) { change = result; };
        if (isBaud)
            all.commands.changeBaud(device, 1000000, true, done);
        else
            all.commands.changeId(device, 7, true, done);
        all.commands.setTorque({&device}, true, [&](const Result<void> &result) { torqueOn = result; });
        QVERIFY(VirtualSession::waitFor([&] { return change && torqueOn; }));
        if (*change && !pressed) {
            all.close();
            return;
        }
        QVERIFY2(VirtualSession::waitFor([&] { return all.stop.isConfirmed(); }), qPrintable(all.stop.report()));
        outcome.wasStopped = !*change;
        const QString said = *change ? QString() : change->error().text;
        const std::uint8_t id = device.id();
        const int baud = device.baudRate();
        QVERIFY(device.raw(u"Torque Enable") == 0);
        all.close();

        const sim::Servo *servo = all.factory.simulated.servo(id, baud);
        QVERIFY2(servo && servo != all.factory.simulated.servo(2, 57600), qPrintable(said));
        outcome.moved = id == 7 || baud == 1000000;
        if (outcome.wasStopped) {
            QCOMPARE(change->error().kind, ErrorKind::Stopped);
            const auto expected = QStringLiteral("STOP ended the change: XM430-W350 #1 is at ID %1, %2 bps");
            QCOMPARE(said, expected.arg(id).arg(baud));
            QVERIFY(!*torqueOn);
        }
        QVERIFY(!turnedOn);
        QCOMPARE(placeNow(journal.entries(), journal.entries().front()), (JournalPlace{id, baud})); // undo follows it
        for (const auto &each : all.factory.simulated.servos())
            QCOMPARE(int(each->value(u"Torque Enable")), 0);
    }

    const Catalog m_catalog = test::builtInCatalog();
};

DYNASCOPE_CORE_TEST(TestProceduresStop)
#include "tst_procedures_stop.moc"
