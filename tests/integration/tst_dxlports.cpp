// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/dxlprocess.h"
#include "tests/support/testmain.h"

#include <QFileInfo>
#include <QTemporaryFile>

#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

using namespace Qt::StringLiterals;
using dynascope::test::dxl;
using dynascope::test::Outcome;
using dynascope::test::SimProcess;

namespace {

const QString OneServo = u"XM430-W350@57600:1"_s;

} // namespace

/// What `dxl` says of its arguments and of ports it can't use, and how `dxl sim` begins and ends.
class TestDxlPorts : public QObject
{
    Q_OBJECT

private slots:
    void usage_data();
    void usage();
    void help();
    void wrongPort_data();
    void wrongPort();
    void forbiddenPort();
    void busyPort();
    void vanishedPort();
    void controlHelpIsForPeople();
    void simTidiesUp();
    void simKeepsAFile();
    void simRefuses_data();
    void simRefuses();

private:
    QTemporaryDir m_directory;
};

void TestDxlPorts::usage_data()
{
    QTest::addColumn<QString>("line");
    QTest::addColumn<QString>("says");
    QTest::newRow("nothing") << QString() << u"say what to do: scan"_s;
    QTest::newRow("unknown command") << u"--port /dev/null dance"_s << u"there is no command \"dance\""_s;
    QTest::newRow("unknown option") << u"--prot /dev/null ping 1"_s << u"--prot"_s;
    QTest::newRow("no ID") << u"--port /dev/null ping"_s << u"ID"_s;
    QTest::newRow("ID too large") << u"--port /dev/null ping 253"_s << u"253"_s;
    QTest::newRow("ID negative") << u"--port /dev/null ping -1"_s << u"-1"_s;
    QTest::newRow("ID a word") << u"--port /dev/null ping one"_s << u"one"_s;
    QTest::newRow("baud zero") << u"--port /dev/null --baud 0 ping 1"_s << u"0"_s;
    QTest::newRow("bauds") << u"--port /dev/null scan --bauds 57600,fast"_s << u"fast"_s;
    QTest::newRow("the index of a rate") << u"--port /dev/null scan --bauds 57600,3"_s << u"\"3\" is not a baud rate in bits"_s;
    QTest::newRow("the index as the rate") << u"--port /dev/null --baud 3 ping 1"_s << u"1200"_s;
    QTest::newRow("bauds empty") << u"--port /dev/null scan --bauds \"\""_s << u"--bauds"_s;
    QTest::newRow("IDs turned") << u"--port /dev/null scan --ids 9-3"_s << u"9-3"_s;
    QTest::newRow("IDs too far") << u"--port /dev/null scan --ids 0-253"_s << u"0-253"_s;
    QTest::newRow("nothing to read") << u"--port /dev/null read 1"_s << u"REGISTER"_s;
    QTest::newRow("nothing to write") << u"--port /dev/null write 1"_s << u"ASSIGNMENT"_s;
    QTest::newRow("bad address") << u"--port /dev/null read 1 abc:4"_s << u"abc:4"_s;
    QTest::newRow("no devices") << u"sim"_s << u"--devices"_s;
    QTest::newRow("ID in a list too large") << u"--port /dev/null read 1,3-253 132:4"_s << u"3-253"_s;
    QTest::newRow("on or off") << u"--port /dev/null torque maybe 1"_s << u"maybe"_s;
    QTest::newRow("torque of nobody") << u"--port /dev/null torque on"_s << u"IDS"_s;
    QTest::newRow("no such reset") << u"--port /dev/null reset some 1"_s << u"some"_s;
    QTest::newRow("backup of what") << u"--port /dev/null backup"_s << u"IDS"_s;
    QTest::newRow("watch nothing") << u"--port /dev/null watch 1"_s << u"FIELD"_s;
    QTest::newRow("no rate") << u"--port /dev/null watch 1 moving --rate 0"_s << u"--rate"_s;
    QTest::newRow("two forms") << u"--port /dev/null --json watch 1 moving --csv"_s << u"--csv and --json"_s;
    QTest::newRow("JSON of another version") << u"--json=2 version"_s << u"version 1"_s;
    QTest::newRow("timeout") << u"--port /dev/null --timeout 0 ping 1"_s << u"0"_s;
    QTest::newRow("model of nobody") << u"--port /dev/null stop --model XM430-W350"_s << u"--model"_s;
    QTest::newRow("no packet") << u"--port /dev/null packet"_s << u"--hex"_s;
    QTest::newRow("no such instruction") << u"--port /dev/null packet dance 1"_s << u"dance"_s;
    QTest::newRow("shell") << u"completion tcsh"_s << u"tcsh"_s;
}

void TestDxlPorts::usage()
{
    QFETCH(QString, line);
    QFETCH(QString, says);
    QStringList arguments = line.split(u' ', Qt::SkipEmptyParts);
    arguments.replaceInStrings(u"\"\""_s, QString()); // an argument without a character
    const Outcome outcome = dxl(arguments);
    QCOMPARE(outcome.code, 2);
    QCOMPARE(outcome.out, QString());
    QVERIFY2(outcome.err.startsWith(u"dxl: ") && outcome.err.count(u'\n') == 1, qPrintable(outcome.err));
    QVERIFY2(outcome.err.contains(says), qPrintable(outcome.err));
}

void TestDxlPorts::help()
{
    for (const QString &option : {u"--help"_s, u"--version"_s}) {
        const Outcome outcome = dxl({option});
        QCOMPARE(outcome.code, 0);
        QCOMPARE(outcome.err, QString());
        QVERIFY(outcome.out.contains(u"dxl"));
    }
    QVERIFY(dxl({u"write"_s, u"--help"_s}).out.contains(u"90deg"));
    const QString help = dxl({u"--help"_s}).out;
    QVERIFY(help.contains(u"3 sent, but not confirmed") && help.contains(u"130 interrupted"));
}

void TestDxlPorts::wrongPort_data()
{
    QTest::addColumn<QString>("port");
    QTest::addColumn<QString>("says");
    QTest::newRow("missing") << m_directory.filePath(u"none"_s) << u"no port"_s;
    QTest::newRow("no serial port") << u"/dev/null"_s << u"not a serial port"_s;
    QTest::newRow("folder") << m_directory.path() << u"not a serial port"_s;
}

void TestDxlPorts::wrongPort()
{
    QFETCH(QString, port);
    QFETCH(QString, says);
    const Outcome outcome = dxl({u"--port"_s, port, u"ping"_s, u"1"_s});
    QCOMPARE(outcome.code, 1);
    QCOMPARE(outcome.out, QString());
    QVERIFY2(outcome.err.startsWith(u"dxl: ") && outcome.err.count(u'\n') == 1, qPrintable(outcome.err));
    QVERIFY2(outcome.err.contains(port) && outcome.err.contains(says), qPrintable(outcome.err));
}

void TestDxlPorts::forbiddenPort()
{
    const SimProcess sim(OneServo);
    const QByteArray path = sim.path().toUtf8();
    QVERIFY(!path.isEmpty());
    QCOMPARE(chmod(path.constData(), 0), 0);
    // Root may open anything: as root the client runs as somebody else.
    QProcess client;
    const QStringList ping{u"--port"_s, sim.path(), u"ping"_s, u"1"_s};
    const QString program = QStringLiteral(DYNASCOPE_BIN_DIR "/dxl");
    if (geteuid() == 0) {
        client.start(u"setpriv"_s, QStringList{u"--reuid"_s, u"65534"_s, u"--regid"_s, u"65534"_s, u"--clear-groups"_s,
                                               program} + ping);
    } else {
        client.start(program, ping);
    }
    QVERIFY(client.waitForFinished());
    const QString says = QString::fromUtf8(client.readAllStandardError());
    QCOMPARE(client.exitCode(), 1);
    QVERIFY2(says.contains(u"dialout"), qPrintable(says));
    chmod(path.constData(), 0600);
}

void TestDxlPorts::busyPort()
{
    const SimProcess sim(OneServo);
    QFile holder(sim.path());
    QVERIFY(holder.open(QIODevice::ReadWrite | QIODevice::Unbuffered));
    QCOMPARE(flock(holder.handle(), LOCK_EX | LOCK_NB), 0);
    const Outcome refused = sim.dxl({u"ping"_s, u"1"_s});
    QCOMPARE(refused.code, 1);
    QVERIFY2(refused.err.contains(sim.path()) && refused.err.contains(u"use"), qPrintable(refused.err));
    const QString who = u"(process %1)"_s.arg(QCoreApplication::applicationPid());
    QVERIFY2(refused.err.contains(who), qPrintable(refused.err)); // not the simulator, which has it open as well
    holder.close();
    QCOMPARE(sim.dxl({u"ping"_s, u"1"_s}).code, 0);
}

void TestDxlPorts::vanishedPort()
{
    SimProcess sim(OneServo);
    QCOMPARE(sim.dxl({u"ping"_s, u"1"_s}).code, 0);
    sim.kill();
    const Outcome outcome = sim.dxl({u"ping"_s, u"1"_s});
    QCOMPARE(outcome.code, 1);
    QVERIFY2(outcome.err.contains(u"no port"), qPrintable(outcome.err));
}

void TestDxlPorts::controlHelpIsForPeople()
{
    const Outcome help = dxl({u"sim"_s, u"ctl"_s, u"--help"_s});
    QVERIFY2(help.out.contains(u"Usage: dxl sim ctl PATH COMMAND...\n"), qPrintable(help.out));
    QVERIFY2(help.out.contains(u"\n  push WHO TORQUE [SECONDS]: "), qPrintable(help.out));
    const SimProcess sim(u"XM430-W350@57600:1"_s);
    const Outcome lines = dxl({u"sim"_s, u"ctl"_s, sim.path(), u"help"_s});
    QVERIFY2(lines.out.contains(u"\npush WHO TORQUE [SECONDS]: "), qPrintable(lines.out));
    const Outcome document = dxl({u"--json"_s, u"sim"_s, u"ctl"_s, sim.path(), u"help"_s});
    QVERIFY2(document.out.startsWith(u"[\"status: "), qPrintable(document.out));
}

void TestDxlPorts::simTidiesUp()
{
    const QString link = m_directory.filePath(u"servos"_s);
    SimProcess sim(OneServo, link);
    QVERIFY(sim.path().startsWith(u"/dev/"));
    QCOMPARE(QFileInfo(link).symLinkTarget(), sim.path());
    QCOMPARE(dxl({u"--port"_s, link, u"ping"_s, u"1"_s}).code, 0);
    const Outcome end = sim.interrupt();
    QCOMPARE(end.code, 0);
    QCOMPARE(end.out, QString()); // the path alone was on standard output
    QCOMPARE(end.err, QString());
    QVERIFY(!QFileInfo(link).isSymLink());
}

void TestDxlPorts::simKeepsAFile()
{
    const QString path = m_directory.filePath(u"precious"_s);
    QFile file(path);
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write("mine");
    file.close();
    const Outcome outcome = dxl({u"sim"_s, u"--devices"_s, OneServo, u"--link"_s, path});
    QCOMPARE(outcome.code, 1);
    QVERIFY2(outcome.err.contains(path), qPrintable(outcome.err));
    QCOMPARE(QFileInfo(path).size(), 4);
}

void TestDxlPorts::simRefuses_data()
{
    QTest::addColumn<QString>("devices");
    QTest::addColumn<QString>("says");
    QTest::newRow("form") << u"XM430-W350"_s << u"XM430-W350"_s;
    QTest::newRow("model") << u"XM999@57600:1"_s << u"XM999"_s;
    QTest::newRow("baud") << u"XM430-W350@57601:1"_s << u"57601"_s;
    QTest::newRow("ID") << u"XM430-W350@57600:253"_s << u"253"_s;
}

void TestDxlPorts::simRefuses()
{
    QFETCH(QString, devices);
    QFETCH(QString, says);
    SimProcess sim(devices);
    QCOMPARE(sim.path(), QString());
    const QString errors = sim.errors();
    QVERIFY2(errors.startsWith(u"dxl: ") && errors.count(u'\n') == 1 && errors.contains(says), qPrintable(errors));
}

DYNASCOPE_CORE_TEST(TestDxlPorts)
#include "tst_dxlports.moc"
