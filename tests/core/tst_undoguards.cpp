// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/builtincatalog.h"
#include "tests/support/testmain.h"
#include "tests/support/undoworld.h"

using namespace dynascope;
using namespace Qt::StringLiterals;
using test::UndoRate, test::UndoWorld;

namespace {

RegisterChange change(const QString &name, int address, const Bytes &before, const Bytes &after)
{
    return {name, static_cast<std::uint16_t>(address), false, before, after, after};
}

} // namespace

/// What taking a write back may never do, whatever the journal says.
class TestUndoGuards : public QObject
{
    Q_OBJECT

private slots:
    void aDriveModePutBackWithAGoal()
    {
        UndoWorld world(m_catalog);
        world.open();
        const qint64 number = world.note(
            1, {change(u"Drive Mode"_s, 10, {9}, {0}), change(u"Goal Position"_s, 116, {0x34, 8, 0, 0}, {0, 8, 0, 0})});
        (void)world.revert({number});
        QCOMPARE(world.value(1, u"Drive Mode"), 9);
        QCOMPARE(world.value(1, u"Torque Enable"), 0);
        QCOMPARE(world.value(1, u"Goal Position"), 2048);
    }

    void torqueAmongOthersIsAskedFor_data()
    {
        QTest::addColumn<Bytes>("before");
        QTest::newRow("alone, by its address") << Bytes{0};
        QTest::newRow("with the LED") << Bytes{0, 0};
    }
    void torqueAmongOthersIsAskedFor()
    {
        QFETCH(Bytes, before);
        UndoWorld world(m_catalog);
        world.open();
        QVERIFY(world.torque(1, true));
        if (before.size() > 1)
            QVERIFY(world.write(1, u"LED", 1));
        const qint64 number = world.note(1, {change({}, 64, before, Bytes(before.size(), 1))});
        QVERIFY2(world.revert({number}).contains(u"The torque of XM430-W350 #1 would go off"_s),
                 qPrintable(world.revert({number})));
        QCOMPARE(world.undo.missing(), Consent::TorqueOff);
        QCOMPARE(world.value(1, u"Torque Enable"), 1);
        UndoOptions options;
        options.mayTurnTorqueOff = true;
        QCOMPARE(world.revert({number}, Direction::Undo, options), QString());
        QCOMPARE(world.value(1, u"Torque Enable"), 0);
        QCOMPARE(world.value(1, u"LED"), 0);
    }

    void aServoThatAnswersPingAlone()
    {
        constexpr int Rate = 1'000'000;
        UndoWorld world(m_catalog, u"XL-320@1000000:1"_s);
        world.open(Rate);
        const std::int64_t goal = world.value(1, u"Goal Position", Rate), speed = world.value(1, u"Moving Speed", Rate);
        const Field *level = world.device(1, Rate).table().find(u"Status Return Level");
        const qint64 number = world.note(1, {change(level->name, level->address, {2}, {0})}, Rate);
        world.all.close();
        world.all.factory.simulated.servo(1, Rate)->write(level->name, 0);
        world.all.open(Rate);
        QCOMPARE(world.revert({number}), QString());
        QCOMPARE(world.value(1, level->name, Rate), 2);
        QCOMPARE(world.value(1, u"Goal Position", Rate), goal);
        QCOMPARE(world.value(1, u"Moving Speed", Rate), speed);
    }

    /// The device leaves alone what the entry never spoke of.
    void aKeptRegisterThatWaits()
    {
        UndoWorld world(m_catalog);
        world.open();
        const UndoStep step = planned(world, world.note(1, {change(u"Operating Mode"_s, 11, {4}, {3})}));
        UndoSequence sequence({step.number}, Direction::Undo, {});
        std::optional<UndoStep> next = sequence.next(world.journal.entries(), m_catalog);
        QVERIFY(next);
        QVERIFY(!next->registers.kept.empty());
        UndoResult left;
        left.registers.left.push_back({next->registers.kept.front(), u"it waits"_s});
        sequence.take(*next, left);
        next = sequence.next(world.journal.entries(), m_catalog);
        QVERIFY(next);
        QCOMPARE(next->entry.changes.size(), 1u);
        QCOMPARE(next->entry.changes.front().address, next->registers.registers.front().address);
        JournalEntry noted = outcomeOf(*next, left);
        noted.number = 2;
        noted.at = QDateTime::currentDateTimeUtc();
        const auto read = journalEntryFromJson(toJson(noted));
        QVERIFY2(read, qPrintable(read ? QString() : read.error().text));
    }

    void anUndoOfWhatHasNoRegisters()
    {
        JournalEntry reboot, undo;
        reboot.number = 1;
        reboot.kind = JournalKind::Reboot;
        undo.number = 2;
        undo.undoes = 1;
        undo.changes = {change(u"LED"_s, 65, {1}, {0})};
        reboot.state = undo.state = JournalState::Done;
        QCOMPARE(nextToRedo({reboot, undo}), 0);
    }

    void nobodyKnowsTheRegister()
    {
        UndoWorld world(m_catalog);
        world.open();
        UndoStep step = planned(world, world.note(1, {change({}, 116, {0, 9, 0, 0}, {0, 8, 0, 0})}));
        step.registers.torqueAddress.reset(); // as of a model without a table
        VirtualBus virtualBus(m_catalog, u"XM430-W350@57600:1"_s);
        DirectContext context(*virtualBus.bus);
        virtualBus.simulated.servo(1, UndoRate)->write(u"Goal Position", 2048);
        const auto asks = carryOut(context, step);
        QVERIFY(asks);
        QVERIFY(asks->registers.missing == Consent::Motion);
        QVERIFY(asks->registers.why.startsWith(u"Nobody knows whether XM430-W350 #1 would move"_s));
        QCOMPARE(virtualBus.simulated.servo(1, UndoRate)->value(u"Goal Position"), 2048);
        step.registers.mayMove = true;
        const auto done = carryOut(context, step);
        QVERIFY(done);
        QVERIFY(done->registers.missing == Consent::None);
        QCOMPARE(virtualBus.simulated.servo(1, UndoRate)->value(u"Goal Position"), 2304);
    }

    void aLineThatNamesTheWrongPlace_data()
    {
        QTest::addColumn<QString>("name");
        QTest::addColumn<int>("address");
        QTest::addColumn<int>("before");
        QTest::addColumn<int>("after");
        QTest::addColumn<QString>("why");
        const QString absent = u"Entry 1 names a register that is not there"_s;
        QTest::newRow("ID on Torque Enable") << u"ID"_s << 64 << 3 << 1 << absent;
        QTest::newRow("Baud Rate on Torque Enable") << u"Baud Rate"_s << 64 << 3 << 1 << absent;
        QTest::newRow("broadcast") << u"ID"_s << 7 << 254 << 1
                                   << u"Entry 1 speaks of ID 254, which no device can have"_s;
        QTest::newRow("torque in disguise") << u"LED"_s << 64 << 1 << 0 << u"Entry 1 would switch torque on"_s;
        QTest::newRow("torque as Status Return Level")
            << u"Status Return Level"_s << 64 << 1 << 0 << u"Entry 1 would switch torque on"_s;
    }
    void aLineThatNamesTheWrongPlace()
    {
        QFETCH(QString, name);
        QFETCH(int, address);
        QFETCH(int, before);
        QFETCH(int, after);
        QFETCH(QString, why);
        UndoWorld world(m_catalog);
        world.open();
        const qint64 number = world.note(
            1, {change(name, address, {static_cast<std::uint8_t>(before)}, {static_cast<std::uint8_t>(after)})});
        QCOMPARE(world.revert({number}), why);
        QCOMPARE(world.value(1, u"Torque Enable"), 0);
    }

    /// By its address alone, Indirect Data is still what it points at.
    void indirectDataByItsAddress()
    {
        UndoWorld world(m_catalog);
        world.open();
        QVERIFY(world.write(1, u"Indirect Address 1", 64));
        const qint64 one = world.note(1, {change({}, 224, {1}, {0})});
        QVERIFY(world.revert({one}).contains(u"would come under torque"_s));
        const qint64 two = world.note(1, {change({}, 224, {1, 0}, {0, 0})});
        QCOMPARE(world.revert({two}),
                 u"Entry %1 was written through indirect addresses: write its registers yourself"_s.arg(two));
        QCOMPARE(world.value(1, u"Torque Enable"), 0);
    }

    void aSideEffectTakesNothingBack()
    {
        JournalEntry write, undo;
        write.number = 1;
        write.changes = {change(u"Operating Mode"_s, 11, {3}, {4}), change(u"Goal PWM"_s, 100, {1, 0}, {2, 0})};
        undo.number = 2;
        undo.undoes = 1;
        undo.changes = {write.changes.back()};
        write.state = undo.state = JournalState::Done;
        QVERIFY(undoneEntries({write, undo}).empty());
        undo.changes = {write.changes.front()};
        QVERIFY(undoneEntries({write, undo}).contains(1));
    }

private:
    UndoStep planned(const UndoWorld &world, qint64 number) const
    {
        auto step = planUndo(world.journal.entries(), number, Direction::Undo, m_catalog, {});
        if (!step)
            qFatal("%s", qPrintable(step.error().text));
        return std::move(*step);
    }
    const Catalog m_catalog = test::builtInCatalog();
};

DYNASCOPE_CORE_TEST(TestUndoGuards)
#include "tst_undoguards.moc"
