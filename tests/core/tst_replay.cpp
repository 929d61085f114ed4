// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/replay/recordedlines.h"
#include "core/replay/replayer.h"
#include "core/session/alarmwatch.h"
#include "core/session/commands.h"
#include "core/session/monitor.h"
#include "tests/support/builtincatalog.h"
#include "tests/support/recordings.h"
#include "tests/support/testmain.h"

#include <QSignalSpy>

using namespace Qt::StringLiterals;
using namespace dynascope;
using namespace dynascope::test;

namespace {

constexpr quint32 Devices = 3;
constexpr int Cycles = 4000; ///< a millisecond each

const Catalog &catalog()
{
    static const Catalog tables = builtInCatalog(); // read once
    return tables;
}

/// A recording that is played into a session of its own.
struct Room {
    RecordedLines lines;
    Session session{lines, catalog()};
    Monitor monitor{session};
    Replayer replayer{session, monitor};

    Device &device(std::size_t index) const { return *session.devices().at(index); }
    std::int64_t position(std::size_t index) const { return device(index).raw(u"Present Position").value_or(-1); }
    const History &history(std::size_t index, QStringView name) const
    {
        return *monitor.history({device(index).key(), device(index).table().indexOf(name)});
    }
    void load(const QString &path)
    {
        QSignalSpy loaded(&replayer, &Replayer::loaded);
        QVERIFY(replayer.open(path));
        QTRY_COMPARE(loaded.count(), 1);
        QTRY_VERIFY(std::ranges::all_of(session.lines(),
                                        [](const auto &line) { return line->state() == BusThread::State::Open; }));
    }
};

LineTime at(int cycle)
{
    return RecordingBegin + cycle * LineTime(1ms);
}

std::int64_t recordedPosition(quint32 device, int cycle)
{
    const Bytes data = motion(device, cycle);
    return data[6] | data[7] << 8;
}

} // namespace

class TestReplay : public QObject
{
    Q_OBJECT

private slots:
    void initTestCase();
    void clock();
    void clockNearItsEnds();
    void showsDevicesAtOnce();
    void loadsEverySample();
    void holdsWhatWasThen_data();
    void holdsWhatWasThen();
    void tellsEachReadingWhilePlaying();
    void tellsWhoIsSilent();
    void goesBack();
    void steps();
    void keepsEvents();
    void asksNobody();
    void clearsNothing();
    void playsByTheClock();
    void isFreshOnceTheLineIsOpen();
    void damagedPart();
    void refuses_data();
    void refuses();
    void splitsPlacesThatClash();
    void refusesMoreThanThereCanBe();
    void endsWhileItReads();

private:
    QString write(const QString &name, const RecordingHeader &header, int cycles = Cycles,
                  const std::vector<RecordedEvent> &events = {}) const
    {
        const QString path = m_folder.filePath(name);
        writeRecording(path, header, cycles, events);
        return path;
    }

    QTemporaryDir m_folder;
    QString m_path;
};

void TestReplay::initTestCase()
{
    m_path = write(u"arm.mcap"_s, recordingHeader(Devices), Cycles,
                   {{at(100), u"torque"_s, u"XM430-W350 #2: Torque off"_s},
                    {at(200), u"note"_s, u"somebody came in"_s},
                    {at(300), u"reboot"_s, u"XM430-W350 #1: Reboot"_s}});
}

void TestReplay::clock()
{
    ReplayClock clock(10s, 20s);
    QCOMPARE(clock.position(), LineTime(10s));
    QVERIFY(!clock.advance(1s)); // it does not play
    clock.play();
    QVERIFY(clock.advance(1s));
    QCOMPARE(clock.position(), LineTime(11s));
    clock.setSpeed(0.5);
    QVERIFY(clock.advance(1s));
    QCOMPARE(clock.position(), LineTime(11s + 500ms));
    clock.setSpeed(ReplayClock::SlowestSpeed / 1000);
    QCOMPARE(clock.speed(), ReplayClock::SlowestSpeed);
    clock.setSpeed(std::nan(""));
    QCOMPARE(clock.speed(), ReplayClock::SlowestSpeed);
    for (int i = 0; i < 64; ++i)
        clock.advance(1ns); // what is too short adds up
    QCOMPARE(clock.position(), LineTime(11s + 500ms + 1ns));
    clock.setSpeed(2);
    QVERIFY(clock.advance(100s));
    QCOMPARE(clock.position(), LineTime(20s));
    QVERIFY(!clock.isPlaying());
    clock.play(); // once more
    QCOMPARE(clock.position(), LineTime(10s));
    QVERIFY(clock.isPlaying());
    clock.seek(99s);
    QCOMPARE(clock.position(), LineTime(20s));
    clock.seek(-5s);
    QCOMPARE(clock.position(), LineTime(10s));
}

void TestReplay::clockNearItsEnds()
{
    ReplayClock empty(7s, 7s);
    empty.play();
    QVERIFY(!empty.isPlaying());
    ReplayClock turned(7s, 3s);
    QCOMPARE(turned.end(), LineTime(7s));
    ReplayClock wide(LineTime::min() / 4, LineTime::max() / 4);
    wide.setSpeed(ReplayClock::FastestSpeed);
    wide.play();
    QVERIFY(wide.advance(LineTime::max() / 2));
    QCOMPARE(wide.position(), LineTime::max() / 4);
}

void TestReplay::showsDevicesAtOnce()
{
    Room room;
    QVERIFY(room.replayer.open(m_path));
    QCOMPARE(room.session.devices().size(), std::size_t(Devices));
    QCOMPARE(room.session.lines().size(), std::size_t(1));
    QCOMPARE(room.session.lines().front()->name(), u"/dev/ttyUSB0"_s);
    QCOMPARE(room.device(1).id(), std::uint8_t(2));
    QCOMPARE(room.device(1).model(), u"XM430-W350"_s);
    QCOMPARE(room.device(1).raw(Known::TorqueEnable), std::optional<std::int64_t>(1)); // its header says
    QVERIFY(room.replayer.isWhole());
    QCOMPARE(room.replayer.header().notes, u"Line one\nand ünicode"_s);
}

void TestReplay::loadsEverySample()
{
    Room room;
    room.load(m_path);
    QCOMPARE(room.replayer.samples(), quint64(3 * (Devices * Cycles - Cycles / 50)));
    const History &history = room.history(1, u"Present Position");
    QCOMPARE(history.size(), std::size_t(Cycles));
    for (int cycle = 0; cycle < Cycles; ++cycle) {
        const History::Sample sample = history.at(static_cast<std::size_t>(cycle));
        QCOMPARE(std::int64_t(sample.raw), recordedPosition(2, cycle));
        QCOMPARE(sample.at, at(cycle) + 40us);
    }
    const History &last = room.history(2, u"Present Current"); // of who was silent now and then
    QCOMPARE(last.size(), std::size_t(Cycles - Cycles / 50));
    QVERIFY(!last.gapBefore(48));
    QVERIFY(last.gapBefore(49));
    QCOMPARE(room.replayer.percentLoaded(), 100);
}

void TestReplay::holdsWhatWasThen_data()
{
    QTest::addColumn<int>("cycle");
    for (const int cycle : {0, 1, 500, 3999})
        QTest::addRow("%d", cycle) << cycle;
}

void TestReplay::holdsWhatWasThen()
{
    QFETCH(int, cycle);
    Room room;
    room.load(m_path);
    QSignalSpy jumped(&room.replayer, &Replayer::jumped);
    room.replayer.seek(at(cycle) + 500us);
    QCOMPARE(room.session.now(), std::min(at(cycle) + LineTime(500us), room.replayer.clock().end()));
    for (quint32 key = 1; key <= Devices; ++key) {
        const bool silent = key == Devices && cycle % 50 == 49;
        QCOMPARE(room.position(key - 1), recordedPosition(key, silent ? cycle - 1 : cycle));
        QCOMPARE(room.device(key - 1).state(), Device::State::Present);
    }
    const Device &device = room.device(0);
    QCOMPARE(device.value(device.table().indexOf(u"Present Position")).state, FieldState::Fresh);
    const auto newest = room.monitor.newest(room.history(0, u"Present Position"));
    QVERIFY(newest);
    QCOMPARE(newest->at, at(cycle) + 20us);
    QCOMPARE(jumped.count(), cycle > 100 ? 1 : 0);
    QCOMPARE(room.session.wallNow().toMSecsSinceEpoch(),
             (recordingHeader(1).startUnix + (room.session.now() - RecordingBegin).count()) / 1'000'000);
}

void TestReplay::tellsEachReadingWhilePlaying()
{
    Room room;
    room.load(m_path);
    room.replayer.seek(at(1000));
    std::vector<PollValue> told;
    connect(room.session.lines().front().get(), &LineSession::batchTaken, this, [&](const Batch &batch) {
        for (const PollValue &value : batch.values) {
            if (value.device == room.device(0).key() && value.address == 132)
                told.push_back(value);
        }
        QVERIFY(std::ranges::is_sorted(batch.values, {}, &PollValue::at));
    });
    for (int cycle = 1016; cycle <= 1160; cycle += 16)
        room.replayer.seek(at(cycle));
    QCOMPARE(told.size(), std::size_t(160));
    for (std::size_t i = 0; i < told.size(); ++i)
        QCOMPARE(told[i].at, at(1000 + static_cast<int>(i)) + 20us);
}

void TestReplay::tellsWhoIsSilent()
{
    RecorderSettings settings;
    settings.path = m_folder.filePath(u"silent.mcap"_s);
    settings.header = recordingHeader(Devices);
    const auto recorder = Recorder::start(settings).value();
    for (int cycle = 0; cycle < 1000; ++cycle) {
        RecordedBatch batch = recordedBatch(1, cycle);
        if (cycle >= 400 && cycle < 600)
            batch.replies.front().data.clear();
        else
            batch.replies.front().data = motion(1, cycle);
        recorder->add(polled(batch));
    }
    QVERIFY(recorder->wait().error.text.isEmpty());
    Room room;
    room.load(settings.path);
    room.replayer.seek(at(300));
    QCOMPARE(room.device(0).state(), Device::State::Present);
    room.replayer.seek(at(403)); // three answers are missing
    QCOMPARE(room.device(0).state(), Device::State::Silent);
    room.replayer.seek(at(601));
    QCOMPARE(room.device(0).state(), Device::State::Present);
    room.replayer.seek(at(500)); // back into it
    QCOMPARE(room.device(0).state(), Device::State::Silent);
    room.replayer.seek(at(900));
    QCOMPARE(room.device(0).state(), Device::State::Present);
}

void TestReplay::goesBack()
{
    Room room;
    room.load(m_path);
    room.replayer.seek(at(3000) + 500us);
    QCOMPARE(room.position(0), recordedPosition(1, 3000));
    room.replayer.seek(at(2990) + 500us); // less than is told reading by reading
    QCOMPARE(room.position(0), recordedPosition(1, 2990));
    room.replayer.seek(at(10) + 500us);
    QCOMPARE(room.position(0), recordedPosition(1, 10));
}

void TestReplay::steps()
{
    Room room;
    room.load(m_path);
    QVERIFY(room.replayer.busiest());
    room.replayer.seek(at(100) + 500us);
    const LineTime offset = room.monitor.history(*room.replayer.busiest())->at(0).at - at(0);
    room.replayer.step(1);
    QCOMPARE(room.session.now(), at(101) + offset);
    room.replayer.step(-1);
    QCOMPARE(room.session.now(), at(100) + offset);
    room.replayer.seek(at(100) + 500us); // between two
    room.replayer.step(-1);
    QCOMPARE(room.session.now(), at(100) + offset);
    room.replayer.seek(at(0));
    room.replayer.step(-1);
    QCOMPARE(room.session.now(), at(0) + offset);
    room.replayer.play();
    room.replayer.step(5);
    QVERIFY(!room.replayer.clock().isPlaying());
    room.replayer.step(1'000'000);
    QCOMPARE(room.position(0), recordedPosition(1, Cycles - 1));
}

void TestReplay::keepsEvents()
{
    Room room;
    room.load(m_path);
    EventLog log(room.session, nullptr, nullptr);
    log.showRecorded(room.replayer.events());
    QCOMPARE(log.events().size(), std::size_t(3));
    QCOMPARE(log.events()[0].device, room.device(1).key());
    QCOMPARE(log.events()[0].kind, LoggedEvent::Kind::TorqueOff);
    QCOMPARE(log.events()[0].text, u"Torque off"_s);
    QCOMPARE(log.events()[0].at, at(100));
    QCOMPARE(log.events()[1].device, DeviceKey(0));
    QCOMPARE(log.events()[1].text, u"somebody came in"_s);
    QCOMPARE(log.events()[2].kind, LoggedEvent::Kind::Restart);
    // What the replay shows is not noted a second time.
    QSignalSpy added(&log, &EventLog::added);
    Device &device = room.device(0);
    PollValue off;
    off.device = device.key();
    off.address = 64;
    off.length = 1;
    off.data = {0};
    off.at = at(50);
    device.take(off);
    device.setAlert(true);
    QCOMPARE(added.count(), 0);
}

void TestReplay::asksNobody()
{
    Room room;
    room.load(m_path);
    room.monitor.watch({room.device(0).key(), room.device(0).table().indexOf(u"Present Position")});
    room.monitor.setGlancing(true);
    QCoreApplication::processEvents();
    QVERIFY(room.session.lines().front()->pollPlan().spans.empty());
    QVERIFY(!room.device(0).lockReason(room.device(0).table().indexOf(u"Goal Position")).isEmpty());
    Commands commands(room.session);
    std::optional<Result<void>> done;
    commands.setTorque({&room.device(0)}, true, [&done](const Result<void> &result) { done = result; });
    QTRY_VERIFY(done);
    QVERIFY(!*done);
    QVERIFY2((*done).error().text.contains(u"recording"), qPrintable((*done).error().text));
}

void TestReplay::clearsNothing()
{
    Room room;
    room.load(m_path);
    const Watch watch{room.device(0).key(), room.device(0).table().indexOf(u"Present Position")};
    room.monitor.watch(watch);
    room.monitor.unwatch(watch);
    room.monitor.clear();
    QCOMPARE(room.monitor.history(watch)->size(), std::size_t(Cycles));
    room.session.close(*room.session.lines().front());
    QCOMPARE(room.monitor.history(watch)->size(), std::size_t(Cycles));
}

void TestReplay::playsByTheClock()
{
    Room room;
    room.load(m_path);
    QSignalSpy states(&room.replayer, &Replayer::stateChanged);
    QSignalSpy jumps(&room.replayer, &Replayer::jumped);
    room.replayer.setSpeed(100);
    room.replayer.play();
    QVERIFY(room.replayer.clock().isPlaying());
    QTRY_VERIFY(!room.replayer.clock().isPlaying());
    QCOMPARE(room.session.now(), room.replayer.clock().end());
    QCOMPARE(room.position(0), recordedPosition(1, Cycles - 1));
    QCOMPARE(states.count(), 3); // speed, play, end
    QCOMPARE(jumps.count(), 0);  // fast, but on: alarms go on, too
}

/// A line is open only when its thread has begun: what it was told before counts once it is.
void TestReplay::isFreshOnceTheLineIsOpen()
{
    Room room;
    room.load(m_path);
    room.replayer.seek(at(10));
    const Device &device = room.device(0);
    QCOMPARE(device.value(device.table().indexOf(u"Present Current")).state, FieldState::Fresh);
    QCOMPARE(device.value(device.table().indexOf(u"Torque Enable")).state, FieldState::Stale); // of the header
}

void TestReplay::damagedPart()
{
    QFile file(m_path);
    QVERIFY(file.open(QIODevice::ReadOnly));
    QByteArray bytes = file.readAll();
    for (qsizetype i = bytes.size() / 4; i < bytes.size() * 3 / 4; i += 50) // most of it is samples
        bytes[i] = static_cast<char>(bytes[i] ^ 0x5A);
    const QString path = m_folder.filePath(u"damaged.mcap"_s);
    QFile damaged(path);
    QVERIFY(damaged.open(QIODevice::WriteOnly));
    damaged.write(bytes);
    damaged.close();
    Room room;
    room.load(path);
    QVERIFY(room.replayer.damagedParts() > 0);
    QVERIFY(room.replayer.samples() < quint64(3 * Devices * Cycles));
}

void TestReplay::refuses_data()
{
    QTest::addColumn<QByteArray>("content");
    QTest::newRow("empty") << QByteArray();
    QTest::newRow("text") << QByteArray("time,ID 1/Present Position [deg]\n0,1\n");
}

void TestReplay::refuses()
{
    QFETCH(QByteArray, content);
    const QString path = m_folder.filePath(u"other.mcap"_s);
    QFile file(path);
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write(content);
    file.close();
    Room room;
    const Result<void> opened = room.replayer.open(path);
    QVERIFY(!opened);
    QCOMPARE(opened.error().kind, ErrorKind::BadFile);
    QVERIFY(!room.replayer.open(m_folder.filePath(u"none.mcap"_s)));
}

/// Several of one ID, another rate, a model that nobody knows.
void TestReplay::splitsPlacesThatClash()
{
    RecordingHeader header = recordingHeader(Devices);
    header.devices[1].id = 1;
    header.devices[2].baudRate = 57600;
    header.devices[2].modelNumber = 64999;
    header.devices[0].label = u"elbow"_s;
    const QString path = write(u"clash.mcap"_s, header, 100);
    Room room;
    room.load(path);
    QCOMPARE(room.session.devices().size(), std::size_t(Devices));
    QCOMPARE(room.session.lines().size(), std::size_t(3));
    QCOMPARE(room.device(0).displayName(), u"elbow"_s);
    QVERIFY(!room.device(2).isKnownModel());
    QCOMPARE(room.replayer.devices().unplaced, 3); // its table is of bare bytes
    QCOMPARE(room.device(1).state(), Device::State::Present);
}

void TestReplay::refusesMoreThanThereCanBe()
{
    Room room;
    RecordingHeader header;
    for (quint32 key = 1; key <= ReplayDevices::MostLines + 1; ++key) {
        header.devices.push_back(recordedDevice(key));
        header.devices.back().id = 7;
    }
    QCOMPARE(addDevices(room.session, header).error().kind, ErrorKind::BadFile);
    QCOMPARE(room.session.lines().size(), ReplayDevices::MostLines);
    header.devices.assign(ReplayDevices::Most + 1, recordedDevice(1));
    QCOMPARE(addDevices(room.session, header).error().kind, ErrorKind::BadFile);
}

void TestReplay::endsWhileItReads()
{
    for (int i = 0; i < 20; ++i) {
        Room room;
        QVERIFY(room.replayer.open(m_path));
    }
}

DYNASCOPE_CORE_TEST(TestReplay)
#include "tst_replay.moc"
