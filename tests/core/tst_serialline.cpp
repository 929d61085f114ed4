// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/serialline.h"
#include "tests/support/hex.h"
#include "tests/support/ptymaster.h"
#include "tests/support/testmain.h"

#include <QFile>
#include <QTemporaryDir>

#include <thread>

using namespace dynascope;
using namespace std::chrono_literals;

namespace {

std::unique_ptr<SerialLine> open(const QString &path, int baudRate = 57600)
{
    auto line = SerialLine::open(path, baudRate, {});
    if (!line)
        qFatal("%s", qPrintable(line.error().text));
    return std::move(*line);
}

Error errorOf(const QString &path, int baudRate = 57600)
{
    auto line = SerialLine::open(path, baudRate, {});
    return line ? Error{} : line.error();
}

} // namespace

class TestSerialLine : public QObject
{
    Q_OBJECT

private slots:
    void writesAndReads()
    {
        PtyMaster wire;
        const auto line = open(wire.path());
        QCOMPARE(line->name(), wire.path());
        const Bytes packet = hex::bytes("FF FF FD 00 01 03 00 01 19 4E");
        QVERIFY(line->write(packet));
        QCOMPARE(hex::text(wire.read(packet.size())), hex::text(packet));
        wire.write({0x0A, 0x0D, 0x11, 0x13, 0x03, 0x1C, 0xFF, 0x00}); // what a terminal that isn't raw would eat
        Bytes got;
        while (got.size() < 8)
            QVERIFY(line->read(got, line->now() + 5s));
        QCOMPARE(hex::text(got), QStringLiteral("0A 0D 11 13 03 1C FF 00"));
    }

    void waitsUntilTheDeadlineAndNoLonger()
    {
        PtyMaster wire;
        const auto line = open(wire.path());
        for (const LineTime wait : {LineTime(300us), LineTime(2ms), LineTime(7ms)}) {
            const LineTime deadline = line->now() + wait;
            Bytes got;
            QVERIFY(line->read(got, deadline));
            QVERIFY(got.empty());
            QVERIFY(line->now() >= deadline);
        }
        wire.write({1});
        Bytes got;
        while (got.empty()) // the past: what is there, without waiting
            QVERIFY(line->read(got, LineTime(0)));
        QCOMPARE(got, Bytes{1});
    }

    void appendsToWhatIsThere()
    {
        PtyMaster wire;
        const auto line = open(wire.path());
        wire.write({2, 3});
        Bytes got{1};
        while (got.size() < 3)
            QVERIFY(line->read(got, line->now() + 5s));
        QCOMPARE(got, (Bytes{1, 2, 3}));
    }

    void discardsInputOnly()
    {
        PtyMaster wire;
        const auto line = open(wire.path());
        wire.write({1, 2, 3});
        Bytes got;
        QVERIFY(line->read(got, line->now() + 5s));
        wire.write({4, 5, 6});
        QVERIFY(line->write(Bytes{7, 8}));
        line->discardInput();
        got.clear();
        QVERIFY(line->read(got, line->now() + 2ms));
        QVERIFY(got.empty());
        QCOMPARE(wire.read(2), (Bytes{7, 8}));
    }

    void setsAnyRate()
    {
        PtyMaster wire;
        const auto line = open(wire.path(), 57600);
        QCOMPARE(wire.baudRate(), 57600);
        for (const int rate : {9600, 115200, 1'000'000, 2'000'000, 4'500'000, 10'500'000, 57600}) {
            QVERIFY(line->setBaudRate(rate));
            QCOMPARE(line->baudRate(), rate);
            QCOMPARE(wire.baudRate(), rate);
        }
        QVERIFY(!line->setBaudRate(0));
        QCOMPARE(line->baudRate(), 57600);
        QCOMPARE(wire.baudRate(), 57600);
    }

    void allowsForTheHost()
    {
        PtyMaster wire;
        QCOMPARE(open(wire.path())->hostAllowance(), LineTime(50ms));
        SerialOptions options;
        options.hostAllowance = 200ms;
        QCOMPARE((*SerialLine::open(wire.path(), 57600, options))->hostAllowance(), LineTime(200ms));
    }

    void saysWhyItCanNotOpen()
    {
        QCOMPARE(errorOf(QStringLiteral("/dev/nosuchport")).kind, ErrorKind::PortNotFound);
        QVERIFY(errorOf(QStringLiteral("/dev/nosuchport"))
                    .text.startsWith(QStringLiteral("there is no port /dev/nosuchport")));
        QCOMPARE(errorOf(QStringLiteral("/dev/null")).kind, ErrorKind::PortUnsuitable);
        const QTemporaryDir directory;
        QCOMPARE(errorOf(directory.path()).kind, ErrorKind::PortUnsuitable);
        QFile file(directory.filePath(QStringLiteral("file")));
        QVERIFY(file.open(QIODevice::WriteOnly));
        QCOMPARE(errorOf(file.fileName()).text, file.fileName() + QStringLiteral(" is not a serial port"));
        QVERIFY(QFile::link(QStringLiteral("/nowhere"), directory.filePath(QStringLiteral("dangling"))));
        QCOMPARE(errorOf(directory.filePath(QStringLiteral("dangling"))).kind, ErrorKind::PortNotFound);
    }

    void isForOneUserAlone()
    {
        PtyMaster wire;
        const QTemporaryDir directory;
        const QString link = directory.filePath(QStringLiteral("servos"));
        QVERIFY(QFile::link(wire.path(), link));
        {
            const auto line = open(link);
            QCOMPARE(line->name(), link);
            QCOMPARE(errorOf(wire.path()).kind, ErrorKind::PortBusy); // by another name
            QCOMPARE(errorOf(link).text, link + QStringLiteral(" is in use by this program: close that first"));
            QCOMPARE(errorOf(link).kind, ErrorKind::PortBusy);
            QVERIFY(line->write(Bytes{1}));
        }
        QVERIFY(SerialLine::open(wire.path(), 57600, {})); // free again
    }

    void tellsForbiddenFromBusy()
    {
        if (!PtyMaster::isRoot())
            QSKIP("needs root to become nobody");
        PtyMaster wire;
        QCOMPARE(wire.openAsNobody(), static_cast<int>(ErrorKind::PortForbidden));
        wire.letEverybodyIn();
        QCOMPARE(wire.openAsNobody(), -1);
        wire.markExclusive();
        QCOMPARE(wire.openAsNobody(), static_cast<int>(ErrorKind::PortBusy));
    }

    void aPulledPlugIsNoticed()
    {
        PtyMaster wire;
        const auto line = open(wire.path());
        wire.write({1, 2});
        std::thread hand([&] { wire.close(); });
        Result<void> result;
        for (int i = 0; i < 100 && result; ++i) { // what had come before may still be read
            Bytes got;
            result = line->read(got, line->now() + 5s);
        }
        hand.join();
        QVERIFY(!result);
        QCOMPARE(result.error().kind, ErrorKind::PortLost);
        QCOMPARE(result.error().text, wire.path() + QStringLiteral(" is gone: unplugged, or closed by the other side"));
        Bytes got;
        QCOMPARE(line->read(got, line->now() + 5s).error().kind, ErrorKind::PortLost);
        QCOMPARE(line->write(Bytes{1}).error().kind, ErrorKind::PortLost);
        QCOMPARE(line->setBaudRate(9600).error().kind, ErrorKind::PortLost);
        line->discardInput();
    }

    void writingNoticesToo()
    {
        PtyMaster wire;
        const auto line = open(wire.path());
        wire.close();
        QCOMPARE(line->write(Bytes{1}).error().kind, ErrorKind::PortLost);
    }

    void whoTakesNothingIsLostSoon()
    {
        PtyMaster wire; // and nobody reads there
        const auto line = open(wire.path());
        const Bytes much(100'000, 7);
        LineTime begin{};
        Result<void> written;
        for (int i = 0; i < 100 && written; ++i) {
            begin = line->now();
            written = line->write(much);
        }
        QVERIFY(!written);
        QCOMPARE(written.error().kind, ErrorKind::PortLost);
        QVERIFY2(line->now() - begin < 1500ms, "STOP waits as long");
    }

    void knowsPathsOnly()
    {
        SerialLineFactory factory;
        QVERIFY(factory.knows(QStringLiteral("/dev/ttyUSB0")));
        QVERIFY(factory.knows(QStringLiteral("COM3")));
        QVERIFY(!factory.knows(QStringLiteral("sim")));
        QVERIFY(!factory.knows(QStringLiteral("tcp://host:1000")));
        PtyMaster wire;
        QVERIFY(factory.open(wire.path(), 57600));
        QVERIFY(!factory.open(QStringLiteral("/dev/nosuchport"), 57600));
        (void)SerialPortList().ports();
    }
};

DYNASCOPE_CORE_TEST(TestSerialLine)
#include "tst_serialline.moc"
