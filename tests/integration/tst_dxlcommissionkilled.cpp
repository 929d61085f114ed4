// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/procedures/movefile.h"
#include "tests/support/dxlbus.h"
#include "tests/support/testmain.h"

#include <QDir>

#include <atomic>
#include <csignal>

using namespace Qt::StringLiterals;
using namespace dynascope;
using dynascope::test::DxlBus;
using dynascope::test::RunningDxl;

namespace {

constexpr const char *Robot = R"(profile: 1
joints:
  - name: shoulder
    model: XM430-W350
    id: 11
    baud: 1000000
    registers:
      Operating Mode: Extended position control
      Return Delay Time: 20 us
      Max Position Limit: 270 deg
      Homing Offset: 0
      Position P Gain: 700
      Profile Velocity: 100
)";

using Image = std::map<QString, std::int64_t>;

/// A new servo on a bus of its own, and one run of `dxl commission` on it.
class Trial
{
public:
    explicit Trial(const QString &profile) : m_bus(u"XM430-W350@57600:1"_s), m_profile(profile) { }

    DxlBus &bus() { return m_bus; }
    QStringList arguments() const
    {
        return m_bus.with({u"--baud"_s, u"1000000"_s, u"commission"_s, u"--profile"_s, m_profile, u"--present"_s,
                           u"--no-led"_s});
    }
    /// Kills it as the servo hears write number `place`, before it can answer.
    void startAndKillAt(int place)
    {
        m_running = std::make_unique<RunningDxl>(arguments());
        m_bus.call([this, place, process = m_running->processId()](sim::SimulatedBus &bus, LineTime) {
            bus.servos().front()->setWriteObserver([this, place, process](sim::Servo &, int, ByteView) {
                if (++m_writes == place)
                    ::kill(static_cast<pid_t>(process), SIGKILL);
            });
        });
    }
    bool hasEnded() { return m_running->hasEnded(); }
    int writes() const { return m_writes; }
    void countOn() { startAndKillAt(-1); } ///< and kills nobody

    /// Where it stands and what it holds of what can be written.
    Image image()
    {
        Image all;
        m_bus.call([&all](sim::SimulatedBus &bus, LineTime) {
            sim::Servo &servo = *bus.servos().front();
            for (const Field &field : servo.table().fields()) {
                if (field.isWritable())
                    all[field.name] = servo.value(field.name);
            }
        });
        return all;
    }

private:
    DxlBus m_bus;
    QString m_profile;
    std::unique_ptr<RunningDxl> m_running;
    std::atomic<int> m_writes = 0; ///< counted on the server's thread
};

} // namespace

/// `dxl commission` killed without a word at each of its writes: the servo is found, holds nothing but old or new
/// values, and the same command once more ends as if nothing had been. (In virtual time: core_commissioning.)
class TestDxlCommissionKilled : public QObject
{
    Q_OBJECT

    static constexpr int AtOnce = 4; ///< runs side by side, which wait most of the time

private slots:
    void atEachWrite()
    {
        QDir(MoveFile::usualFolder()).removeRecursively();
        const QTemporaryDir folder;
        const QString profile = folder.filePath(u"robot.yaml"_s);
        QFile file(profile);
        QVERIFY(file.open(QIODevice::WriteOnly) && file.write(Robot) > 0);
        file.close();

        Trial whole(profile);
        const Image fresh = whole.image();
        whole.countOn();
        QTRY_VERIFY_WITH_TIMEOUT(whole.hasEnded(), 60'000);
        const Image done = whole.image();
        QCOMPARE(done.at(u"ID"_s), 11);
        QCOMPARE(done.at(u"Baud Rate"_s), 3);
        QCOMPARE(done.at(u"Position P Gain"_s), 700);
        QVERIFY2(whole.writes() >= 7, qPrintable(QString::number(whole.writes())));

        for (int first = 1; first <= whole.writes(); first += AtOnce) {
            std::vector<std::unique_ptr<Trial>> trials;
            for (int place = first; place < first + AtOnce && place <= whole.writes(); ++place) {
                trials.push_back(std::make_unique<Trial>(profile));
                trials.back()->startAndKillAt(place);
            }
            for (std::size_t i = 0; i < trials.size(); ++i) {
                Trial &trial = *trials[i];
                QTRY_VERIFY_WITH_TIMEOUT(trial.hasEnded(), 60'000);
                QCOMPARE(trial.writes(), first + static_cast<int>(i)); // and none after it was killed
                QCOMPARE(neither(trial.image(), fresh, done), QString());
                trial.countOn();
            }
            for (const auto &trial : trials) {
                QTRY_VERIFY_WITH_TIMEOUT(trial->hasEnded(), 60'000);
                QCOMPARE(neither(trial->image(), done, done), QString());
                QVERIFY(!MoveFile(MoveFile::usualFolder(), trial->bus().path(), {}).exists());
            }
        }
    }

private:
    /// Registers that hold neither what they held nor what they shall hold.
    static QString neither(const Image &now, const Image &before, const Image &after)
    {
        QStringList names;
        for (const auto &[name, raw] : now) {
            if (raw != before.at(name) && raw != after.at(name))
                names << u"%1: %2"_s.arg(name).arg(raw);
        }
        return names.join(u", ");
    }
};

DYNASCOPE_CORE_TEST(TestDxlCommissionKilled)
#include "tst_dxlcommissionkilled.moc"
