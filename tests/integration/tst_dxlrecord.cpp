// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/record/recording.h"
#include "tests/support/dxlbus.h"
#include "tests/support/testmain.h"

#include <QElapsedTimer>
#include <QJsonDocument>
#include <QJsonObject>

using namespace Qt::StringLiterals;
using namespace dynascope;
using dynascope::test::DxlBus;
using dynascope::test::isOneSentence;
using dynascope::test::Outcome;
using dynascope::test::RunningDxl;

/// `dxl record`, `replay` and `convert` over a terminal.
class TestDxlRecord : public QObject
{
    Q_OBJECT

private slots:
    void init()
    {
        m_folder = std::make_unique<QTemporaryDir>();
        m_bus = std::make_unique<DxlBus>(u"XM430-W350@57600:1,XM430-W350@57600:2"_s);
        QVERIFY(!m_bus->path().isEmpty());
    }
    void cleanup() { m_bus.reset(); }

    /// Samples recorded = samples on the wire, none lost or doubled.
    void recordsWhatIsOnTheWire()
    {
        const QString file = m_folder->filePath(u"a.mcap"_s);
        const Outcome outcome = m_bus->dxl({u"--json"_s, u"record"_s, u"present_position"_s, u"present_current"_s,
                                            u"--seconds"_s, u"2"_s, u"-o"_s, file, u"--note"_s, u"two arms"_s});
        QVERIFY2(outcome.code == 0, qPrintable(outcome.err));
        const QJsonObject said = QJsonDocument::fromJson(outcome.out.toUtf8()).object();
        const quint64 asked = cyclesOnTheWire();
        QVERIFY(asked > 3);
        const auto recording = Recording::open(file).value();
        QVERIFY(recording->isWhole());
        QCOMPARE(recording->header().notes, u"two arms"_s);
        QCOMPARE(recording->header().devices.size(), std::size_t(2));
        QVERIFY(!recording->header().devices[0].image.empty());
        ReplaySource source(*recording);
        quint64 samples = 0, missed = 0;
        std::optional<std::uint32_t> last;
        while (const auto batch = source.next()) {
            QVERIFY(!last || batch->cycle == *last + 1);
            last = batch->cycle;
            for (const RecordedReply &reply : batch->replies)
                (reply.data.empty() ? missed : samples) += reply.data.empty() ? 1 : 2;
        }
        QCOMPARE(samples + 2 * missed, 2 * 2 * asked);
        QCOMPARE(quint64(said[u"samples"].toInteger()), samples);
        QCOMPARE(quint64(said[u"missed"].toInteger()), missed);
        QCOMPARE(said[u"lost"].toInteger(), 0);
    }

    /// Killed in the middle: what was read a second before is there, and convert makes it whole.
    void losesASecondAtMost()
    {
        const QString file = m_folder->filePath(u"a.mcap"_s);
        {
            RunningDxl running(m_bus->with({u"record"_s, u"present_position"_s, u"--ids"_s, u"1"_s, u"-o"_s, file}));
            QTRY_VERIFY(QFile::exists(file));
            QTRY_VERIFY(batchesIn(file) > 0);
        } // signal 9
        const quint64 cycles = batchesIn(file);
        QVERIFY(!Recording::open(file).value()->isWhole());
        const QString whole = m_folder->filePath(u"whole.mcap"_s);
        const Outcome outcome = test::dxl({u"convert"_s, file, whole});
        QCOMPARE(outcome.code, 0);
        QVERIFY2(outcome.err.contains(u"was cut off"), qPrintable(outcome.err));
        QCOMPARE(outcome.out, u"%1 poll cycles in %2\n"_s.arg(cycles).arg(whole));
        QVERIFY(Recording::open(whole).value()->isWhole());
        QCOMPARE(batchesIn(whole), cycles);
    }

    void replaysAndConverts()
    {
        const QString file = m_folder->filePath(u"a.mcap"_s), csv = m_folder->filePath(u"a.csv"_s);
        QCOMPARE(m_bus->dxl({u"record"_s, u"present_position"_s, u"present_input_voltage"_s, u"--ids"_s, u"1"_s,
                             u"--seconds"_s, u"0.5"_s, u"--rate"_s, u"20"_s, u"-o"_s, file})
                     .code,
                 0);
        const Outcome text = test::dxl({u"replay"_s, file, u"--speed"_s, u"max"_s, u"--count"_s, u"1"_s});
        QCOMPARE(text.code, 0);
        QCOMPARE(text.out.section(u' ', 1), u" ID 1: Present Position = 180.00 deg  ID 1: Present Input Voltage = 12.0 V\n"_s);
        QCOMPARE(test::dxl({u"convert"_s, file, csv}).code, 0);
        QFile table(csv);
        QVERIFY(table.open(QIODevice::ReadOnly));
        QCOMPARE(table.readLine(), "unix_time_s,ID 1/Present Position [deg],ID 1/Present Input Voltage [V]\n");
        QVERIFY(table.readLine().endsWith(",180.00,12.0\n"));
    }

    void refuses()
    {
        const Outcome field = m_bus->dxl(u"record nonsense");
        QCOMPARE(field.code, 2);
        QVERIFY2(field.err.endsWith(u"dxl: none of the devices has a field \"nonsense\"\n"), qPrintable(field.err));
        const Outcome suffix = m_bus->dxl(u"record present_position -o a.txt");
        QCOMPARE(suffix.code, 2);
        const Outcome place = m_bus->dxl(u"record present_position --udp nowhere");
        QCOMPARE(place.code, 2);
        const Outcome folder = m_bus->dxl(u"record present_position -o /no/where.mcap --seconds 1");
        QCOMPARE(folder.code, 1);
        QVERIFY2(folder.err.endsWith(u"dxl: /no: there is no such folder\n"), qPrintable(folder.err));
        QCOMPARE(test::dxl({u"replay"_s, m_folder->filePath(u"none.mcap"_s)}).code, 1);
    }

private:
    quint64 cyclesOnTheWire()
    {
        quint64 count = 0;
        for (const Bytes &packet : m_bus->sent()) // Sync Read, Fast Sync Read from 126 on
            count += packet.size() > 9 && (packet[7] == 0x82 || packet[7] == 0x8A) && packet[8] == 126 ? 1 : 0;
        return count;
    }
    static quint64 batchesIn(const QString &file)
    {
        const auto recording = Recording::open(file);
        if (!recording)
            return 0;
        ReplaySource source(**recording);
        quint64 count = 0;
        while (source.next())
            ++count;
        return count;
    }
    std::unique_ptr<QTemporaryDir> m_folder;
    std::unique_ptr<DxlBus> m_bus;
};

DYNASCOPE_CORE_TEST(TestDxlRecord)
#include "tst_dxlrecord.moc"
