// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/registerfile.h"
#include "tests/support/builtincatalog.h"
#include "tests/support/testmain.h"

using namespace dynascope;
using sim::Reg;
using sim::RegisterFile;

class TestRegisterFile : public QObject
{
    Q_OBJECT

    const Catalog m_catalog = test::builtInCatalog();
    RegisterFile made(QStringView model = u"XM430-W350") const
    {
        const Catalog::ModelInfo *info = m_catalog.model(model);
        return RegisterFile(m_catalog.find(info->modelNumber, info->newestFirmware));
    }

private slots:
    void beginsAsFromTheFactory()
    {
        RegisterFile registers = made();
        QCOMPARE(registers.get(Reg::ModelNumber), 1020);
        QCOMPARE(registers.get(Reg::ReturnDelayTime), 250);
        QCOMPARE(registers.get(Reg::GoalPwm), registers.get(Reg::PwmLimit));
        QCOMPARE(registers.get(Reg::GoalCurrent), registers.get(Reg::CurrentLimit));
        QCOMPARE(registers.initial(Reg::PositionPGain), 800);
    }

    void whatAModelLacksIsNothing()
    {
        RegisterFile registers = made(u"XL430-W250"); // no current sensor
        QVERIFY(!registers.has(Reg::PresentCurrent));
        const Bytes before = registers.image();
        registers.set(Reg::PresentCurrent, 7);
        QCOMPARE(registers.get(Reg::PresentCurrent), 0);
        QCOMPARE(registers.image(), before);
    }

    void keepsSigns()
    {
        RegisterFile registers = made();
        registers.set(Reg::PresentPosition, -1);
        QCOMPARE(registers.get(Reg::PresentPosition), -1);
        QCOMPARE(registers.read(132, 4), (Bytes{0xFF, 0xFF, 0xFF, 0xFF}));
    }

    void resets()
    {
        RegisterFile registers = made();
        registers.set(Reg::Id, 7);
        registers.set(Reg::FirmwareVersion, 44);
        registers.set(Reg::Led, 1);
        registers.set(Reg::BackupReady, 1);
        registers.resetRam();
        QCOMPARE(registers.get(Reg::Led), 0);
        QCOMPARE(registers.get(Reg::Id), 7);
        QCOMPARE(registers.get(Reg::BackupReady), 1); // it is kept in flash
        registers.set(Reg::Led, 1);
        registers.resetEeprom();
        QCOMPARE(registers.get(Reg::Id), 1);
        QCOMPARE(registers.get(Reg::FirmwareVersion), 44);
        QCOMPARE(registers.get(Reg::ModelNumber), 1020);
        QCOMPARE(registers.get(Reg::Led), 1);
    }

    void checksWrites_data()
    {
        QTest::addColumn<int>("address");
        QTest::addColumn<Bytes>("data");
        QTest::addColumn<int>("error");
        const auto row = [](const char *name, int address, const Bytes &data, DeviceError error) {
            QTest::newRow(name) << address << data << static_cast<int>(error);
        };
        row("LED", 65, {1}, DeviceError::None);
        row("LED and its neighbour's gap", 65, {1, 0}, DeviceError::Access);
        row("read only", 132, {0, 0, 0, 0}, DeviceError::Access);
        row("half a register", 116, {0, 0}, DeviceError::DataLength);
        row("the other half", 118, {0, 0}, DeviceError::DataLength);
        row("two registers", 108, {1, 0, 0, 0, 2, 0, 0, 0}, DeviceError::None);
        row("one and a half", 108, {1, 0, 0, 0, 2, 0}, DeviceError::DataLength);
        row("out of range", 65, {2}, DeviceError::DataRange);
        row("in the limits", 116, {0xFF, 0x0F, 0, 0}, DeviceError::None);
        row("beyond a limit register", 116, {0x00, 0x10, 0, 0}, DeviceError::DataLimit);
        row("below a limit register", 116, {0xFF, 0xFF, 0xFF, 0xFF}, DeviceError::DataLimit);
        row("a mode it has", 11, {5}, DeviceError::None);
        row("a mode that nobody has", 11, {2}, DeviceError::DataRange);
        row("a rate it has", 8, {7}, DeviceError::None);
        row("a rate that nobody has", 8, {200}, DeviceError::DataRange);
    }

    void checksWrites()
    {
        QFETCH(int, address);
        QFETCH(Bytes, data);
        const RegisterFile registers = made();
        QTEST(static_cast<int>(registers.check({address, data}, {})), "error");
    }

    void knowsWhereItEnds()
    {
        const RegisterFile registers = made();
        const int size = registers.table().size();
        QVERIFY(registers.isInside(size - 1, 1) && !registers.isInside(size - 1, 2) && !registers.isInside(size, 1));
    }

    /// Indirect Data 1 to 4 at 224 show what Indirect Address 1 to 4 at 168 point at.
    void seesThroughIndirectData()
    {
        RegisterFile registers = made();
        QCOMPARE(registers.targets(224, Bytes{1})[0].address, 224); // it points at itself at first
        for (int i = 0; i < 4; ++i) {
            const Field *pointer = registers.table().find(QStringLiteral("Indirect Address %1").arg(i + 1));
            registers.set(*pointer, i < 2 ? 116 + i : 65 - (i - 2)); // Goal Position, LED, Torque Enable
        }
        registers.set(Reg::GoalPosition, 0x1234);
        registers.set(Reg::Led, 1);
        QCOMPARE(registers.read(224, 3), (Bytes{0x34, 0x12, 1}));
        const std::vector<RegisterFile::Run> runs = registers.targets(224, Bytes{1, 2, 3, 4});
        QCOMPARE(runs.size(), std::size_t(3)); // neighbours stay together
        QCOMPARE(runs[0].address, 116);
        QCOMPARE(runs[0].data, (Bytes{1, 2}));
        QCOMPARE(runs[1].address, 65);
        QCOMPARE(runs[2].address, 64);
        for (const RegisterFile::Run &run : runs)
            registers.store(run);
        QCOMPARE(registers.read(116, 2), (Bytes{1, 2}));
        QCOMPARE(registers.get(Reg::TorqueEnable), 4);
        QCOMPARE(registers.fieldsIn(runs[0]).size(), std::size_t(1));
    }
};

DYNASCOPE_CORE_TEST(TestRegisterFile)
#include "tst_registerfile.moc"
