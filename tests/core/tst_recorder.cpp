// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/batch_values.h"
#include "core/record/recordwriter.h"
#include "tests/support/recordings.h"
#include "tests/support/testmain.h"

#include <QDateTime>
#include <QSignalSpy>

#include <csignal>

#include <sys/resource.h>

using namespace Qt::StringLiterals;
using namespace dynascope;
using namespace dynascope::test;

namespace {

constexpr int Devices = 4;
constexpr int SamplesACycle = Devices * 3;

Batch polled(int cycle)
{
    return test::polled(recordedBatch(Devices, cycle));
}

/// As long as this lives no file of this process may grow beyond `bytes`.
class FileLimit
{
public:
    explicit FileLimit(rlim_t bytes)
    {
        m_handler = std::signal(SIGXFSZ, SIG_IGN); // then write(2) fails
        ::getrlimit(RLIMIT_FSIZE, &m_before);
        const rlimit limit{bytes, m_before.rlim_max};
        ::setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~FileLimit()
    {
        ::setrlimit(RLIMIT_FSIZE, &m_before);
        std::signal(SIGXFSZ, m_handler);
    }

private:
    rlimit m_before{};
    void (*m_handler)(int);
};

} // namespace

class TestRecorder : public QObject
{
    Q_OBJECT

private slots:
    void init() { m_folder = std::make_unique<QTemporaryDir>(); }
    void recordsAll();
    void recordsOnceWhatOneReplyBrought();
    void isOnTheDiskWithinASecond();
    void isWholeWithoutASample();
    void splits_data();
    void splits();
    void splitsCsvForANewDevice();
    void saysThatTheDiskIsFull();
    void saysWhatWasLost();
    void namesFiles();

private:
    RecorderSettings settings(const QString &name) const
    {
        RecorderSettings result;
        result.path = m_folder->filePath(name);
        result.header = recordingHeader(Devices);
        return result;
    }
    std::unique_ptr<QTemporaryDir> m_folder;
};

void TestRecorder::recordsAll()
{
    auto recorder = Recorder::start(settings(u"a.mcap"_s)).value();
    QSignalSpy finished(recorder.get(), &Recorder::finished);
    for (int cycle = 0; cycle < 3000; ++cycle)
        recorder->add(polled(cycle));
    recorder->add(RecordedEvent{RecordingBegin + 1s, u"note"_s, u"here"_s});
    Batch strange = polled(3000);
    for (PollValue &value : strange.values)
        value.device += 100;
    recorder->add(strange);
    QVERIFY(recorder->isRunning());
    recorder->finish();
    QTRY_COMPARE(finished.count(), 1);
    recorder->add(polled(3001)); // too late
    const RecorderStatus status = recorder->wait();
    QVERIFY(status.error.text.isEmpty());
    QCOMPARE(status.samples + 3 * status.missed, quint64(3000 * SamplesACycle));
    QCOMPARE(status.missed, quint64(3000 / 50));
    QCOMPARE(status.lost, quint64(SamplesACycle));
    QCOMPARE(status.files, 1);
    QCOMPARE(status.bytes, QFile(status.path).size());
    const auto recording = Recording::open(status.path).value();
    QVERIFY(recording->isWhole());
    const auto all = allBatches(*recording);
    QCOMPARE(all.size(), std::size_t(3000));
    for (int cycle = 0; cycle < 3000; ++cycle)
        QVERIFY(all[std::size_t(cycle)] == recordedBatch(Devices, cycle));
}

/// A span of the plan that lies in another is answered by the same reply, and stands in the batch once more.
void TestRecorder::recordsOnceWhatOneReplyBrought()
{
    auto recorder = Recorder::start(settings(u"a.mcap"_s)).value();
    Batch batch = polled(1);
    PollValue part = batch.values.front();
    QVERIFY(part.data.size() > 2);
    part.data.resize(part.data.size() - 1);
    PollValue later = part;
    later.at += 1ms; // another reply: another sample
    batch.values.insert(batch.values.begin(), part);
    batch.values.push_back(batch.values[1]); // the same once more
    recorder->add(batch);
    const RecorderStatus status = recorder->wait();
    QCOMPARE(status.samples, quint64(SamplesACycle));
    const auto all = allBatches(*Recording::open(status.path).value());
    QCOMPARE(all.size(), std::size_t(1));
    QVERIFY(all.front() == recordedBatch(Devices, 1));
    batch.values.push_back(later);
    QVERIFY(!standsInAnother(batch, batch.values.back()));
}

void TestRecorder::isOnTheDiskWithinASecond()
{
    auto recorder = Recorder::start(settings(u"a.mcap"_s)).value();
    const QString path = recorder->status().path;
    QCOMPARE(allBatches(*Recording::open(path).value()).size(), std::size_t(0)); // begun, and says of whom
    recorder->add(polled(0));
    QTRY_COMPARE(allBatches(*Recording::open(path).value()).size(), std::size_t(1));
    QVERIFY(!Recording::open(path).value()->isWhole());
    recorder->add(polled(1));
    QTRY_COMPARE(allBatches(*Recording::open(path).value()).size(), std::size_t(2));
    recorder->wait(); // nothing has come since
    QVERIFY(Recording::open(path).value()->isWhole());
}

void TestRecorder::isWholeWithoutASample()
{
    auto recorder = Recorder::start(settings(u"a.mcap"_s)).value();
    const QString path = recorder->wait().path;
    QVERIFY(Recording::open(path).value()->isWhole());
}

void TestRecorder::splits_data()
{
    QTest::addColumn<QString>("name");
    QTest::addColumn<qint64>("bytes");
    QTest::addColumn<int>("milliseconds");
    QTest::addRow("by time") << u"a.mcap"_s << qint64(0) << 1000;
    QTest::addRow("by size") << u"a.mcap"_s << qint64(50'000) << 0;
    QTest::addRow("csv by time") << u"a.csv"_s << qint64(0) << 1000;
    QTest::addRow("csv by size") << u"a.csv"_s << qint64(200'000) << 0;
}

void TestRecorder::splits()
{
    QFETCH(QString, name);
    QFETCH(qint64, bytes);
    QFETCH(int, milliseconds);
    RecorderSettings wanted = settings(name);
    wanted.splitBytes = bytes;
    wanted.splitAfter = std::chrono::milliseconds(milliseconds);
    auto recorder = Recorder::start(wanted).value();
    constexpr int Cycles = 20'000; // more than a chunk
    for (int cycle = 0; cycle < Cycles; ++cycle)
        recorder->add(polled(cycle));
    const RecorderStatus status = recorder->wait();
    QVERIFY2(status.error.text.isEmpty(), qPrintable(status.error.text));
    QVERIFY(status.files > 1);
    if (milliseconds > 0)
        QCOMPARE(status.files, 20);
    int next = 0;
    qint64 size = 0;
    for (int number = 1; number <= status.files; ++number) {
        QString path = wanted.path;
        if (number > 1)
            path.insert(path.lastIndexOf(u'.'), u"_%1"_s.arg(number));
        QFile file(path);
        size += file.size();
        if (name.endsWith(u".csv")) {
            QVERIFY(file.open(QIODevice::ReadOnly));
            const auto lines = file.readAll().split('\n');
            QVERIFY(lines.front().startsWith("unix_time_s,"));
            next += int(lines.size()) - 2;
            continue;
        }
        for (const RecordedBatch &batch : allBatches(*Recording::open(path).value()))
            QVERIFY(batch == recordedBatch(Devices, next++));
    }
    QCOMPARE(next, Cycles);
    QCOMPARE(size, status.bytes);
}

void TestRecorder::splitsCsvForANewDevice()
{
    auto recorder = Recorder::start(settings(u"a.csv"_s)).value();
    recorder->add(polled(0));
    recorder->setDevice(recordedDevice(1)); // as it was
    recorder->setDevice(recordedDevice(Devices + 1));
    recorder->add(polled(1));
    const RecorderStatus status = recorder->wait();
    QCOMPARE(status.files, 2);
    QFile second(m_folder->filePath(u"a_2.csv"_s));
    QVERIFY(second.open(QIODevice::ReadOnly));
    QVERIFY(second.readLine().contains("ID 5/Present Position [deg]"));
}

/// And what is there stays readable, to the last sample that counts as written.
void TestRecorder::saysThatTheDiskIsFull()
{
    for (const QString &name : {u"a.mcap"_s, u"a.csv"_s}) {
        const FileLimit limit(100'000);
        auto recorder = Recorder::start(settings(name)).value();
        QSignalSpy failed(recorder.get(), &Recorder::failed);
        constexpr int Cycles = 20'000;
        for (int cycle = 0; cycle < Cycles; ++cycle)
            recorder->add(polled(cycle));
        QTRY_COMPARE(failed.count(), 1);
        QVERIFY(!recorder->isRunning());
        const RecorderStatus status = recorder->wait();
        QCOMPARE(status.error.text, status.path + u": this disk takes no file as large as that"_s);
        QCOMPARE(status.samples + status.lost, quint64(Cycles * SamplesACycle - 3 * (Cycles / 50)));
        QVERIFY(QFile(status.path).size() <= 100'000);
        QCOMPARE(status.bytes, QFile(status.path).size());
        if (name.endsWith(u".csv"))
            continue;
        quint64 samples = 0;
        for (const RecordedBatch &batch : allBatches(*Recording::open(status.path).value())) {
            for (const RecordedReply &reply : batch.replies)
                samples += reply.data.empty() ? 0 : 3;
        }
        QCOMPARE(samples, status.samples);
    }
}

/// A disk that does not keep up: nobody waits for it, and the recording says where something is missing.
void TestRecorder::saysWhatWasLost()
{
    auto queue = std::make_shared<RecordQueue>();
    RecordWriter writer(settings(u"a.mcap"_s), queue, [](const Error &) {});
    QVERIFY(writer.open());
    int taken = 0;
    for (int cycle = 0;; ++cycle) {
        RecordedBatch batch = recordedBatch(Devices, cycle);
        for (RecordedReply &reply : batch.replies)
            reply.data.reserve(100'000); // else it takes long
        if (!queue->push(std::move(batch), SamplesACycle))
            break;
        ++taken;
        QVERIFY(cycle < 1'000'000);
    }
    QCOMPARE(queue->status().lost, quint64(SamplesACycle));
    QVERIFY(queue->push(recordedDevice(9), 0)); // what it means is never lost
    queue->close();
    writer.run();
    QCOMPARE(queue->status().lost, quint64(SamplesACycle));
    const auto recording = Recording::open(queue->status().path).value();
    ReplaySource source(*recording);
    int count = 0;
    while (const auto batch = source.next())
        QVERIFY(*batch == recordedBatch(Devices, count++));
    QCOMPARE(count, taken);
    const auto events = source.takeEvents();
    QCOMPARE(events.size(), std::size_t(1));
    QCOMPARE(events[0].text, u"12 samples are missing here: the disk did not keep up"_s);
    QVERIFY(recording->header().device(9));
}

void TestRecorder::namesFiles()
{
    const QDateTime time(QDate(2026, 3, 1), QTime(14, 5, 9));
    const QString folder = m_folder->path();
    const QString first = automaticName(folder, u"/dev/ttyUSB0"_s, time);
    QCOMPARE(first, folder + u"/ttyUSB0_2026-03-01_14-05-09.mcap"_s);
    QFile file(first);
    QVERIFY(file.open(QIODevice::WriteOnly));
    QCOMPARE(automaticName(folder, u"/dev/ttyUSB0"_s, time), folder + u"/ttyUSB0_2026-03-01_14-05-09-2.mcap"_s);
    QCOMPARE(automaticName(folder, u"my arm: left"_s, time, u"csv"_s), folder + u"/my_arm__left_2026-03-01_14-05-09.csv"_s);
    QCOMPARE(automaticName(folder, QString(), time), folder + u"/recording_2026-03-01_14-05-09.mcap"_s);
}

DYNASCOPE_CORE_TEST(TestRecorder)
#include "tst_recorder.moc"
