// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/commands.h"
#include "tests/support/builtincatalog.h"
#include "tests/support/sessionfixture.h"
#include "tests/support/testmain.h"

using namespace dynascope;
using namespace Qt::StringLiterals;

namespace {

struct World {
    explicit World(const Catalog &catalog) : all(catalog, u"XM430-W350@57600:1,XL430-W250@57600:2"_s, &journal) { }

    Device &device(int id, int baudRate = 57600)
    {
        return *all.line->deviceAt(static_cast<std::uint8_t>(id), baudRate);
    }
    /// Orders, and waits until that is done.
    Result<void> run(const std::function<void(const Commands::Done &)> &order)
    {
        std::optional<Result<void>> result;
        order([&](const Result<void> &outcome) { result = outcome; });
        if (!VirtualSession::waitFor([&] { return result.has_value(); }))
            return failure(ErrorKind::NothingReceived, u"hung"_s);
        return *result;
    }
    Result<void> write(int id, QStringView field, std::int64_t raw)
    {
        return run([&](const Commands::Done &done) {
            all.commands.writeField(device(id), device(id).table().indexOf(field), raw, done);
        });
    }
    const JournalEntry &last() const { return journal.entries().back(); }

    Journal journal;
    VirtualSession all;
};

QStringList texts(const JournalEntry &entry)
{
    QStringList all;
    for (const RegisterChange &change : entry.changes) {
        all << u"%1: %2 -> %3"_s.arg(registerText(change), bytesText(change.before, change.isSigned),
                                     bytesText(change.after, change.isSigned));
    }
    return all;
}

} // namespace

/// What a person does in the window is in the journal, with what it replaced.
class TestCommandsJournal : public QObject
{
    Q_OBJECT

private slots:
    void aWriteWithItsOldValue()
    {
        World world(m_catalog);
        world.all.open(57600);
        QVERIFY(world.write(1, u"Moving Threshold", 33));
        QCOMPARE(texts(world.last()), QStringList{u"Moving Threshold: 10 -> 33"_s});
        QCOMPARE(world.last().state, JournalState::Done);
        QCOMPARE(world.last().by, JournalAuthor::Window);
        QCOMPARE(world.last().changes.front().shown, Bytes({33, 0, 0, 0}));
        QCOMPARE(world.last().device,
                 (JournalDevice{u"virtual"_s, {}, u"XM430-W350"_s, 1020, world.device(1).firmware(), 1, 57600}));
        QVERIFY(!world.write(1, u"Moving Threshold", 5000)); // refused before anything is sent
        QCOMPARE(world.journal.entries().size(), std::size_t(1));
    }

    void aModeResetsGains()
    {
        World world(m_catalog);
        world.all.open(57600);
        QVERIFY(world.write(1, u"Position P Gain", 111));
        QVERIFY(world.write(1, u"Profile Velocity", 222));
        QVERIFY(world.write(1, u"Operating Mode", 1));
        const QStringList changes = texts(world.last());
        QVERIFY2(changes.contains(u"Operating Mode: 3 -> 1"_s) && changes.contains(u"Position P Gain: 111 -> 800"_s)
                     && changes.contains(u"Profile Velocity: 222 -> 0"_s),
                 qPrintable(changes.join(u'\n')));
        QCOMPARE(changes.constFirst(), u"Operating Mode: 3 -> 1"_s);
    }

    void torqueWithTheGoalsItMoves()
    {
        World world(m_catalog);
        world.all.open(57600);
        QVERIFY(world.run([&](const auto &done) {
            world.all.commands.setTorque({&world.device(1), &world.device(2)}, true, done);
        }));
        QCOMPARE(world.journal.entries().size(), std::size_t(2));
        QCOMPARE(texts(world.journal.entries().front()).constFirst(),
                 u"Torque Enable: 0 -> 1"_s.replace(u"0 "_s, u"? "_s));
        QCOMPARE(world.last().state, JournalState::Done);
        QCOMPARE(world.last().device.id, 2);
        QVERIFY(world.run([&](const auto &done) { world.all.commands.setTorque({&world.device(1)}, false, done); }));
        QCOMPARE(texts(world.last()), QStringList{u"Torque Enable: 1 -> 0"_s});
    }

    void changesOfPlace()
    {
        World world(m_catalog);
        world.all.open(57600);
        QVERIFY(world.run([&](const auto &done) { world.all.commands.changeId(world.device(1), 7, false, done); }));
        QCOMPARE(texts(world.last()), QStringList{u"ID: 1 -> 7"_s});
        QCOMPARE(world.last().movedTo, (JournalPlace{7, 57600}));
        QCOMPARE(world.last().device.id, 1);
        QVERIFY(world.run(
            [&](const auto &done) { world.all.commands.changeBaud(world.device(7), 1'000'000, false, done); }));
        QCOMPARE(texts(world.last()), QStringList{u"Baud Rate: 1 -> 3"_s});
        QCOMPARE(world.last().movedTo, (JournalPlace{7, 1'000'000}));
        QVERIFY(!world.run([&](const auto &done) { // refused by who answers there
            world.all.commands.changeId(world.device(7, 1'000'000), 7, false, done);
        }));
        QCOMPARE(world.journal.entries().size(), std::size_t(2));
    }

    void aBaudRateAtWhichItsIdIsASecondaryId()
    {
        World world(m_catalog);
        world.all.open(57600);
        QVERIFY(world.run(
            [&](const auto &done) { world.all.commands.changeBaud(world.device(1), 1'000'000, false, done); }));
        world.device(2).takeReadBack(world.device(2).table().indexOf(Known::SecondaryId), 1);
        const auto back = world.run([&](const auto &done) {
            world.all.commands.changeBaud(world.device(1, 1'000'000), 57600, false, done);
        });
        QVERIFY(!back);
        QVERIFY2(back.error().text.contains(u"Secondary ID of XL430-W250"_s), qPrintable(back.error().text));
        QCOMPARE(world.journal.entries().size(), std::size_t(1));
    }

    void whatIsNoWrite()
    {
        World world(m_catalog);
        world.all.open(57600);
        // Its way back is not waited for: no time passes on this line.
        world.all.commands.reboot(world.device(1));
        QVERIFY(VirtualSession::waitFor([&] { return world.last().state == JournalState::Done; }));
        QCOMPARE(world.last().kind, JournalKind::Reboot);
        world.all.commands.factoryReset(world.device(2), ResetOption::AllButIdAndBaud);
        QVERIFY(VirtualSession::waitFor([&] { return world.last().state == JournalState::Done; }));
        QCOMPARE(world.last().kind, JournalKind::FactoryReset);
        QCOMPARE(world.journal.entries().size(), std::size_t(2));
    }

    void stopIsInIt()
    {
        World world(m_catalog);
        world.all.open(57600);
        QVERIFY(world.run([&](const auto &done) { world.all.commands.setTorque({&world.device(1)}, true, done); }));
        world.device(2).takeReadBack(world.device(2).table().indexOf(Known::TorqueEnable), 0);
        const std::size_t before = world.journal.entries().size();
        world.all.stop.press();
        QVERIFY(VirtualSession::waitFor([&] { return !world.all.stop.isVerifying(); }));
        QCOMPARE(world.journal.entries().size(), before + 1); // not who is known to be off
        QCOMPARE(world.last().by, JournalAuthor::Stop);
        QCOMPARE(world.last().state, JournalState::Done);
        QCOMPARE(texts(world.last()), QStringList{u"Torque Enable: 1 -> 0"_s});
    }

    /// A drag reads the old value once, then costs what it cost without a journal.
    void aDragIsNotSlowed()
    {
        World world(m_catalog);
        int reads = 0, writes = 0;
        world.all.factory.onPacket = [&](int, ByteView packet) {
            reads += packet[7] == static_cast<std::uint8_t>(Instruction::Read) ? 1 : 0;
            writes += packet[7] == static_cast<std::uint8_t>(Instruction::Write) ? 1 : 0;
        };
        world.all.open(57600);
        constexpr int Steps = 10;
        for (int i = 0; i < Steps; ++i)
            QVERIFY(world.write(1, u"Goal Position", 2000 + i));
        QCOMPARE(world.journal.entries().size(), std::size_t(1));
        QCOMPARE(texts(world.last()), QStringList{u"Goal Position: 2048 -> 2009"_s});
        world.all.close();
        QCOMPARE(writes, Steps);
        QCOMPARE(reads, Steps + 1);
    }

    void silence()
    {
        World world(m_catalog);
        bool isGone = false; // once something was written
        world.all.factory.isLost = [&isGone](ByteView packet) {
            isGone = isGone || packet[7] == static_cast<std::uint8_t>(Instruction::Write);
            return isGone;
        };
        world.all.open(57600);
        QVERIFY(!world.write(1, u"LED", 1));
        QCOMPARE(world.last().state, JournalState::Unconfirmed);
        QVERIFY(!world.last().note.isEmpty());
        QCOMPARE(texts(world.last()), QStringList{u"LED: 0 -> 1"_s});
        QVERIFY(!world.write(2, u"LED", 1)); // gone from the beginning: nothing was written
        QCOMPARE(world.last().state, JournalState::Failed);
        QCOMPARE(texts(world.last()), QStringList{u"LED: ? -> 1"_s});
    }

private:
    const Catalog m_catalog = test::builtInCatalog();
};

DYNASCOPE_CORE_TEST(TestCommandsJournal)
#include "tst_commandsjournal.moc"
