// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/record/jsonsample.h"
#include "core/record/recordedvalue.h"
#include "core/table/units.h"
#include "tests/support/builtincatalog.h"
#include "tests/support/recordings.h"
#include "tests/support/sanitized.h"
#include "tests/support/testmain.h"

#include <QBuffer>

using namespace Qt::StringLiterals;
using namespace dynascope;
using namespace dynascope::test;

namespace {

QByteArray contentOf(const QString &path)
{
    QFile file(path);
    return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
}

Result<std::unique_ptr<Recording>> opened(const QByteArray &content)
{
    auto buffer = std::make_unique<QBuffer>();
    buffer->setData(content);
    buffer->open(QIODevice::ReadOnly);
    return Recording::open(std::move(buffer), u"f"_s);
}

} // namespace

/// The files of core/record: what is written is read, whole or cut off.
class TestRecording : public QObject
{
    Q_OBJECT

private slots:
    void init() { m_folder = std::make_unique<QTemporaryDir>(); }

    void everyRawValueComesBack_data();
    void everyRawValueComesBack();
    void everyFieldOfEveryTable();
    void readsWhatWasWritten();
    void keepsWhateverComesTogether();
    void keepsEventsAndLaterDevices();
    void seeks();
    void opensCutOffAnywhere();
    void passesOverADamagedPart();
    void refusesWhatIsNone_data();
    void refusesWhatIsNone();
    void refusesToWriteOver();
    void writesCsv();
    void makesBatches();
    void makesJson();

private:
    QString path(const QString &name) const { return m_folder->filePath(name); }
    /// A recording of `cycles`, flushed each `flushEach`, and ended or not.
    void write(const QString &to, quint32 devices, int cycles, int flushEach, bool finish)
    {
        auto sink = createRecording(to, recordingHeader(devices));
        QVERIFY2(sink, sink ? "" : qPrintable(sink.error().text));
        for (int cycle = 0; cycle < cycles; ++cycle) {
            QVERIFY((*sink)->write(recordedBatch(devices, cycle)));
            if ((cycle + 1) % flushEach == 0)
                QVERIFY((*sink)->flush());
        }
        if (finish)
            QVERIFY((*sink)->finish());
    }

    std::unique_ptr<QTemporaryDir> m_folder;
};

void TestRecording::everyRawValueComesBack_data()
{
    QTest::addColumn<int>("size");
    QTest::addColumn<bool>("isSigned");
    QTest::addColumn<int>("directionBit");
    QTest::addColumn<double>("scale");
    for (const int size : {1, 2, 4}) {
        for (const double scale : {1.0, 0.1, 2.69, 0.229, 360.0 / 4096, 0.113, 360.0 / 1'003'846, 214.577, -0.5}) {
            QTest::addRow("%d bytes, %g", size, scale) << size << false << -1 << scale;
            QTest::addRow("%d bytes, signed, %g", size, scale) << size << true << -1 << scale;
        }
    }
    QTest::addRow("direction") << 2 << false << 10 << 0.111;
    QTest::addRow("direction, highest") << 2 << false << 15 << 0.111;
}

/// By way of the message, in which it is a number of single or double precision.
void TestRecording::everyRawValueComesBack()
{
    QFETCH(int, size);
    QFETCH(bool, isSigned);
    QFETCH(int, directionBit);
    QFETCH(double, scale);
    const RecordedField field{u"F"_s, 10, static_cast<std::uint8_t>(size), isSigned, directionBit, u"V"_s, scale, 2};
    const ValueLayout layout(10, static_cast<std::uint16_t>(size), {{1, u"id_1"_s, {field}}});
    Bytes registers, message;
    std::vector<RecordedReply> back;
    const std::uint64_t end = std::uint64_t(1) << (8 * size);
    const std::uint64_t step = size == 4 ? 524'287 : size == 2 ? 3 : 1; // primes
    for (std::uint64_t bits = 0; bits < end; bits += step) {
        registers.clear();
        appendLittleEndian(registers, static_cast<std::uint32_t>(bits), size);
        const RecordedReply reply{1, 10, static_cast<std::uint16_t>(size), registers, 7ms};
        layout.encode({&reply}, 2ms, message);
        back.clear();
        QVERIFY(layout.decode(message, 2ms, back));
        if (!(back[0] == reply))
            QFAIL(qPrintable(u"%1"_s.arg(bits)));
    }
}

/// Its physical value is the one that everything else shows.
void TestRecording::everyFieldOfEveryTable()
{
    const Catalog catalog = builtInCatalog();
    int fields = 0;
    for (const Catalog::ModelInfo &model : catalog.models()) {
        const ControlTablePtr table = catalog.find(model.modelNumber, 50);
        if (!table)
            continue;
        for (const Field &field : table->fields()) {
            const EffectiveField units = effective(field, {});
            const RecordedField recorded = recordedField(field, units, table->resolution());
            QCOMPARE(fieldFromLine(toLine(recorded)), std::optional(recorded));
            const std::int64_t raw = std::min<std::int64_t>(largestRaw(field), 1234);
            if (recorded.unit.isEmpty())
                continue;
            ++fields;
            const double shown = physical(units, table->resolution(), raw).value;
            const double written = physicalValue(recorded, raw);
            QVERIFY2(std::abs(written - shown) <= 1e-9 * std::abs(shown), qPrintable(field.name));
        }
    }
    QVERIFY(fields > 500);
}

void TestRecording::readsWhatWasWritten()
{
    write(path(u"a.mcap"_s), 3, 1000, 200, true);
    const auto recording = Recording::open(path(u"a.mcap"_s));
    QVERIFY2(recording, recording ? "" : qPrintable(recording.error().text));
    const RecordingHeader wanted = recordingHeader(3);
    const RecordingHeader &header = (*recording)->header();
    QVERIFY((*recording)->isWhole());
    QCOMPARE(header.startUnix, wanted.startUnix);
    QCOMPARE(header.startLine, wanted.startLine);
    QCOMPARE(header.program, wanted.program);
    QCOMPARE(header.name, wanted.name);
    QCOMPARE(header.notes, wanted.notes);
    QVERIFY(header.devices == wanted.devices);
    QCOMPARE((*recording)->parts(), std::size_t(5));
    QCOMPARE((*recording)->messages(), quint64(1000));
    QCOMPARE((*recording)->begin(), RecordingBegin);
    QCOMPARE((*recording)->end(), RecordingBegin + 999ms);
    const auto all = allBatches(**recording);
    QCOMPARE(all.size(), std::size_t(1000));
    for (int cycle = 0; cycle < 1000; ++cycle)
        QVERIFY2(all[std::size_t(cycle)] == recordedBatch(3, cycle), qPrintable(QString::number(cycle)));
}

/// Fields at rates of their own, devices that aren't asked for a while, one twice in a cycle: more sets of devices than
/// there are channels for.
void TestRecording::keepsWhateverComesTogether()
{
    std::mt19937 random(7);
    std::vector<RecordedBatch> written;
    {
        auto sink = createRecording(path(u"a.mcap"_s), recordingHeader(8)).value();
        for (int cycle = 0; cycle < 400; ++cycle) {
            RecordedBatch batch = recordedBatch(8, cycle);
            std::erase_if(batch.replies, [&](const RecordedReply &) { return random() % 3 == 0; });
            if (random() % 2 == 0)
                batch.replies.push_back({1 + quint32(random() % 8), 132, 4, {1, 2, 3, 4}, batch.begin + 2s});
            if (random() % 5 == 0)
                batch.replies.push_back({3, 132, 4, {}, batch.begin + 3ms});
            if (random() % 7 == 0 && !batch.replies.empty())
                batch.replies.push_back(batch.replies.front());
            QVERIFY(sink->write(batch));
            if (!batch.replies.empty())
                written.push_back(batch);
        }
        QVERIFY(sink->write(RecordedBatch{1000, RecordingBegin + 1s, {{1, 0, 2, {1, 2}, {}}, {99, 126, 10, {}, {}}}}));
        QVERIFY(sink->finish());
    }
    const auto recording = Recording::open(path(u"a.mcap"_s)).value();
    auto read = allBatches(*recording);
    QCOMPARE(read.size(), written.size());
    const auto sorted = [](RecordedBatch batch) {
        std::stable_sort(batch.replies.begin(), batch.replies.end(), [](const auto &a, const auto &b) {
            return std::pair(a.device, a.address) < std::pair(b.device, b.address);
        });
        return batch;
    };
    for (std::size_t i = 0; i < read.size(); ++i)
        QVERIFY2(sorted(read[i]) == sorted(written[i]), qPrintable(QString::number(i)));
    QVERIFY(recording->header().devices == recordingHeader(8).devices);
}

void TestRecording::keepsEventsAndLaterDevices()
{
    {
        auto sink = createRecording(path(u"a.mcap"_s), recordingHeader(1)).value();
        QVERIFY(sink->write(recordedBatch(1, 0)));
        QVERIFY(sink->write(RecordedEvent{RecordingBegin + 500us, u"note"_s, u"it squeaks, näh"_s}));
        QVERIFY(sink->setDevice(recordedDevice(2)).value());
        RecordedDevice renamed = recordedDevice(1);
        renamed.fields.pop_back();
        QVERIFY(sink->setDevice(renamed).value());
        QVERIFY(sink->write(recordedBatch(2, 1)));
        QVERIFY(sink->finish());
    }
    const auto recording = Recording::open(path(u"a.mcap"_s)).value();
    QCOMPARE(recording->header().devices.size(), std::size_t(2));
    ReplaySource source(*recording);
    QVERIFY(source.next() == recordedBatch(1, 0));
    QVERIFY(source.takeEvents().empty());
    auto second = recordedBatch(2, 1);
    std::fill(second.replies[0].data.begin() + 6, second.replies[0].data.end(), std::uint8_t(0)); // no longer recorded
    QVERIFY(source.next() == second);
    const auto events = source.takeEvents();
    QCOMPARE(events.size(), std::size_t(1));
    QVERIFY((events[0] == RecordedEvent{RecordingBegin + 500us, u"note"_s, u"it squeaks, näh"_s}));
    QVERIFY(!source.next());
}

void TestRecording::seeks()
{
    write(path(u"a.mcap"_s), 2, 1000, 100, true);
    const auto recording = Recording::open(path(u"a.mcap"_s)).value();
    ReplaySource source(*recording);
    for (const int cycle : {0, 1, 99, 100, 101, 550, 999, 5}) {
        source.seek(RecordingBegin + cycle * LineTime(1ms));
        const auto batch = source.next();
        QVERIFY(batch);
        QCOMPARE(batch->cycle, std::uint32_t(cycle));
    }
    source.seek(RecordingBegin + 1000ms);
    QVERIFY(!source.next());
    source.seek(RecordingBegin - 1h);
    QCOMPARE(source.next()->cycle, std::uint32_t(0));
}

/// As a pulled plug would leave it: all that stands whole in the file is there.
void TestRecording::opensCutOffAnywhere()
{
    for (const bool finished : {true, false}) {
        const QString file = path(finished ? u"whole.mcap"_s : u"cut.mcap"_s);
        write(file, 2, 200, 20, finished);
        const QByteArray content = contentOf(file);
        const auto whole = opened(content).value();
        QCOMPARE(whole->isWhole(), finished);
        QCOMPARE(allBatches(*whole).size(), std::size_t(200));
        QCOMPARE(whole->messages(), quint64(200));
        std::size_t last = 200;
        const qsizetype step = test::Sanitized ? 41 : 1;
        for (qsizetype size = content.size() - 1; size >= content.size() - 3500; size -= step) {
            const auto recording = opened(content.left(size));
            QVERIFY2(recording, recording ? "" : qPrintable(recording.error().text));
            QVERIFY(!(*recording)->isWhole());
            QVERIFY((*recording)->header().devices == recordingHeader(2).devices);
            const auto batches = allBatches(**recording);
            QVERIFY(batches.size() <= last && batches.size() % 20 == 0);
            last = batches.size();
            for (std::size_t i = 0; i < batches.size(); ++i)
                QVERIFY(batches[i] == recordedBatch(2, int(i)));
        }
        QVERIFY(last < 200);
    }
}

void TestRecording::passesOverADamagedPart()
{
    write(path(u"a.mcap"_s), 2, 100, 20, true);
    QByteArray content = contentOf(path(u"a.mcap"_s));
    const qsizetype frame = content.indexOf(QByteArray::fromHex("28b52ffd"), 2000); // of one of the first chunks
    QVERIFY(frame > 0);
    content[frame + 40] = char(content[frame + 40] ^ 0x10);
    const auto recording = opened(content).value();
    ReplaySource source(*recording);
    int count = 0;
    while (const auto batch = source.next()) {
        QVERIFY(*batch == recordedBatch(2, int(batch->cycle)));
        ++count;
    }
    QCOMPARE(count, 80);
    QCOMPARE(source.damagedParts(), std::size_t(1));
}

void TestRecording::refusesWhatIsNone_data()
{
    QTest::addColumn<QByteArray>("content");
    QTest::addColumn<QString>("reason");
    QByteArray magic;
    for (const std::uint8_t byte : mcap::Magic)
        magic += char(byte);
    const QString noMcap = u"f: this is no MCAP file"_s;
    const QString notOurs = u"f: this MCAP file is no recording of Dynascope"_s;
    QTest::addRow("empty") << QByteArray() << noMcap;
    QTest::addRow("text") << QByteArray("unix_time_s,a\n1,2\n") << noMcap;
    QTest::addRow("magic") << magic << notOurs;
    QTest::addRow("magic twice") << magic + magic << notOurs;
    QTest::addRow("a record of 16 EiB") << magic + QByteArray("\x0C\xFF\xFF\xFF\xFF\xFF\xFF\xFF\xFF", 9) + magic << notOurs;
    QTest::addRow("zeros") << magic + QByteArray(1000, '\0') << notOurs;
}

void TestRecording::refusesWhatIsNone()
{
    QFETCH(QByteArray, content);
    QFETCH(QString, reason);
    const auto recording = opened(content);
    QVERIFY(!recording);
    QCOMPARE(recording.error().kind, ErrorKind::BadFile);
    QCOMPARE(recording.error().text, reason);
}

void TestRecording::refusesToWriteOver()
{
    for (const QString &name : {u"a.mcap"_s, u"a.csv"_s}) {
        write(path(name), 1, 1, 1, true);
        const auto again = createRecording(path(name), recordingHeader(1));
        QVERIFY(!again);
        QCOMPARE(again.error().text, path(name) + u": it is there already, and is not written over"_s);
        const auto nowhere = createRecording(path(u"no/"_s + name), recordingHeader(1));
        QVERIFY(!nowhere);
        QCOMPARE(nowhere.error().text, path(u"no"_s) + u": there is no such folder"_s);
    }
}

void TestRecording::writesCsv()
{
    auto sink = createRecording(path(u"a.csv"_s), recordingHeader(2)).value();
    RecordedBatch batch = recordedBatch(2, 0);
    batch.begin += 1500us;
    batch.replies[1].data.clear();
    QVERIFY(sink->write(batch));
    batch.replies[1] = {2, 132, 4, {0xFF, 0xFF, 0xFF, 0xFF}, batch.begin};
    batch.replies.push_back({2, 132, 4, {0, 0, 0, 0}, batch.begin}); // twice in a cycle
    batch.replies.push_back({7, 132, 4, {0, 0, 0, 0}, batch.begin}); // nobody we know
    QVERIFY(sink->write(batch));
    QVERIFY(sink->setDevice(recordedDevice(1)).value());
    RecordedDevice other = recordedDevice(1);
    other.fields.pop_back();
    QVERIFY(!sink->setDevice(other).value());
    QVERIFY(!sink->setDevice(recordedDevice(3)).value());
    QVERIFY(sink->finish());
    const auto first = motion(1, 0);
    const auto current = static_cast<std::int16_t>(littleEndian(first, 2));
    const QString values = u"%1,%2,%3"_s.arg(current * 2.69, 0, 'f', 2)
                               .arg(int(littleEndian(ByteView(first).subspan(2), 4)) * 0.229, 0, 'f', 3)
                               .arg(int(littleEndian(ByteView(first).subspan(6), 4)) * 360.0 / 4096, 0, 'f', 2);
    const QStringList lines = QString::fromUtf8(contentOf(path(u"a.csv"_s))).split(u'\n');
    QCOMPARE(lines.size(), 5);
    QCOMPARE(lines[0], u"unix_time_s,ID 1/Present Current [mA],ID 1/Present Velocity [rev/min],"
                       u"ID 1/Present Position [deg],ID 2/Present Current [mA],ID 2/Present Velocity [rev/min],"
                       u"ID 2/Present Position [deg]"_s);
    QCOMPARE(lines[1], u"1790000000.124956789,"_s + values + u",,,"_s);
    QCOMPARE(lines[2], u"1790000000.124956789,"_s + values + u",,,-0.09"_s);
    QCOMPARE(lines[3], u"1790000000.124956789,,,,,,0.00"_s);
}

/// Only what was recorded, never the zeros between.
void TestRecording::makesBatches()
{
    RecordingHeader header = recordingHeader(1);
    header.devices[0].fields.erase(header.devices[0].fields.begin() + 1);
    const Batch batch = batchOf(recordedBatch(1, 7), header);
    QCOMPARE(batch.cycle, quint64(7));
    QCOMPARE(batch.values.size(), std::size_t(2));
    const Bytes data = motion(1, 7);
    QCOMPARE(batch.values[0].address, std::uint16_t(126));
    QVERIFY(batch.values[0].data == Bytes(data.begin(), data.begin() + 2));
    QCOMPARE(batch.values[1].address, std::uint16_t(132));
    QVERIFY(batch.values[1].data == Bytes(data.begin() + 6, data.end()));
    const Batch silent = batchOf(recordedBatch(1, 49), header);
    QCOMPARE(silent.values.size(), std::size_t(2));
    QVERIFY(silent.values[0].data.empty() && !silent.values[0].error.text.isEmpty());
    QCOMPARE(silent.values[0].length, std::uint16_t(2));
}

void TestRecording::makesJson()
{
    RecordingHeader header = recordingHeader(2);
    header.devices[1].label = u"left \"arm\""_s;
    RecordedBatch batch{0, RecordingBegin, {{1, 132, 4, {0, 8, 0, 0}, {}}, {2, 126, 2, {0xFF, 0xFF}, {}}, {2, 132, 4, {}, {}}}};
    QCOMPARE(jsonSamples(batch, header, 1000),
             QByteArrayList{R"({"timestamp":1790000000.123457,"ID 1":{"Present Position":180.00},)"
                            R"("left \"arm\"":{"Present Current":-2.69}})"});
    QCOMPARE(jsonSamples(batch, header, 80).size(), 2); // as much as a datagram holds
    batch.replies.resize(3);
    batch.replies.erase(batch.replies.begin(), batch.replies.begin() + 2);
    QVERIFY(jsonSamples(batch, header, 1000).isEmpty());
}

DYNASCOPE_CORE_TEST(TestRecording)
#include "tst_recording.moc"
