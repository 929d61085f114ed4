// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/dxlbus.h"
#include "tests/support/ptymaster.h"
#include "tests/support/testmain.h"

#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QRegularExpression>

#include <csignal>

using namespace Qt::StringLiterals;
using namespace dynascope;
using dynascope::test::DxlBus;
using dynascope::test::isOneSentence;
using dynascope::test::Outcome;
using dynascope::test::RunningDxl;

namespace {

const QString Program = QStringLiteral(DYNASCOPE_BIN_DIR "/dxl");

QString inShell(const QString &line, int *code)
{
    QProcess shell;
    shell.start(u"bash"_s, {u"-c"_s, line});
    shell.waitForFinished();
    *code = shell.exitCode();
    return QString::fromUtf8(shell.readAllStandardError());
}

} // namespace

/// `dxl watch`, and what pipes, terminals and Ctrl-C do to it and to others.
class TestDxlWatch : public QObject
{
    Q_OBJECT

private slots:
    void init()
    {
        m_bus = std::make_unique<DxlBus>(u"XM430-W350@57600:1,XM430-W350@57600:2"_s);
        QVERIFY(!m_bus->path().isEmpty());
    }
    void cleanup() { m_bus.reset(); }

    void printsOneLineASample()
    {
        const Outcome one = m_bus->dxl(u"watch 1 present_position operating_mode --count 3 --rate max");
        QCOMPARE(one.code, 0);
        const QStringList lines = one.out.split(u'\n', Qt::SkipEmptyParts);
        QCOMPARE(lines.size(), 3);
        static const QRegularExpression sample(
            u"^[0-9]+\\.[0-9]{4}  Present Position = 180\\.00 °  Operating Mode = Position control$"_s);
        for (const QString &line : lines)
            QVERIFY2(sample.match(line).hasMatch(), qPrintable(line));
        static const QRegularExpression rate(u"^dxl: 3 samples in [0-9.]+ s, [0-9.]+ a second\n$"_s);
        QVERIFY2(rate.match(one.err).hasMatch(), qPrintable(one.err));

        const Outcome two = m_bus->dxl(u"watch 1,2 present_position --count 1");
        QVERIFY2(two.out.endsWith(u"  ID 1: Present Position = 180.00 °  ID 2: Present Position = 180.00 °\n"),
                 qPrintable(two.out));
        QVERIFY2(two.err.contains(u"(10 asked for)"), qPrintable(two.err));
    }

    void printsCsv()
    {
        const Outcome outcome =
            m_bus->dxl(u"watch 1,2 present_position present_input_voltage --csv --count 2 --rate 100");
        QCOMPARE(outcome.code, 0);
        const QStringList lines = outcome.out.split(u'\n', Qt::SkipEmptyParts);
        QCOMPARE(lines.size(), 3);
        QCOMPARE(lines[0],
                 u"time_s,ID 1: Present Position [deg],ID 1: Present Input Voltage [V],ID 2: Present Position "
                 u"[deg],ID 2: Present Input Voltage [V]"_s);
        QCOMPARE(lines[1].section(u',', 1), u"180.00,12.0,180.00,12.0"_s);
    }

    void printsJsonLines()
    {
        const Outcome outcome = m_bus->dxl(u"--json watch 1 present_position --count 2 --rate 100");
        QCOMPARE(outcome.code, 0);
        const QStringList lines = outcome.out.split(u'\n', Qt::SkipEmptyParts);
        QCOMPARE(lines.size(), 2);
        for (const QString &line : lines) {
            const QJsonObject sample = QJsonDocument::fromJson(line.toUtf8()).object();
            QVERIFY(sample[u"time_s"].isDouble());
            // As `read` has it.
            QCOMPARE(sample[u"values"][0].toObject(), QJsonObject({{u"id"_s, 1},
                                                                   {u"field"_s, u"Present Position"_s},
                                                                   {u"address"_s, 132},
                                                                   {u"raw"_s, 2048},
                                                                   {u"value"_s, 180.0},
                                                                   {u"unit"_s, u"deg"_s}}));
        }
    }

    void endsInTime()
    {
        const Outcome outcome = m_bus->dxl(u"watch 1 present_position --seconds 0.3 --rate 20");
        QCOMPARE(outcome.code, 0);
        const qsizetype samples = outcome.out.count(u'\n');
        QVERIFY2(samples >= 1 && samples <= 7, qPrintable(outcome.out)); // never more than asked for
    }

    void saysWhoFallsSilent()
    {
        RunningDxl running(m_bus->with({u"--json"_s, u"watch"_s, u"1,2"_s, u"moving"_s, u"--rate"_s, u"50"_s}));
        QTRY_VERIFY(m_bus->sent().size() > 10);
        m_bus->call([](sim::SimulatedBus &bus, LineTime) { bus.servo(2, 57600)->setPlugged(false); });
        m_bus->forget();
        QTRY_VERIFY(m_bus->sent().size() > 10);
        const Outcome outcome = running.interrupt();
        QVERIFY2(outcome.err.contains(u"dxl: ID 2: Moving: device 2 did not answer"), qPrintable(outcome.err));
        QCOMPARE(outcome.err.count(u"did not answer"), 1); // not with each sample
        const QString last = outcome.out.section(u'\n', -2, -2);
        QVERIFY2(last.contains(u"\"error\":"), qPrintable(last));
    }

    void refuses()
    {
        QCOMPARE(m_bus->dxl(u"watch 1 torqe").code, 2);
        QCOMPARE(m_bus->dxl(u"watch 1 132:4").code, 2);
        const Outcome silent = m_bus->dxl(u"watch 1,9 moving");
        QCOMPARE(silent.code, 1);
        QCOMPARE(silent.out, QString());
    }

    void interruptLeavesTheBusQuiet_data()
    {
        QTest::addColumn<QStringList>("arguments");
        QTest::newRow("watch") << QStringList{u"watch"_s, u"1,2"_s, u"moving"_s, u"--rate"_s, u"max"_s};
        QTest::newRow("scan") << QStringList{u"scan"_s, u"--bauds"_s, u"all"_s};
        QTest::newRow("sweep") << QStringList{u"scan"_s, u"--sweep"_s, u"--ids"_s, u"10-252"_s};
    }

    void interruptLeavesTheBusQuiet()
    {
        QFETCH(QStringList, arguments);
        RunningDxl running(m_bus->with(arguments));
        QTRY_VERIFY(m_bus->sent().size() >= 3); // in the middle of it
        const Outcome outcome = running.interrupt();
        QCOMPARE(outcome.code, 130);
        QVERIFY2(isOneSentence(outcome.err), qPrintable(outcome.err));
        const qsizetype sent = qsizetype(m_bus->sent().size());
        Bytes last = m_bus->sent().back();
        // The last packet left whole, and nothing came after it: whoever asks next is understood at once.
        QCOMPARE(std::size_t(littleEndian(ByteView(last).subspan(5), 2) + 7), last.size());
        QTest::qWait(50);
        QCOMPARE(qsizetype(m_bus->sent().size()), sent);
        QCOMPARE(m_bus->dxl(u"ping 1,2").code, 0);
    }

    void interruptFinishesAChangeOfPlace()
    {
        // However it falls, the device is at one place and the exit code says that the run was interrupted.
        RunningDxl running(m_bus->with({u"write"_s, u"1"_s, u"ID=5"_s, u"led=on"_s}));
        QTRY_VERIFY(!m_bus->sent().empty());
        const Outcome outcome = running.interrupt();
        QVERIFY2(outcome.code == 130 || outcome.code == 0, qPrintable(outcome.err));
        const bool there = m_bus->dxl(u"ping 5").code == 0;
        QCOMPARE(m_bus->dxl(u"ping 1").code, there ? 1 : 0);
    }

    void terminationIsLikeCtrlC()
    {
        QProcess process;
        process.start(Program, m_bus->with({u"watch"_s, u"1"_s, u"moving"_s}));
        QTRY_VERIFY(process.bytesAvailable() > 0 || process.waitForReadyRead(10));
        process.terminate();
        QVERIFY(process.waitForFinished());
        QCOMPARE(process.exitStatus(), QProcess::NormalExit);
        QCOMPARE(process.exitCode(), 130);
    }

    void brokenPipeEndsQuietly()
    {
        int code = -1;
        const QString command = Program + u" --timeout 400 --port "_s + m_bus->path();
        const QString head = inShell(command + u" table 1 | head -1"_s, &code);
        QCOMPARE(head, QString());
        QCOMPARE(code, 0);
        // Of the first of a pipe bash tells when asked: as if SIGPIPE had ended it, and without a word about it.
        const QString watch =
            inShell(command + u" watch 1 moving --rate max | head -2 > /dev/null; exit ${PIPESTATUS[0]}"_s, &code);
        QCOMPARE(code, 141);
        QVERIFY2(watch.startsWith(u"dxl: ") && watch.contains(u" samples in ") && watch.count(u'\n') == 1,
                 qPrintable(watch));
        const QString read = inShell(command + u" read 1 moving | true; exit ${PIPESTATUS[0]}"_s, &code);
        QCOMPARE(read, QString());
        QVERIFY2(code == 141 || code == 0, qPrintable(QString::number(code))); // `true` may be slow to go
        m_bus->forget();
        QTest::qWait(20);
        QVERIFY(m_bus->sent().empty());
    }

    void fullDiskIsAFailure()
    {
        if (!QFile::exists(u"/dev/full"_s))
            QSKIP("no /dev/full here");
        for (const QString &words : {u"read 1 moving"_s, u"--json ping 1"_s, u"watch 1 moving --rate max"_s}) {
            int code = -1;
            const QString said = inShell(Program + u" --timeout 400 --port "_s + m_bus->path() + u' ' + words
                                             + u" > /dev/full"_s, &code);
            QVERIFY2(said.startsWith(u"dxl: standard output can't be written: No space"), qPrintable(said));
            QCOMPARE(code, 1);
        }
    }

    void progressIsForTerminals()
    {
        const QStringList scan{u"scan"_s, u"--bauds"_s, u"57600,1000000"_s, u"--ids"_s, u"0-3"_s};
        QCOMPARE(m_bus->dxl(scan).err, QString()); // none in a pipe
        PtyMaster terminal;
        QProcess process;
        process.setStandardErrorFile(terminal.path());
        process.start(Program, m_bus->with(scan));
        QVERIFY(process.waitForFinished());
        QCOMPARE(process.exitCode(), 0);
        QString text;
        while (!text.contains(u"1000000 bps\r\033[K")) { // gone at the end
            const Bytes more = terminal.read(1);
            QVERIFY2(!more.empty(), qPrintable(text));
            text += QString::fromUtf8(reinterpret_cast<const char *>(more.data()), qsizetype(more.size()));
        }
        QVERIFY2(text.contains(u"[........................]   0 %  57600 bps"), qPrintable(text));
        QVERIFY2(text.contains(u"[############............]  50 %  1000000 bps"), qPrintable(text));
        QCOMPARE(process.readAllStandardOutput().count('\n'), 2); // the results are as they were
    }

private:
    std::unique_ptr<DxlBus> m_bus;
};

DYNASCOPE_CORE_TEST(TestDxlWatch)
#include "tst_dxlwatch.moc"
