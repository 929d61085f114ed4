// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/builtincatalog.h"
#include "tests/support/sessionfixture.h"
#include "tests/support/settingsworld.h"
#include "tests/support/testmain.h"

#include <QFile>

using namespace dynascope;

/// Factory Reset as the window asks for it: session, bus thread and simulated servos in virtual time.
class TestProceduresReset : public QObject
{
    Q_OBJECT

private slots:
    // One that obeys is looked for in tst_session, where time passes while it boots.
    void oneThatIgnoredItIsFoundAtItsOldPlace()
    {
        Journal journal;
        VirtualSession all(m_catalog, QStringLiteral("XM430-W350@1000000:5"), &journal);
        all.factory.isLost = [](ByteView packet) {
            return packet[7] == static_cast<std::uint8_t>(Instruction::FactoryReset);
        };
        all.open(1000000);
        Device &device = *all.line->devices().front();
        std::optional<Result<void>> outcome;
        all.commands.factoryReset(device, ResetOption::All, [&](const Result<void> &result) { outcome = result; });
        QVERIFY(VirtualSession::waitFor([&] { return outcome.has_value(); }));
        QVERIFY(!*outcome);
        QCOMPARE(outcome->error().text,
                 QStringLiteral("XM430-W350 #5 still answers at ID 5, 1000000 bps: it did not take the reset"));
        QCOMPARE(device.id(), 5);
        QCOMPARE(device.baudRate(), 1000000);
        QCOMPARE(device.state(), Device::State::Present);
        const JournalEntry &entry = journal.entries().back();
        QCOMPARE(entry.kind, JournalKind::FactoryReset);
        QVERIFY(entry.state != JournalState::Done && !entry.movedTo);
        QVERIFY2(entry.note.contains(QStringLiteral("did not take the reset")), qPrintable(entry.note));
    }

    /// One obeys, one hears nothing of it, one is never heard again: each has its own end, and none keeps the next back.
    void severalWithDifferentEnds()
    {
        Journal journal;
        VirtualSession all(m_catalog, QStringLiteral("XM430-W350@1000000:5,XM430-W350@1000000:6,XM430-W350@1000000:7"),
                           &journal);
        sim::Servo *third = all.factory.simulated.servo(7, 1'000'000);
        all.factory.isLost = [third](ByteView packet) {
            const bool isReset = packet[7] == static_cast<std::uint8_t>(Instruction::FactoryReset);
            if (isReset && packet[4] == 7)
                third->setPlugged(false);
            return isReset && packet[4] != 5;
        };
        all.open(1'000'000);
        std::vector<Device *> devices;
        for (const auto &device : all.line->devices())
            devices.push_back(device.get());
        connect(all.line, &LineSession::deviceChanged, this, [&](Device *device) { // it boots for less than that
            if (device->state() == Device::State::Rebooting)
                all.factory.passing = LineTime(std::chrono::seconds(1)).count();
        });
        std::optional<Result<void>> outcome;
        all.commands.factoryReset(devices, ResetOption::AllButId, [&](const auto &result) { outcome = result; });
        QVERIFY(VirtualSession::waitFor([&] { return outcome.has_value(); }));
        QVERIFY(!*outcome); // the first failure
        QVERIFY2(outcome->error().text.contains(QStringLiteral("#6 still answers at ID 6, 1000000 bps")),
                 qPrintable(outcome->error().text));
        QCOMPARE(devices[0]->baudRate(), 57600);
        QCOMPARE(devices[1]->baudRate(), 1'000'000);
        QCOMPARE(devices[1]->state(), Device::State::Present);
        QCOMPARE(devices[2]->state(), Device::State::Silent);
        QCOMPARE(journal.entries().size(), std::size_t(3));
        QCOMPARE(journal.entries()[0].movedTo, (JournalPlace{5, 57600}));
        for (const std::size_t at : {1U, 2U})
            QVERIFY(journal.entries()[at].state == JournalState::Unconfirmed && !journal.entries()[at].movedTo);
    }

    void severalDisturbed_data()
    {
        QTest::addColumn<sim::ReplyFault>("fault");
        using Kind = sim::ReplyFault::Kind;
        for (const int times : {1, 3}) {
            QTest::addRow("lost, %d", times) << sim::ReplyFault{.kind = Kind::Lost, .times = times};
            QTest::addRow("damaged, %d", times) << sim::ReplyFault{.kind = Kind::Damaged, .times = times};
            QTest::addRow("late, %d", times)
                << sim::ReplyFault{.kind = Kind::Late, .times = times, .time = std::chrono::milliseconds(30)};
        }
    }
    /// Each answer in turn: who is reset is so as a whole, where it is said to stand it stands, and the others are reset
    /// the next time. Without session and bus thread, for the sake of virtual time.
    void severalDisturbed()
    {
        QFETCH(sim::ReplyFault, fault);
        int done = 0;
        for (int skip = 0; skip < 16; ++skip) {
            test::SettingsWorld world(m_catalog, QStringLiteral("XM430-W350@1000000:5,XM430-W350@1000000:6"));
            for (sim::Servo *servo : world.all)
                servo->write(u"Moving Threshold", 33);
            world.bus.advanceTo(world.bus.now() + std::chrono::seconds(1));
            fault.skip = skip;
            world.bus.setFaults({.replies = {fault}});
            const QStringList problems = resetAll(world);
            for (sim::Servo *servo : world.all) {
                const bool isReset = servo->baudRate() == 57600;
                QVERIFY(isReset || (servo->baudRate() == 1'000'000 && !problems.isEmpty()));
                QCOMPARE(servo->value(u"Moving Threshold"), isReset ? 10 : 33);
            }
            done += problems.isEmpty() ? 1 : 0;
            world.bus.setFaults({});
            QCOMPARE(resetAll(world), QStringList());
            for (sim::Servo *servo : world.all) {
                QCOMPARE(servo->baudRate(), 57600);
                QCOMPARE(servo->value(u"Moving Threshold"), 10);
            }
        }
        QVERIFY(done > 0);
    }

    void oneOfTwoAxesKeepsItsId()
    {
        Catalog catalog = test::builtInCatalog();
        QFile file(QStringLiteral(DYNASCOPE_SOURCE_DIR "/tests/data/tables/two-axes.json"));
        QVERIFY(file.open(QIODevice::ReadOnly));
        QVERIFY(catalog.add(file.readAll(), QStringLiteral("two-axes.json")));
        VirtualSession all(catalog, QStringLiteral("Two axes@1000000:11+12"));
        all.open(1000000);
        Device &device = *all.line->devices().back();
        std::optional<Result<void>> outcome;
        all.commands.factoryReset(device, ResetOption::All, [&](const Result<void> &result) { outcome = result; });
        QVERIFY(VirtualSession::waitFor([&] { return outcome.has_value(); }));
        QVERIFY(!*outcome);
        QVERIFY2(outcome->error().text.contains(QStringLiteral("one of two axes")), qPrintable(outcome->error().text));
        QCOMPARE(device.id(), 12);
    }

private:
    /// Of those that aren't yet; what was in the way.
    static QStringList resetAll(test::SettingsWorld &world)
    {
        test::MortalLine line(world.bus, 1'000'000);
        Bus program(line);
        DirectContext context(program);
        QStringList problems;
        for (const sim::Servo *servo : world.all) {
            if (servo->baudRate() == 57600)
                continue;
            const DevicePlace place = test::placeOf(*servo);
            DevicePlace after = place;
            after.baudRate = 57600;
            const auto sent = resetToFactory(context, {place, ResetOption::AllButId, after});
            line.advance(std::chrono::seconds(1)); // it boots
            const auto found = lookForMoved(context, place, after);
            if (found && found->baudRate != servo->baudRate())
                QTest::qFail("it is said to be where it isn't", __FILE__, __LINE__);
            if (!sent)
                problems << sent.error().text;
            else if (!found)
                problems << found.error().text;
            else if (!isAt(*found, after))
                problems << QStringLiteral("it did not take it");
        }
        world.bus.advanceTo(line.now() + std::chrono::seconds(1));
        return problems;
    }

    const Catalog m_catalog = test::builtInCatalog();
};

DYNASCOPE_CORE_TEST(TestProceduresReset)
#include "tst_procedures_reset.moc"
