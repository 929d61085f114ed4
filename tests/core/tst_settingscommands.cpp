// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/settingscommands.h"
#include "tests/support/builtincatalog.h"
#include "tests/support/settingsworld.h"
#include "tests/support/testmain.h"
#include "tests/support/undoworld.h"

#include <QSignalSpy>

using namespace dynascope;
using namespace Qt::StringLiterals;
using test::UndoWorld, test::Wanted;

/// Settings by way of the session: what the device shows, what the journal holds, and that all of it can be undone.
class TestSettingsCommands : public QObject
{
    Q_OBJECT

private slots:
    void appliedShownAndUndone()
    {
        UndoWorld world(m_catalog);
        SettingsCommands settings(world.all.session, world.all.commands);
        const QSignalSpy torque(&settings, &SettingsCommands::torqueTurnedOn);
        world.open();
        QVERIFY(world.write(1, u"Position P Gain", 640));
        QVERIFY(world.torque(1, true));
        const Wanted registers{{u"Operating Mode"_s, 0}, {u"Position P Gain"_s, 0}, {u"Goal PWM"_s, 0},
                               {u"Profile Velocity"_s, 0}, {u"Homing Offset"_s, 0}};
        std::map<QString, std::int64_t> before;
        for (const auto &[name, unused] : registers)
            before[name] = world.value(1, name);
        const qint64 first = world.last() + 1;
        SettingsOptions options;
        options.mayTurnTorqueOff = options.keepResets = true;
        const auto done = apply(world, settings, {{u"Operating Mode"_s, 4}, {u"Homing Offset"_s, 77}}, options);
        QVERIFY2(done && done->isDone(), done ? qPrintable(done->why) : qPrintable(done.error().text));
        const Device &device = world.device(1);
        QCOMPARE(device.raw(u"Operating Mode").value_or(-1), 4);
        QCOMPARE(device.raw(u"Homing Offset").value_or(-1), 77);
        QCOMPARE(device.raw(u"Position P Gain").value_or(-1), 640);
        QCOMPARE(device.raw(u"Torque Enable").value_or(-1), 0);
        QVERIFY(!device.value(device.table().indexOf(u"Operating Mode")).pending);
        QCOMPARE(torque.count(), 0);
        for (const JournalEntry &entry : world.journal.entries())
            QCOMPARE(entry.state, JournalState::Done);
        std::vector<qint64> numbers;
        for (qint64 number = first; number <= world.last(); ++number) {
            if (whyNot(world.journal.entries(), number, Direction::Undo).isEmpty())
                numbers.push_back(number);
        }
        QVERIFY(numbers.size() >= 3);
        QCOMPARE(world.revert(numbers), QString());
        for (const auto &[name, raw] : before)
            QCOMPARE(world.value(1, name), raw);
    }

    void torqueComesBack()
    {
        UndoWorld world(m_catalog);
        SettingsCommands settings(world.all.session, world.all.commands);
        const QSignalSpy torque(&settings, &SettingsCommands::torqueTurnedOn);
        world.open();
        QVERIFY(world.torque(1, true));
        SettingsOptions options;
        options.mayTurnTorqueOff = options.putTorqueBack = true;
        const auto done = apply(world, settings, {{u"Return Delay Time"_s, 10}}, options);
        QVERIFY(done && done->torqueIsBack);
        QVERIFY(world.device(1).isTorqueOn());
        QCOMPARE(torque.count(), 1);
        QCOMPARE(world.value(1, u"Torque Enable"), 1);
    }

    void refused_data()
    {
        QTest::addColumn<QString>("obstacle");
        QTest::addColumn<QString>("says");
        QTest::newRow("STOP") << u"STOP"_s << u"STOP is held"_s;
        QTest::newRow("ID of another as a Secondary ID") << u"secondary"_s << u"Secondary ID 2 is the ID"_s;
        QTest::newRow("torque") << u"torque"_s << u"under torque, which locks its EEPROM"_s;
        QTest::newRow("closed") << u"closed"_s << QString();
    }
    void refused()
    {
        QFETCH(QString, obstacle);
        QFETCH(QString, says);
        UndoWorld world(m_catalog);
        SettingsCommands settings(world.all.session, world.all.commands);
        world.open();
        QString failed;
        connect(&world.all.commands, &Commands::failed, this,
                [&](Device *, const Error &error) { failed = error.text; });
        SettingsOptions options;
        Wanted wanted{{u"Return Delay Time"_s, 10}};
        if (obstacle == u"STOP") {
            world.all.commands.setStopped(true);
            options.putTorqueBack = true;
        }
        if (obstacle == u"secondary")
            wanted = {{u"Secondary ID"_s, 2}};
        if (obstacle == u"torque")
            QVERIFY(world.torque(1, true));
        if (obstacle == u"closed")
            world.all.line->close();
        const auto done = apply(world, settings, wanted, options);
        QVERIFY(!done || done->missing == Consent::TorqueOff);
        QVERIFY2(failed.contains(says) && failed.isEmpty() == says.isEmpty(), qPrintable(failed));
        QVERIFY(!world.device(1).value(world.device(1).table().indexOf(u"Return Delay Time")).pending);
    }

private:
    Result<SettingsOutcome> apply(UndoWorld &world, SettingsCommands &settings, const Wanted &wanted,
                                  const SettingsOptions &options)
    {
        std::optional<Result<SettingsOutcome>> outcome;
        Device &device = world.device(1);
        settings.apply(device, test::wantedOf(device.table(), wanted), options,
                       [&](const Result<SettingsOutcome> &result) { outcome = result; });
        if (!VirtualSession::waitFor([&] { return outcome.has_value(); }))
            return failure(ErrorKind::NothingReceived, u"hung"_s);
        return *outcome;
    }

    const Catalog m_catalog = test::builtInCatalog();
};

DYNASCOPE_CORE_TEST(TestSettingsCommands)
#include "tst_settingscommands.moc"
