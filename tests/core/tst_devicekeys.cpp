// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/devicekeys.h"
#include "tests/support/testmain.h"

using namespace dynascope;

namespace {

const QString Port = QStringLiteral("/dev/ttyUSB0");

Found found(int id, int baudRate = 57600, int model = 1020, int firmware = 45)
{
    return {static_cast<std::uint8_t>(id), baudRate, static_cast<std::uint16_t>(model),
            static_cast<std::uint8_t>(firmware), false, {}};
}

/// As a line makes it.
Device device(DeviceKey key, const Found &at)
{
    ControlTable::Description description;
    description.modelNumber = at.modelNumber;
    return Device(key, nullptr, std::make_shared<const ControlTable>(description), at);
}

} // namespace

class TestDeviceKeys : public QObject
{
    Q_OBJECT

private slots:
    void everyDeviceHasItsOwn()
    {
        DeviceKeys keys;
        const DeviceKey first = keys.take(Port, found(1));
        QVERIFY(first != 0);
        QVERIFY(keys.take(Port, found(2)) != first);
        QVERIFY(keys.take(QStringLiteral("other"), found(1)) != first);
        QVERIFY(keys.take(Port, found(1)) != first); // present twice: two devices
    }

    void whoComesBackGetsItsFormerOne_data()
    {
        QTest::addColumn<QString>("line");
        QTest::addColumn<int>("id");
        QTest::addColumn<int>("baudRate");
        QTest::addColumn<int>("model");
        QTest::addColumn<int>("firmware");
        QTest::addColumn<bool>("same");
        QTest::newRow("same place") << Port << 1 << 57600 << 1020 << 45 << true;
        QTest::newRow("another line") << "sim" << 1 << 57600 << 1020 << 45 << false;
        QTest::newRow("another ID") << Port << 2 << 57600 << 1020 << 45 << false;
        QTest::newRow("another rate") << Port << 1 << 1000000 << 1020 << 45 << false;
        QTest::newRow("another model") << Port << 1 << 57600 << 1060 << 45 << false;
        QTest::newRow("another firmware") << Port << 1 << 57600 << 1020 << 46 << false;
    }

    void whoComesBackGetsItsFormerOne()
    {
        QFETCH(QString, line);
        QFETCH(int, id);
        QFETCH(int, baudRate);
        QFETCH(int, model);
        QFETCH(int, firmware);
        QFETCH(bool, same);
        DeviceKeys keys;
        const Device gone = device(keys.take(Port, found(1)), found(1));
        keys.release(Port, gone);
        const DeviceKey key = keys.take(line, found(id, baudRate, model, firmware));
        QCOMPARE(key == gone.key(), same);
        QVERIFY(keys.take(Port, found(1)) != key); // once only
    }

    /// It goes by the place where it stood when it went.
    void oneThatMovedComesBackThere()
    {
        DeviceKeys keys;
        Device moved = device(keys.take(Port, found(1)), found(1));
        moved.setFound(found(7));
        keys.release(Port, moved);
        QVERIFY(keys.take(Port, found(1)) != moved.key());
        QCOMPARE(keys.take(Port, found(7)), moved.key());
    }
};

DYNASCOPE_CORE_TEST(TestDeviceKeys)
#include "tst_devicekeys.moc"
