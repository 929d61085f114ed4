// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/journal/undo.h"
#include "core/session/profilerun.h"
#include "core/session/profilesaver.h"
#include "tests/support/builtincatalog.h"
#include "tests/support/profilefiles.h"
#include "tests/support/servoimage.h"
#include "tests/support/testmain.h"

#include <atomic>

using namespace dynascope;
using namespace dynascope::test;
using namespace Qt::StringLiterals;

namespace {

constexpr int Slow = 57600;

/// A program with a profile on a bus that outlives it.
struct Program {
    Program(VirtualFactory &factory, const Catalog &catalog, const QString &folder)
        : journal(folder + u"/journal"_s), session(factory, catalog), commands(session, &journal),
          stop(session, commands), run(session, commands, folder + u"/moves"_s)
    {
        line = &session.open(u"virtual"_s, ProfileRate);
        run.setLine(line);
        if (!VirtualSession::waitFor([this] { return line->state() == BusThread::State::Open; }))
            qFatal("it did not open");
    }
    bool rest()
    {
        return VirtualSession::waitFor([this] { return !run.isBusy(); });
    }
    bool compare(const QString &path)
    {
        if (!run.load(path))
            return false;
        run.compare();
        return rest() && run.comparison();
    }
    bool apply(const ProfileApplyOptions &options = {}, bool moves = false)
    {
        run.apply(options, moves);
        return rest();
    }
    QStringList states() const
    {
        QStringList list;
        for (const JointComparison &joint : run.comparison()->joints)
            list << wordOf(joint.state);
        return list;
    }

    Journal journal;
    Session session;
    Commands commands;
    StopControl stop;
    ProfileRun run;
    LineSession *line = nullptr;
};

std::vector<Deviation> fourDeviations()
{
    return {{1, u"Position P Gain"_s, 640}, {2, u"Return Delay Time"_s, 250}, {2, u"Shutdown"_s, 0},
            {4, u"PWM Limit"_s, 800}};
}

} // namespace

/// A profile as the window works with it: read, compared, applied, with the session's devices and the journal.
class TestProfileRun : public QObject
{
    Q_OBJECT

private slots:
    void init()
    {
        m_folder = std::make_unique<QTemporaryDir>();
        m_factory = std::make_unique<VirtualFactory>(m_catalog, servosOf(4));
        m_path = writeFile(m_folder->path(), u"arm.yaml"_s, profileOf(4));
        setUpServos(m_factory->simulated, *loadProfile(m_path, m_catalog), fourDeviations());
        m_writes = 0;
        m_factory->onPacket = [this](int, ByteView packet) { m_writes += isRegisterWrite(packet) ? 1 : 0; };
    }
    void cleanup() { m_factory.reset(); }

    void comparedAppliedAndNoMore()
    {
        Program program(*m_factory, m_catalog, m_folder->path());
        program.line->heard({2, ProfileRate, 1020, 50, false, {}});
        QVERIFY(program.compare(m_path));
        QCOMPARE(m_writes, 0);
        QCOMPARE(differences(*program.run.comparison()),
                 QStringList({u"j1 Position P Gain: 640 -> 900"_s, u"j2 Return Delay Time: 250 -> 0"_s,
                              u"j2 Shutdown: 0 -> 52"_s, u"j4 PWM Limit: 800 -> 885"_s}));
        const auto planned = program.run.planFor({}, true);
        QVERIFY(planned && planned->moves.isOver());
        QCOMPARE(planned->writes.differences(), 4U);
        QVERIFY(program.apply());
        QCOMPARE(program.run.problem(), QString());
        QCOMPARE(m_writes, 4);
        QVERIFY(program.run.comparison()->isAsWanted());
        QVERIFY(program.run.outcome() && program.run.outcome()->written() == 4);
        QCOMPARE(program.run.jointProgress(1).state, JointProgress::State::Done);
        QCOMPARE(program.run.jointProgress(1).written, 2U);
        QCOMPARE(program.run.jointProgress(2).state, JointProgress::State::None);
        QCOMPARE(program.journal.entries().size(), 4U);
        for (const JournalEntry &entry : program.journal.entries()) {
            QCOMPARE(entry.by, JournalAuthor::Profile);
            QCOMPARE(entry.state, JournalState::Done);
        }
        QCOMPARE(program.line->deviceAt(2, ProfileRate)->raw(u"Shutdown").value_or(-1), 52);
        QVERIFY(program.run.planFor({}, true)->isNothing());
        QVERIFY(program.apply());
        QCOMPARE(m_writes, 4);
    }

    /// Modes with what they reset among it: every writable register is what it was.
    void whatItWroteIsUndone()
    {
        m_factory = std::make_unique<VirtualFactory>(m_catalog, servosOf(8));
        m_path = writeFile(m_folder->path(), u"eight.yaml"_s, profileOf(8));
        setUpServos(m_factory->simulated, *loadProfile(m_path, m_catalog), twelveDeviations());
        const ServoImage before = imageOf(m_factory->simulated);
        {
            Program program(*m_factory, m_catalog, m_folder->path());
            QVERIFY(program.compare(m_path));
            QVERIFY(program.apply());
            QVERIFY(program.run.comparison()->isAsWanted());
            std::vector<qint64> numbers;
            for (const JournalEntry &entry : program.journal.entries())
                numbers.push_back(entry.number);
            QVERIFY(numbers.size() >= 12);
            Undo undo(program.session, program.commands);
            std::optional<Result<void>> undone;
            undo.run(numbers, Direction::Undo, {}, [&](const Result<void> &result) { undone = result; });
            QVERIFY(VirtualSession::waitFor([&] { return undone.has_value(); }));
            QVERIFY2(*undone, *undone ? "" : qPrintable(undone->error().text));
        }
        QCOMPARE(test::differences(before, imageOf(m_factory->simulated)), QStringList());
    }

    void onlyTheJointsThatAreChosen()
    {
        Program program(*m_factory, m_catalog, m_folder->path());
        QVERIFY(program.compare(m_path));
        ProfileApplyOptions options;
        options.joints = {3};
        QVERIFY(program.apply(options));
        QCOMPARE(m_writes, 1);
        QCOMPARE(program.states(),
                 QStringList({u"differs"_s, u"differs"_s, u"as-wanted"_s, u"as-wanted"_s}));
    }

    void aFileIsReadAnew()
    {
        Program program(*m_factory, m_catalog, m_folder->path());
        QVERIFY(program.compare(m_path));
        writeFile(m_folder->path(), u"arm.yaml"_s, profileOf(4).replace("885", "800"));
        program.run.compare();
        QVERIFY(program.rest());
        QCOMPARE(differences(*program.run.comparison()).size(), 6); // three joints have 885
        writeFile(m_folder->path(), u"arm.yaml"_s, profileOf(4).replace("885", "a lot"));
        program.run.compare();
        QVERIFY(program.rest());
        QVERIFY(!program.run.profile() && !program.run.comparison());
        QVERIFY(program.run.fault());
        QVERIFY2(program.run.fault()->text.contains(u"arm.yaml:9:16:"_s), qPrintable(program.run.fault()->text));
        QVERIFY(!program.run.planFor({}, true));
        QVERIFY(program.apply());
        QCOMPARE(m_writes, 0);
    }

    void torque()
    {
        Program program(*m_factory, m_catalog, m_folder->path());
        program.line->heard({2, ProfileRate, 1020, 50, false, {}});
        program.commands.setTorque({program.line->deviceAt(2, ProfileRate)}, true);
        QVERIFY(VirtualSession::waitFor([&] { return program.line->deviceAt(2, ProfileRate)->isTorqueOn(); }));
        QVERIFY(program.compare(m_path));
        QVERIFY(program.run.planFor({}, false)->writes.needsTorqueOff());
        m_writes = 0;
        QVERIFY(program.apply()); // the others are done, this one says why not
        QCOMPARE(program.run.jointProgress(1).state, JointProgress::State::Failed);
        QVERIFY(program.run.jointProgress(1).why.contains(u"torque"_s));
        QCOMPARE(m_writes, 2);
        QSignalSpy turnedOn(&program.run, &ProfileRun::torqueTurnedOn);
        ProfileApplyOptions options;
        options.mayTurnTorqueOff = options.putTorqueBack = true;
        QVERIFY(program.apply(options));
        QVERIFY(program.run.comparison()->isAsWanted());
        QCOMPARE(turnedOn.count(), 1);
        QVERIFY(program.line->deviceAt(2, ProfileRate)->isTorqueOn());
    }

    void endedAndAppliedAgain_data()
    {
        QTest::addColumn<QString>("how");
        QTest::newRow("cancelled") << u"cancel"_s;
        QTest::newRow("STOP") << u"stop"_s;
        QTest::newRow("a servo is gone") << u"gone"_s;
    }
    void endedAndAppliedAgain()
    {
        QFETCH(QString, how);
        std::atomic<bool> isGone = false;
        sim::Servo *second = m_factory->simulated.servo(2, ProfileRate);
        m_factory->onPacket = [&, second](int, ByteView packet) {
            m_writes += isRegisterWrite(packet) ? 1 : 0;
            second->setPlugged(!isGone);
        };
        Program program(*m_factory, m_catalog, m_folder->path());
        QVERIFY(program.compare(m_path));
        const auto when = connect(&program.run, &ProfileRun::jointChanged, this, [&](std::size_t joint) {
            if (joint == 0 && how == u"cancel")
                program.run.cancel();
            if (joint == 0 && how == u"stop")
                program.stop.press();
        });
        isGone = how == u"gone";
        QVERIFY(program.apply());
        disconnect(when);
        if (how == u"gone") {
            QCOMPARE(program.run.jointProgress(1).state, JointProgress::State::Failed);
            QCOMPARE(program.states().at(1), u"missing"_s);
            QCOMPARE(program.states().at(3), u"as-wanted"_s);
            isGone = false;
            for (int i = 0; i < 4 && program.states().at(1) == u"missing"; ++i) { // it boots first
                program.run.compare();
                QVERIFY(program.rest());
            }
        } else if (!program.run.problem().isEmpty()) { // the bus may have been quicker
            QVERIFY2(program.run.problem().contains(u"of 3 joints are done"_s), qPrintable(program.run.problem()));
        }
        if (how == u"stop") {
            QVERIFY(VirtualSession::waitFor([&] { return !program.stop.isVerifying(); }));
            const int before = m_writes;
            QVERIFY(program.apply());
            QVERIFY(program.run.problem().startsWith(u"STOP is held"_s));
            QCOMPARE(m_writes, before);
            program.stop.release();
        }
        QVERIFY(program.apply());
        QCOMPARE(program.run.problem(), QString());
        QVERIFY(program.run.comparison()->isAsWanted());
    }

    void aJointAtAnotherBaudIsMoved()
    {
        m_factory->simulated.servo(3, ProfileRate)->write(u"Baud Rate", 1);
        m_factory->simulated.servo(3, Slow)->write(u"PWM Limit", 700);
        Program program(*m_factory, m_catalog, m_folder->path());
        QVERIFY(program.compare(m_path));
        QCOMPARE(program.states().at(2), u"at-other-baud"_s);
        QCOMPARE(program.run.planFor({}, false)->writes.obstacles.size(), 1U);
        const auto planned = program.run.planFor({}, true);
        QVERIFY(planned && planned->moves.steps.size() == 1);
        QVERIFY(program.apply({}, true));
        QCOMPARE(program.run.problem(), QString());
        QCOMPARE(program.run.moved(), 1U);
        QVERIFY(program.run.comparison()->isAsWanted());
        QVERIFY(program.line->deviceAt(3, ProfileRate));
        QCOMPARE(program.journal.entries().front().by, JournalAuthor::Profile);
        QVERIFY(!moveFileOf(u"virtual"_s, m_folder->path() + u"/moves"_s).exists());
    }

    void aClosedLine()
    {
        Program program(*m_factory, m_catalog, m_folder->path());
        QVERIFY(program.compare(m_path));
        program.session.close(*program.line);
        QVERIFY(!program.run.line());
        QVERIFY(program.apply());
        QVERIFY(program.run.problem().contains(u"not open"_s));
        program.run.compare();
        QVERIFY(program.rest());
        QVERIFY(program.run.problem().contains(u"not open"_s));
    }

    void saved()
    {
        Program program(*m_factory, m_catalog, m_folder->path());
        program.line->heard({1, ProfileRate, 1020, 50, false, {}}).setNickname(u"base"_s);
        ProfileSaver saver(program.session);
        std::optional<Result<SavedProfile>> saved;
        const auto done = [&](const Result<SavedProfile> &result) { saved = result; };
        const auto ended = [&] { return VirtualSession::waitFor([&] { return saved.has_value(); }); };
        const QString fresh = m_folder->filePath(u"new.yaml"_s);
        saver.saveNew(fresh, *program.line, {}, done);
        QVERIFY(saver.isBusy());
        QVERIFY(ended());
        QVERIFY2(*saved, *saved ? "" : qPrintable(saved->error().text));
        QCOMPARE((*saved)->newJoints, 4);
        const auto profile = loadProfile(fresh, m_catalog);
        QVERIFY2(profile, profile ? "" : qPrintable(profile.error().text));
        QCOMPARE(profile->joints.size(), 4U);
        QCOMPARE(profile->joints.front().name, u"base"_s);
        QCOMPARE(profile->name, u"new"_s);

        writeFile(m_folder->path(), u"arm.yaml"_s, "# mine\n" + profileOf(4));
        saved.reset();
        saver.saveInto(m_path, *program.line, {}, done);
        QVERIFY(ended());
        QVERIFY2(*saved, *saved ? "" : qPrintable(saved->error().text));
        QVERIFY((*saved)->isChanged());
        QVERIFY(readFile(m_path).startsWith("# mine\nprofile: 1\nname: test\n"));
        QVERIFY(program.compare(m_path));
        QVERIFY(program.run.comparison()->isAsWanted());

        saved.reset();
        writeFile(m_folder->path(), u"arm.yaml"_s, "profile: 7\n");
        saver.saveInto(m_path, *program.line, {}, done);
        QVERIFY(saved && !*saved);
        QCOMPARE(readFile(m_path), QByteArray("profile: 7\n"));
        QCOMPARE(m_writes, 0);
    }

private:
    const Catalog m_catalog = builtInCatalog();
    std::unique_ptr<QTemporaryDir> m_folder;
    std::unique_ptr<VirtualFactory> m_factory;
    QString m_path;
    std::atomic<int> m_writes = 0;
};

DYNASCOPE_CORE_TEST(TestProfileRun)
#include "tst_profilerun.moc"
