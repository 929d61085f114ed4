// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/journal/journal.h"
#include "core/session/procedures/movefile.h"
#include "tests/support/dxlbus.h"
#include "tests/support/testmain.h"

#include <QDir>

#include <csignal>
#include <set>

using namespace Qt::StringLiterals;
using namespace dynascope;
using dynascope::test::DxlBus;
using dynascope::test::Outcome;
using dynascope::test::RunningDxl;

/// `dxl` killed without a word, at ten places of each of two runs that move servos: nobody is lost, and the same goes on.
/// (A profile: tst_dxlprofile. Every single place, in virtual time: core_movedevices, core_commissioning.)
class TestDxlKilled : public QObject
{
    Q_OBJECT

    static constexpr int Places = 10;

private slots:
    void init() { QDir(MoveFile::usualFolder()).removeRecursively(); }

    void whileItMoves_data()
    {
        QTest::addColumn<QStringList>("wish");
        QTest::addColumn<QString>("ids"); // of the first and the second one in the end
        QTest::addColumn<int>("rate");
        QTest::newRow("a swap") << u"move 1=2 2=1"_s.split(u' ') << u"2,1"_s << 57600;
        QTest::newRow("a new rate") << u"move --to-baud 4000000"_s.split(u' ') << u"1,2"_s << 4'000'000;
    }
    void whileItMoves()
    {
        QFETCH(QStringList, wish);
        QFETCH(QString, ids);
        QFETCH(int, rate);
        const QStringList ends = ids.split(u',');
        std::size_t packets = 0;
        for (int place = 0; place <= Places; ++place) { // the first one is left alone, and counted
            DxlBus bus(u"XM430-W350@57600:1,XH430-V350@57600:2"_s);
            if (place == 0) {
                QCOMPARE(run(bus, wish).code, 0);
                packets = bus.sent().size();
            } else {
                {
                    RunningDxl running(patiently(bus, wish));
                    const std::size_t enough = packets * static_cast<std::size_t>(place) / (Places + 1);
                    QTRY_VERIFY_WITH_TIMEOUT(bus.sent().size() >= enough || running.hasEnded(), 20'000);
                } // killed
                QVERIFY(everybodyIsSomewhere(bus, {1, 2}, {57600, rate}));
                const bool begun = MoveFile(MoveFile::usualFolder(), bus.path(), {}).exists();
                const bool over = !begun && model(bus, ends[0].toInt(), rate) == u"XM430-W350"; // killed as it said so
                const QStringList onward = begun ? QStringList{u"move"_s, u"--resume"_s} : wish;
                Outcome again{over ? 0 : -1, {}, {}};
                for (int run = 0; run < 3 && again.code != 0; ++run) // where a loaded machine let an answer be missed
                    again = this->run(bus, onward);
                QVERIFY2(again.code == 0, qPrintable(u"killed at %1: %2"_s.arg(place).arg(again.err)));
            }
            QCOMPARE(model(bus, ends[0].toInt(), rate), u"XM430-W350"_s);
            QCOMPARE(model(bus, ends[1].toInt(), rate), u"XH430-V350"_s);
            QVERIFY(!MoveFile(MoveFile::usualFolder(), bus.path(), {}).exists());
        }
    }

    /// What stood there is known before the packet goes out: undo has it, though nobody lived to note the end.
    void whileItWritesToTwo()
    {
        DxlBus bus(u"XM430-W350@57600:1,XM430-W350@57600:2"_s);
        bus.set(2, 57600, u"Profile Velocity", 7);
        RunningDxl running(bus.with({u"write"_s, u"1,2"_s, u"profile_velocity=100"_s}));
        bus.call([process = running.processId()](sim::SimulatedBus &simulated, LineTime) {
            simulated.servos().front()->setWriteObserver(
                [process](sim::Servo &, int, ByteView) { ::kill(static_cast<pid_t>(process), SIGKILL); });
        });
        QTRY_VERIFY_WITH_TIMEOUT(running.hasEnded(), 20'000);
        QCOMPARE(bus.value(1, 57600, u"Profile Velocity"), 100);
        const Journal journal(Journal::usualFolder());
        QVERIFY(journal.entries().size() >= 2);
        for (const int id : {1, 2}) {
            const JournalEntry &entry = journal.entries()[journal.entries().size() - 3 + static_cast<std::size_t>(id)];
            QCOMPARE(entry.device.id, id);
            QCOMPARE(entry.state, JournalState::Begun);
            QCOMPARE(entry.changes.front().before, (Bytes{static_cast<std::uint8_t>(id == 1 ? 0 : 7), 0, 0, 0}));
        }
    }

private:
    static QStringList patiently(const DxlBus &bus, const QStringList &arguments)
    {
        return QStringList{u"--port"_s, bus.path(), u"--timeout"_s, u"100"_s} + arguments;
    }
    static Outcome run(const DxlBus &bus, const QStringList &arguments) { return test::dxl(patiently(bus, arguments)); }
    /// Nobody has another ID or another rate than one of these.
    static bool everybodyIsSomewhere(DxlBus &bus, const std::set<int> &ids, const std::set<int> &rates)
    {
        bool known = true;
        bus.call([&](sim::SimulatedBus &simulated, LineTime) {
            for (const auto &servo : simulated.servos())
                known = known && (ids.count(servo->id()) || servo->id() > 2) && rates.count(servo->baudRate());
        });
        return known;
    }
    static QString model(DxlBus &bus, int id, int baudRate)
    {
        QString found;
        bus.call([&](sim::SimulatedBus &simulated, LineTime) {
            if (const sim::Servo *servo = simulated.servo(id, baudRate))
                found = servo->model();
        });
        return found;
    }
};

DYNASCOPE_CORE_TEST(TestDxlKilled)
#include "tst_dxlkilled.moc"
