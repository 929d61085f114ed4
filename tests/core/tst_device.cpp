// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/device.h"
#include "tests/support/testmain.h"

#include <QSignalSpy>

using namespace dynascope;

namespace {

ControlTablePtr smallTable()
{
    ControlTable::Description description;
    description.modelNumber = 1020;
    description.model = QStringLiteral("XM430-W350");
    description.fastReadsFrom = 45;
    description.receiveBuffer = 512;
    const auto field = [&description](int address, int size, const char *name, Area area, Access access) {
        Field added;
        added.address = static_cast<std::uint16_t>(address);
        added.size = static_cast<std::uint8_t>(size);
        added.name = QString::fromLatin1(name);
        added.area = area;
        added.access = access;
        description.fields.push_back(added);
    };
    field(7, 1, "ID", Area::Eeprom, Access::ReadWrite);
    field(9, 1, "Return Delay Time", Area::Eeprom, Access::ReadWrite);
    field(64, 1, "Torque Enable", Area::Ram, Access::ReadWrite);
    field(116, 4, "Goal Position", Area::Ram, Access::ReadWrite);
    field(132, 4, "Present Position", Area::Ram, Access::Read);
    description.fields.back().isSigned = true;
    return std::make_shared<const ControlTable>(description);
}

PollValue bytesAt(int address, Bytes data, int milliseconds = 1)
{
    PollValue value;
    value.address = static_cast<std::uint16_t>(address);
    value.length = static_cast<std::uint16_t>(data.size());
    value.data = std::move(data);
    value.at = std::chrono::milliseconds(milliseconds);
    return value;
}

const Found Servo{3, 57600, 1020, 45, false, {}};

} // namespace

class TestDevice : public QObject
{
    Q_OBJECT

private slots:
    void takesWholeFieldsOnly()
    {
        Device device(1, nullptr, smallTable(), Servo);
        QSignalSpy changes(&device, &Device::fieldsChanged);
        device.take(bytesAt(130, {0, 0, 0x00, 0x08, 0, 0})); // two bytes before, all of Present Position
        QCOMPARE(device.raw(u"Present Position"), 2048);
        QVERIFY(!device.raw(u"Goal Position"));
        QCOMPARE(changes.count(), 1);
        QCOMPARE(changes.constFirst(), QVariantList({4, 4}));
        device.take(bytesAt(132, {0xFF, 0xFF})); // half a field says nothing
        QCOMPARE(device.raw(u"Present Position"), 2048);
    }

    void saysNothingWhereNothingChanged()
    {
        Device device(1, nullptr, smallTable(), Servo);
        device.take(bytesAt(132, {1, 0, 0, 0}, 1));
        QSignalSpy changes(&device, &Device::fieldsChanged);
        device.take(bytesAt(132, {1, 0, 0, 0}, 2));
        QCOMPARE(changes.count(), 0);
        QCOMPARE(device.value(4).at, LineTime(std::chrono::milliseconds(2)));
        QCOMPARE(device.lastHeard(), LineTime(std::chrono::milliseconds(2)));
    }

    void aPendingFieldStaysPendingUntilTheReadBack()
    {
        Device device(1, nullptr, smallTable(), Servo);
        device.take(bytesAt(116, {10, 0, 0, 0}));
        device.setPending(3, 20);
        device.take(bytesAt(116, {10, 0, 0, 0})); // a poll that was on its way
        QCOMPARE(device.value(3).state, FieldState::Pending);
        QCOMPARE(device.value(3).raw, 10);
        QCOMPARE(device.value(3).pending, 20);
        device.clearPending(3);
        device.take(bytesAt(116, {20, 0, 0, 0}));
        QCOMPARE(device.value(3).state, FieldState::Fresh);
        QCOMPARE(device.value(3).raw, 20);
        QVERIFY(!device.value(3).pending);
    }

    void aFailureKeepsTheOldValueAndSaysWhy()
    {
        Device device(1, nullptr, smallTable(), Servo);
        device.take(bytesAt(116, {10, 0, 0, 0}));
        device.setPending(3, 20);
        device.setFailed(3, QStringLiteral("refused"));
        QCOMPARE(device.value(3).state, FieldState::Failed);
        QCOMPARE(device.value(3).raw, 10);
        QCOMPARE(device.value(3).error, QStringLiteral("refused"));
        device.take(bytesAt(116, {10, 0, 0, 0})); // the next poll must not wipe it away unseen
        QCOMPARE(device.value(3).state, FieldState::Failed);
        QCOMPARE(device.value(3).error, QStringLiteral("refused"));
        device.take(bytesAt(116, {11, 0, 0, 0}));
        QCOMPARE(device.value(3).state, FieldState::Fresh);
        device.setFailed(3, QStringLiteral("refused"));
        device.clearFailures();
        QCOMPARE(device.value(3).state, FieldState::Fresh);
    }

    void oldNewsAreDropped()
    {
        Device device(1, nullptr, smallTable(), Servo);
        device.take(bytesAt(64, {1}, 5)); // a read-back
        device.take(bytesAt(64, {0}, 4)); // polled before it, delivered after it
        QCOMPARE(device.raw(u"Torque Enable"), 1);
        device.take(bytesAt(64, {0}, 6));
        QCOMPARE(device.raw(u"Torque Enable"), 0);
    }

    void whatWaitedUntilItWasGoneIsStale()
    {
        Device device(1, nullptr, smallTable(), Servo);
        device.take(bytesAt(64, {1}, 5));
        device.setState(Device::State::Rebooting);
        device.take(bytesAt(64, {0}, 6), FieldState::Stale);
        QCOMPARE(device.raw(u"Torque Enable"), 0);
        QCOMPARE(device.value(2).state, FieldState::Stale);
        device.take(bytesAt(64, {1}, 4), FieldState::Stale);
        QCOMPARE(device.raw(u"Torque Enable"), 0);
        device.take(bytesAt(64, {1}, 4)); // it is back; the line was opened anew
        QCOMPARE(device.raw(u"Torque Enable"), 1);
        QCOMPARE(device.value(2).state, FieldState::Fresh);
    }

    void aReadBackOvertakesWhatWasPolledBefore()
    {
        Device device(1, nullptr, smallTable(), Servo);
        device.take(bytesAt(64, {1}, 5));
        device.takeReadBack(device.table().indexOf(Known::TorqueEnable), 0);
        QCOMPARE(device.raw(Known::TorqueEnable), 0);
        device.take(bytesAt(64, {1}, 6)); // polled before it, delivered after it
        QCOMPARE(device.raw(Known::TorqueEnable), 0);
        device.takeReadBack(4, -1);
        QCOMPARE(device.raw(u"Present Position"), -1);
        QVERIFY(!device.raw(Known::Led)); // not in its table
    }

    void silenceMakesEverythingStale()
    {
        Device device(1, nullptr, smallTable(), Servo);
        device.take(bytesAt(132, {1, 0, 0, 0}));
        device.setState(Device::State::Silent);
        QCOMPARE(device.value(4).state, FieldState::Stale);
        QCOMPARE(device.value(0).state, FieldState::Unknown);
    }

    void locksWhatCannotBeWritten_data()
    {
        QTest::addColumn<int>("field");
        QTest::addColumn<int>("torque");
        QTest::addColumn<Device::State>("state");
        QTest::addColumn<QString>("reason");
        using enum Device::State;
        QTest::newRow("read-only") << 4 << 0 << Present << QStringLiteral("Present Position is read-only.");
        QTest::newRow("EEPROM, torque off") << 0 << 0 << Present << QString();
        QTest::newRow("EEPROM, torque on")
            << 0 << 1 << Present
            << QStringLiteral("ID is in the EEPROM area, which the servo locks while its torque is on.");
        QTest::newRow("RAM, torque on") << 3 << 1 << Present << QString();
        QTest::newRow("silent") << 3 << 1 << Silent << QString(); // it may hear all the same
        QTest::newRow("rebooting") << 3 << 1 << Rebooting << QStringLiteral("XM430-W350 #3 is rebooting.");
    }
    void locksWhatCannotBeWritten()
    {
        QFETCH(int, field);
        QFETCH(int, torque);
        QFETCH(Device::State, state);
        QFETCH(QString, reason);
        Device device(1, nullptr, smallTable(), Servo);
        device.take(bytesAt(64, {static_cast<std::uint8_t>(torque)}));
        device.setState(state);
        QCOMPARE(device.lockReason(field), reason);
    }

    void traitsFollowTheRegisters()
    {
        Device device(1, nullptr, smallTable(), Servo);
        QCOMPARE(device.traits().returnDelay, std::chrono::microseconds(508));
        QVERIFY(device.traits().fastReads);
        QCOMPARE(device.traits().receiveBuffer, 512);
        device.take(bytesAt(9, {0}));
        QCOMPARE(device.traits().returnDelay, std::chrono::microseconds(8));
        Found older = Servo;
        older.firmware = 44;
        Device old(2, nullptr, smallTable(), older);
        QVERIFY(!old.traits().fastReads);
    }

    void isNamedByItsNickname()
    {
        Device device(1, nullptr, smallTable(), Servo);
        QSignalSpy changes(&device, &Device::attributesChanged);
        QCOMPARE(device.displayName(), QStringLiteral("XM430-W350 #3"));
        device.setNickname(QStringLiteral("elbow"));
        QCOMPARE(device.displayName(), QStringLiteral("elbow"));
        device.setNickname(QStringLiteral("elbow"));
        QCOMPARE(changes.count(), 1);
    }
};

DYNASCOPE_CORE_TEST(TestDevice)
#include "tst_device.moc"
