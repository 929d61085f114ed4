// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/builtincatalog.h"
#include "tests/support/servoimage.h"
#include "tests/support/testmain.h"
#include "tests/support/undoworld.h"

#include <random>

using namespace dynascope;
using test::imageOf, test::differences, test::UndoRate, test::UndoWorld;
using Image = test::ServoImage;
using namespace Qt::StringLiterals;

namespace {

/// Nobody could be asked any more at these, or not in the same way; where a device stands is another test's.
bool isManner(const Field &field)
{
    static const QStringList names{u"Status Return Level"_s, u"ID"_s,           u"Baud Rate"_s,
                                   u"Protocol Type"_s,       u"Secondary ID"_s, u"Bus Watchdog"_s};
    return names.contains(field.name);
}

std::int64_t randomValue(std::mt19937 &random, const Device &device, int index)
{
    const ControlTable &table = device.table();
    const Field &field = table.fields()[static_cast<std::size_t>(index)];
    if (field.name.startsWith(u"Indirect Address")) { // to anything but how it answers
        const int target = static_cast<int>(random() % static_cast<unsigned>(table.size()));
        const Field *there = table.at(target);
        return there && isManner(*there) ? table.find(u"LED")->address : target;
    }
    if (!field.values.empty())
        return field.values[random() % field.values.size()].value;
    const EffectiveField limits = device.effective(index);
    const std::int64_t low = std::max(limits.minimum.value_or(0), smallestRaw(field));
    const std::int64_t high = std::min(limits.maximum.value_or(low + 100), largestRaw(field));
    return std::uniform_int_distribution<std::int64_t>(low, std::max(low, high))(random);
}

} // namespace

/// Writes are taken back, and carried out again, as the journal has them.
class TestUndo : public QObject
{
    Q_OBJECT

private slots:
    void oneAndBack()
    {
        UndoWorld world(m_catalog);
        world.open();
        QVERIFY(world.write(1, u"Moving Threshold", 33));
        const qint64 number = world.last();
        QCOMPARE(world.undo.nextToUndo(), number);
        QCOMPARE(world.undo.nextToRedo(), 0);
        QCOMPARE(world.revert({number}), QString());
        QCOMPARE(world.device(1).raw(u"Moving Threshold"), 10); // on the screen, too
        QCOMPARE(world.value(1, u"Moving Threshold"), 10);
        QCOMPARE(world.journal.entries().back().undoes, number);
        QCOMPARE(world.journal.entries().back().by, JournalAuthor::Undo);
        QCOMPARE(world.undo.nextToUndo(), 0);
        QCOMPARE(world.undo.nextToRedo(), number);
        QCOMPARE(world.revert({number}), u"Entry 1 is undone already"_s);
        QCOMPARE(world.revert({number}, Direction::Redo), QString());
        QCOMPARE(world.value(1, u"Moving Threshold"), 33);
        QCOMPARE(world.undo.nextToUndo(), number);
        QVERIFY(world.write(1, u"LED", 1));
        QCOMPARE(world.undo.nextToRedo(), 0);
    }

    void aModeWithItsGains()
    {
        UndoWorld world(m_catalog);
        world.open();
        QVERIFY(world.write(1, u"Position P Gain", 111));
        QVERIFY(world.write(1, u"Profile Velocity", 222));
        QVERIFY(world.write(1, u"Operating Mode", 1));
        QCOMPARE(world.value(1, u"Position P Gain"), 800);
        QCOMPARE(world.revert({world.last()}), QString());
        QCOMPARE(world.value(1, u"Operating Mode"), 3);
        QCOMPARE(world.value(1, u"Position P Gain"), 111);
        QCOMPARE(world.value(1, u"Profile Velocity"), 222);
        QCOMPARE(world.revert({3}, Direction::Redo), QString());
        QCOMPARE(world.value(1, u"Operating Mode"), 1);
        QCOMPARE(world.value(1, u"Position P Gain"), 800);
    }

    void whatChangedMeanwhile()
    {
        UndoWorld world(m_catalog);
        world.open();
        QVERIFY(world.write(1, u"Moving Threshold", 33)); // 1
        QVERIFY(world.write(1, u"Moving Threshold", 44)); // 2
        QCOMPARE(world.revert({1}),
                 u"Undo of entry 1: Moving Threshold of XM430-W350 #1 has changed meanwhile: it is 44, "
                 "not 33; nothing was written"_s);
        QCOMPARE(world.value(1, u"Moving Threshold"), 44);
        QCOMPARE(world.revert({1, 2}), QString());
        QCOMPARE(world.value(1, u"Moving Threshold"), 10);

        QVERIFY(world.write(2, u"LED", 1));
        const qint64 led = world.last();
        world.all.close();
        world.all.factory.simulated.servo(2, UndoRate)->write(u"LED", 0); // as after a power cut
        world.all.open(UndoRate);
        QCOMPARE(world.revert({led}), QString()); // it is as it was: nothing to do
        QCOMPARE(world.undo.nextToRedo(), led);
    }

    void anotherDevice()
    {
        UndoWorld world(m_catalog);
        world.open();
        QVERIFY(world.write(1, u"Moving Threshold", 33));
        JournalEntry changed = world.journal.entries().back();
        changed.device.firmware = 40;
        const qint64 number = world.journal.begin(changed);
        changed.state = JournalState::Done;
        world.journal.finish(number, changed);
        QVERIFY(world.revert({number}).contains(u"had 40 then"_s));
        changed.device.modelNumber = 1060;
        const qint64 other = world.journal.begin(changed);
        world.journal.finish(other, changed);
        QVERIFY(world.revert({other}).contains(u"Another model answers"_s));
        changed.device.line = u"elsewhere"_s;
        const qint64 elsewhere = world.journal.begin(changed);
        world.journal.finish(elsewhere, changed);
        QVERIFY(world.revert({elsewhere}).endsWith(u"on elsewhere, which is not connected"_s));
    }

    void placesAreFollowed()
    {
        UndoWorld world(m_catalog);
        world.open();
        QVERIFY(world.write(1, u"Moving Threshold", 33)); // 1
        QVERIFY(
            world.run([&](const auto &done) { world.all.commands.changeId(world.device(1), 7, false, done); })); // 2
        QVERIFY(world.run([&](const auto &done) {                                                                // 3
            world.all.commands.changeBaud(world.device(7), 1'000'000, false, done);
        }));
        QCOMPARE(world.revert({1}), QString()); // where it is now
        QCOMPARE(world.value(7, u"Moving Threshold", 1'000'000), 10);
        QCOMPARE(world.revert({2}), QString()); // and its baud rate stays
        QCOMPARE(world.value(1, u"ID", 1'000'000), 1);
        QCOMPARE(world.revert({3}), QString());
        QCOMPARE(world.value(1, u"ID"), 1);
        QCOMPARE(world.revert({1, 2, 3}, Direction::Redo), QString());
        QCOMPARE(world.value(7, u"Moving Threshold", 1'000'000), 33);
    }

    void torqueAndMotionAreExplicit()
    {
        UndoWorld world(m_catalog);
        world.open();
        UndoOptions off, moves;
        off.mayTurnTorqueOff = true;
        moves.mayMove = true;
        QVERIFY(world.write(1, u"Moving Threshold", 33)); // 1
        QVERIFY(world.torque(1, true));                   // 2
        QVERIFY(world.write(1, u"Goal Position", 2100));  // 3
        QVERIFY(world.revert({1}).contains(u"under torque, which locks its EEPROM"_s));
        QVERIFY(world.revert({3}).contains(u"under torque and would move"_s));
        QVERIFY(world.revert({2}, Direction::Undo, moves).contains(u"torque of XM430-W350 #1 would go off"_s));
        QCOMPARE(world.value(1, u"Torque Enable"), 1);
        QCOMPARE(world.value(1, u"Goal Position"), 2100);
        QCOMPARE(world.revert({3}, Direction::Undo, moves), QString());
        QCOMPARE(world.value(1, u"Goal Position"), 2048);
        QCOMPARE(world.revert({1}, Direction::Undo, off), QString());
        QCOMPARE(world.value(1, u"Torque Enable"), 0);
        QCOMPARE(world.value(1, u"Moving Threshold"), 10);
        QVERIFY(world.journal.entries().back().note.contains(u"torque was turned off"_s));
        QCOMPARE(world.revert({2}, Direction::Undo), QString()); // off it is
        QCOMPARE(world.revert({2}, Direction::Redo, off),
                 u"Entry 2 would switch torque on, which is only ever done by hand"_s);
        QVERIFY(world.torque(1, true));
        QVERIFY(world.torque(1, false));
        QVERIFY(!world.revert({world.last()}, Direction::Undo, off).isEmpty());
        QCOMPARE(world.value(1, u"Torque Enable"), 0);
    }

    void aGoalThatTurnedTorqueOn()
    {
        UndoWorld world(m_catalog);
        world.open();
        UndoOptions all{true, true};
        QVERIFY(world.write(1, u"Drive Mode", 8));       // 1
        QVERIFY(world.write(1, u"Goal Position", 2500)); // 2: turns torque on
        QCOMPARE(world.value(1, u"Torque Enable"), 1);
        QVERIFY(world.revert({2}).contains(u"would go off"_s));
        QVERIFY(world.revert({2}, Direction::Undo, all).contains(u"would turn torque on"_s));
        QCOMPARE(world.value(1, u"Torque Enable"), 0);
        QCOMPARE(world.value(1, u"Goal Position"), 2500); // else torque would be on
        QVERIFY(world.journal.entries().back().note.contains(u"would turn torque on"_s));
        QVERIFY(world.write(1, u"Goal Position", 2400));
        QCOMPARE(world.value(1, u"Torque Enable"), 1);
        // Drive Mode, then the goals after all.
        QCOMPARE(world.revert({world.last(), 2, 1}, Direction::Undo, all), QString());
        QCOMPARE(world.value(1, u"Torque Enable"), 0);
        QCOMPARE(world.value(1, u"Goal Position"), 2048);
        QCOMPARE(world.value(1, u"Drive Mode"), 0);
        QVERIFY(world.revert({1, 2}, Direction::Redo, all).contains(u"would switch its torque on"_s));
        QCOMPARE(world.value(1, u"Drive Mode"), 8);
    }

    void stopEndsIt()
    {
        UndoWorld world(m_catalog);
        world.open();
        QVERIFY(world.write(1, u"Moving Threshold", 33));
        world.all.stop.press();
        QVERIFY(VirtualSession::waitFor([&] { return !world.all.stop.isVerifying(); }));
        QVERIFY(world.revert({1}).startsWith(u"STOP is held"_s));
        world.all.stop.release();
        QCOMPARE(world.revert({1}), QString());
    }

    /// Cut off after each packet: no register holds anything but its old or new value, and the same again ends well.
    void cutOffAnywhere()
    {
        for (int at = 1; at < 200; ++at) {
            UndoWorld world(m_catalog, u"XM430-W350@57600:1"_s);
            world.open();
            QVERIFY(world.write(1, u"Position P Gain", 111));
            QVERIFY(world.write(1, u"Operating Mode", 1));
            const qint64 number = world.last();
            world.all.close();
            const Image after = imageOf(world.all.factory.simulated);
            int packets = 0;
            world.all.factory.isLost = [&](ByteView) { return ++packets > at; };
            world.all.open(UndoRate);
            const QString failed = world.revert({number});
            world.all.close();
            world.all.factory.isLost = {};
            const std::int64_t gain = world.all.factory.simulated.servo(1, UndoRate)->value(u"Position P Gain");
            QVERIFY2(gain == 111 || gain == 800, qPrintable(QString::number(gain)));
            const std::int64_t mode = world.all.factory.simulated.servo(1, UndoRate)->value(u"Operating Mode");
            QVERIFY(mode == 1 || mode == 3);
            if (failed.isEmpty()) {
                QVERIFY(at > 10);
                return;
            }
            world.all.open(UndoRate);
            const QString again = world.revert({number});
            QVERIFY2(again.isEmpty(), qPrintable(u"after packet %1: %2"_s.arg(at).arg(again)));
            QCOMPARE(world.value(1, u"Position P Gain"), 111);
            QCOMPARE(world.value(1, u"Operating Mode"), 3);
        }
        QFAIL("it never came to its end");
    }

    /// The servo loses its power at each write of the undo: old or new, and the same again ends well.
    void powerCutAnywhere_data()
    {
        QTest::addColumn<bool>("behind");
        QTest::newRow("before the write") << false;
        QTest::newRow("behind it") << true;
    }
    void powerCutAnywhere()
    {
        QFETCH(bool, behind);
        for (int at = 1; at < 50; ++at) {
            UndoWorld world(m_catalog, u"XM430-W350@57600:1"_s);
            world.open();
            QVERIFY(world.write(1, u"Position P Gain", 111));
            QVERIFY(world.write(1, u"Operating Mode", 1));
            const qint64 number = world.last();
            sim::Servo *servo = world.all.factory.simulated.servo(1, UndoRate);
            std::atomic<bool> wasCut = false;
            world.all.factory.onPacket = [&, writes = 0](int, ByteView packet) mutable {
                const int sent = writes;
                writes += packet[7] == static_cast<std::uint8_t>(Instruction::Write) ? 1 : 0;
                if ((behind ? sent : writes) == at && !wasCut.exchange(true))
                    servo->powerCycle();
            };
            QString failed = world.revert({number});
            if (!wasCut) {
                QVERIFY(at > 2); // the mode, and what it reset
                return;
            }
            const std::int64_t gain = world.value(1, u"Position P Gain"), mode = world.value(1, u"Operating Mode");
            QVERIFY2(gain == 111 || gain == 800, qPrintable(QString::number(gain)));
            QVERIFY2(mode == 1 || mode == 3, qPrintable(QString::number(mode)));
            for (int tries = 0; tries < 3 && !failed.isEmpty(); ++tries) {
                world.all.factory.passing = LineTime(std::chrono::seconds(1)).count(); // it boots
                failed = world.revert({number});
            }
            QVERIFY2(failed.isEmpty(), qPrintable(u"at write %1: %2"_s.arg(at).arg(failed)));
            QCOMPARE(world.value(1, u"Position P Gain"), 111);
            QCOMPARE(world.value(1, u"Operating Mode"), 3);
        }
        QFAIL("it never came to its end");
    }

    void randomWrites_data()
    {
        QTest::addColumn<int>("seed");
        for (int seed = 1; seed <= 20; ++seed)
            QTest::addRow("seed %d", seed) << seed;
    }
    void randomWrites()
    {
        QFETCH(int, seed);
        constexpr int Writes = 200;
        std::mt19937 random(static_cast<unsigned>(seed));
        UndoWorld world(m_catalog, u"XM430-W350@57600:1,XL430-W250@57600:2,XL330-M288@57600:3"_s);
        const Image before = imageOf(world.all.factory.simulated);
        world.open();
        for (int done = 0, tries = 0; done < Writes; ++tries) {
            QVERIFY(tries < 20 * Writes);
            const auto &devices = world.all.line->devices();
            Device &device = *devices[random() % devices.size()];
            const int index = static_cast<int>(random() % device.table().fields().size());
            const Field &field = device.table().fields()[static_cast<std::size_t>(index)];
            if (!field.isWritable() || isManner(field))
                continue;
            const auto written = world.run([&](const auto &end) {
                world.all.commands.writeField(device, index, randomValue(random, device, index), end);
            });
            done += written ? 1 : 0;
        }
        std::vector<qint64> numbers;
        int skipped = 0;
        for (const JournalEntry &entry : world.journal.entries()) {
            const bool switchesOn =
                entry.changes.front().name == u"Torque Enable" && entry.changes.front().before == Bytes{1};
            if (entry.state == JournalState::Failed)
                continue;
            switchesOn ? void(++skipped) : numbers.push_back(entry.number);
        }
        QVERIFY2(numbers.size() > Writes * 8 / 10, qPrintable(QString::number(numbers.size()))); // drags are one
        const QString failed = world.revert(numbers, Direction::Undo, {true, true});
        QVERIFY2(failed.isEmpty(), qPrintable(failed));
        world.all.close();
        const QStringList wrong = differences(before, imageOf(world.all.factory.simulated));
        QVERIFY2(wrong.isEmpty(), qPrintable(wrong.join(u'\n')));
    }

private:
    const Catalog m_catalog = test::builtInCatalog();
};

DYNASCOPE_CORE_TEST(TestUndo)
#include "tst_undo.moc"
