// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/dxl/chooseport.h"
#include "core/bus/seriallinefactory.h"
#include "tests/support/dxlbus.h"
#include "tests/support/testmain.h"

#include <QDir>
#include <QFile>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QRegularExpression>
#include <QStandardPaths>
#include <QTemporaryDir>

using namespace Qt::StringLiterals;
using namespace dynascope;
using dynascope::test::DxlBus;
using dynascope::test::isOneSentence;
using dynascope::test::Outcome;

namespace {

QString contents(const QString &path)
{
    QFile file(QStringLiteral(DYNASCOPE_SOURCE_DIR "/") + path);
    return file.open(QIODevice::ReadOnly) ? QString::fromUtf8(file.readAll()) : QString();
}

/// The commands, as `dxl --help` lists them.
QStringList commands()
{
    const QString list = test::dxl({u"--help"_s}).out.section(u"Commands:\n"_s, 1).section(u"\n\n"_s, 0, 0);
    QStringList names;
    for (const QString &line : list.split(u'\n')) {
        if (line.startsWith(u"  ") && line[2] != u' ')
            names << line.trimmed().section(u' ', 0, 0);
    }
    return names;
}

/// The options that the help of these words lists.
QStringList options(const QStringList &words)
{
    static const QRegularExpression option(u"^  (?:-[a-z],)?(--[a-z-]+)"_s, QRegularExpression::MultilineOption);
    QStringList names;
    auto all = option.globalMatch(test::dxl(words + QStringList{u"--help"_s}).out);
    while (all.hasNext())
        names << all.next().captured(1);
    return names;
}

} // namespace

/// What belongs to dxl besides what it does on a line: help, manual page, completion, versions, choice of the port.
class TestDxlInterface : public QObject
{
    Q_OBJECT

private slots:
    void everyCommandHasHelp()
    {
        const QStringList all = commands();
        const QString wanted = u"ports scan ping info table read write watch torque led reboot reset clear backup stop "
                               u"packet sim stats completion version"_s;
        for (const QString &name : wanted.split(u' '))
            QVERIFY2(all.contains(name), qPrintable(name));
        for (const QString &name : all) {
            const Outcome help = test::dxl({name, u"--help"_s});
            QCOMPARE(help.code, 0);
            QCOMPARE(help.err, QString());
            QVERIFY2(help.out.contains(u"Usage: dxl "_s + name), qPrintable(help.out));
            for (const QString &line : help.out.split(u'\n'))
                QVERIFY2(line.size() <= 100, qPrintable(line));
        }
    }

    void manualPageKnowsEverything()
    {
        QString page = contents(u"resources/dxl.1"_s);
        page.replace(u"\\-"_s, u"-"_s).remove(QRegularExpression(u"\\\\f."_s));
        QVERIFY(!page.isEmpty());
        const auto names = [&page](const QString &word) {
            return QRegularExpression(u"(?<![a-z-])%1(?![a-z-])"_s.arg(QRegularExpression::escape(word)))
                .match(page)
                .hasMatch();
        };
        for (const QString &option : options({}))
            QVERIFY2(names(option), qPrintable(option));
        const QString sections = page.section(u".SH COMMANDS"_s, 1).section(u"\n.SH "_s, 0, 0);
        for (const QString &command : commands()) {
            const QRegularExpression heading(u"^\\.TP\n\\.BI? %1(?![a-z-])[^\n]*\n(.*?)(?=^\\.TP|\\z)"_s.arg(command),
                                             QRegularExpression::MultilineOption
                                                 | QRegularExpression::DotMatchesEverythingOption);
            const auto entry = heading.match(sections);
            QVERIFY2(entry.hasMatch(), qPrintable(command));
            for (const QString &option : options({command})) {
                if (option != u"--help")
                    QVERIFY2(entry.captured(0).contains(option), qPrintable(command + u' ' + option));
            }
        }
    }

    void manualPageIsWellFormed()
    {
        if (QStandardPaths::findExecutable(u"groff"_s).isEmpty())
            QSKIP("no groff here");
        QProcess groff;
        groff.start(u"groff"_s,
                    {u"-man"_s, u"-ww"_s, u"-z"_s, QStringLiteral(DYNASCOPE_SOURCE_DIR "/resources/dxl.1")});
        QVERIFY(groff.waitForFinished());
        QCOMPARE(groff.readAllStandardError(), QByteArray());
        QCOMPARE(groff.exitCode(), 0);
    }

    void completes_data()
    {
        QTest::addColumn<QString>("shell");
        QTest::addColumn<QString>("line");
        QTest::addColumn<QString>("offers");
        QTest::addColumn<QString>("offersNot");
        for (const QString &shell : {u"bash"_s, u"fish"_s}) {
            const auto row = [&shell](const char *name, const QString &line, const QString &offers, const QString &offersNot) {
                QTest::addRow("%s: %s", qPrintable(shell), name) << shell << line << offers << offersNot;
            };
            row("commands", u"dxl re"_s, u"read reboot reset"_s, u"scan"_s);
            row("behind options", u"dxl --port /dev/ttyUSB0 --json to"_s, u"torque"_s, u"table"_s);
            row("a port that is called as a command", u"dxl --port sim sc"_s, u"scan"_s, u"sim"_s);
            row("options of a command", u"dxl watch 1 --"_s, u"--rate --count --csv --port --json"_s, u"--sweep"_s);
            row("fields", u"dxl read 1 present_p"_s, u"present_position present_pwm"_s, u"goal_position"_s);
            row("assignments", u"dxl write 1 goal_p"_s, u"goal_position= goal_pwm="_s, u"goal_position"_s);
            row("words", u"dxl reset all-"_s, u"all-but-id all-but-id-and-baud"_s, u"all"_s);
            row("ports", u"dxl --port s"_s, u"sim"_s, u"scan"_s);
            row("rates", u"dxl scan --bauds a"_s, u"all"_s, u"57600"_s);
            row("models", u"dxl stop 1 --model XM430-W3"_s, u"XM430-W350"_s, u"--model"_s);
            row("instructions", u"dxl packet fast"_s, u"fast-sync-read fast-bulk-read"_s, u"ping"_s);
            row("control channel", u"dxl sim ctl /tmp/x pus"_s, u"push"_s, u"plug"_s);
            row("files", u"dxl sim --bus /etc/passw"_s, u"/etc/passwd"_s, u"ctl"_s);
            row("nothing but a number", u"dxl --timeout s"_s, QString(), u"scan"_s);
        }
    }

    void completes()
    {
        QFETCH(QString, shell);
        QFETCH(QString, line);
        QFETCH(QString, offers);
        QFETCH(QString, offersNot);
        if (QStandardPaths::findExecutable(shell).isEmpty())
            QSKIP("the shell is not here");
        QTemporaryDir directory;
        QFile script(directory.filePath(u"completion"_s));
        QVERIFY(script.open(QIODevice::WriteOnly));
        const Outcome made = test::dxl({u"completion"_s, shell});
        QCOMPARE(made.code, 0);
        script.write(made.out.toUtf8());
        script.close();
        QProcess process;
        if (shell == u"bash") {
            process.start(shell, {u"-uc"_s,
                                  u". \"$1\"; COMP_WORDS=($2); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _dxl; "
                                  u"printf '%s\n' \"${COMPREPLY[@]}\""_s,
                                  shell, script.fileName(), line});
        } else {
            process.start(shell, {u"-N"_s, u"-c"_s, u"source $argv[1]; complete -C $argv[2]"_s, script.fileName(), line});
        }
        QVERIFY(process.waitForFinished());
        QCOMPARE(QString::fromUtf8(process.readAllStandardError()), QString());
        QStringList offered;
        for (const QString &one : QString::fromUtf8(process.readAllStandardOutput()).split(u'\n', Qt::SkipEmptyParts))
            offered << one.section(u'\t', 0, 0);
        for (const QString &word : offers.split(u' ', Qt::SkipEmptyParts))
            QVERIFY2(offered.contains(word), qPrintable(word + u": "_s + offered.join(u' ')));
        QVERIFY2(!offered.contains(offersNot), qPrintable(offered.join(u' ')));
    }

    void otherShellsAreToldAll_data()
    {
        QTest::addColumn<QString>("shell");
        QTest::newRow("bash") << u"bash"_s;
        QTest::newRow("zsh") << u"zsh"_s;
        QTest::newRow("fish") << u"fish"_s;
    }

    void otherShellsAreToldAll()
    {
        QFETCH(QString, shell);
        const Outcome script = test::dxl({u"completion"_s, shell});
        QCOMPARE(script.code, 0);
        QVERIFY(script.out.contains(u"present_position"));
        const QString dashes = shell == u"fish" ? u"-l "_s : u"--"_s;
        for (const QString &command : commands()) {
            QVERIFY2(script.out.contains(command), qPrintable(command));
            for (const QString &option : options({command}))
                QVERIFY2(script.out.contains(dashes + option.mid(2)), qPrintable(command + u' ' + option));
        }
        if (QStandardPaths::findExecutable(shell).isEmpty())
            QSKIP("the shell is not here to read it");
        QProcess reader;
        reader.start(shell, {u"-n"_s});
        reader.write(script.out.toUtf8());
        reader.closeWriteChannel();
        QVERIFY(reader.waitForFinished());
        QCOMPARE(reader.readAllStandardError(), QByteArray());
    }

    void versions()
    {
        QVERIFY(test::dxl({u"version"_s}).out.startsWith(u"dxl "));
        const Outcome outcome = test::dxl({u"--json"_s, u"version"_s});
        const QJsonObject document = QJsonDocument::fromJson(outcome.out.toUtf8()).object();
        QCOMPARE(document[u"program"].toString(), u"dxl"_s);
        QCOMPARE(document[u"json"].toInt(), 1);
        QCOMPARE(test::dxl({u"--json=1"_s, u"version"_s}).out, outcome.out);
    }

    void jsonOfEveryCommandIsDocumented()
    {
        const QString section = contents(u"README.md"_s).section(u"### JSON"_s, 1).section(u"\n## "_s, 0, 0);
        QVERIFY(section.contains(u"version 1"));
        for (const QString &command : commands()) {
            if (command != u"sim" && command != u"completion")
                QVERIFY2(section.contains(u'`' + command + u'`'), qPrintable(command));
        }
    }

    void choosesThePort_data()
    {
        QTest::addColumn<QStringList>("ports");
        QTest::addColumn<QString>("chosen");
        QTest::addColumn<QString>("says");
        QTest::newRow("none") << QStringList() << QString()
                              << u"no adapter is plugged in: say --port PATH, --port sim"_s;
        QTest::newRow("one") << QStringList{u"/dev/ttyUSB0"_s} << u"/dev/ttyUSB0"_s << QString();
        QTest::newRow("one, and the board's")
            << QStringList{u"/dev/ttyACM3"_s, u"/dev/ttyS0"_s} << u"/dev/ttyACM3"_s << QString();
        QTest::newRow("two") << QStringList{u"/dev/ttyUSB0"_s, u"/dev/ttyUSB1"_s} << QString()
                             << u"2 adapters: /dev/ttyUSB0 (U2D2), /dev/ttyUSB1 (U2D2); say --port PATH"_s;
        QTest::newRow("the board's alone")
            << QStringList{u"/dev/ttyS0"_s} << QString() << u"/dev/ttyS0 (U2D2), are no adapters"_s;
    }

    void choosesThePort()
    {
        QFETCH(QStringList, ports);
        QFETCH(QString, chosen);
        QFETCH(QString, says);
        std::vector<PortInfo> infos;
        for (const QString &port : ports)
            infos.push_back({port, u"U2D2"_s, {}, {}});
        const auto port = dxl::choosePort(infos);
        QCOMPARE(port.value_or(QString()), chosen);
        if (chosen.isEmpty())
            QVERIFY2(port.error().text.contains(says), qPrintable(port.error().text));
    }

    void portMayBeLeftOut()
    {
        const auto chosen = dxl::choosePort(SerialPortList().ports());
        const Outcome outcome = test::dxl({u"ping"_s, u"1"_s});
        QVERIFY(outcome.err.startsWith(u"dxl: "));
        if (chosen) {
            QVERIFY2(outcome.err.contains(*chosen), qPrintable(outcome.err));
        } else {
            QCOMPARE(outcome.code, 2);
            QVERIFY2(isOneSentence(outcome.err) && outcome.err.contains(chosen.error().text), qPrintable(outcome.err));
        }
    }

    void listsPorts()
    {
        const std::vector<PortInfo> there = SerialPortList().ports();
        const Outcome text = test::dxl({u"ports"_s});
        QCOMPARE(text.code, 0);
        QCOMPARE(text.out.count(u'\n'), qsizetype(there.size()));
        QCOMPARE(text.err.isEmpty(), !there.empty());
        const Outcome document = test::dxl({u"--json"_s, u"ports"_s});
        const QJsonArray list = QJsonDocument::fromJson(document.out.toUtf8()).array();
        QCOMPARE(std::size_t(list.size()), there.size());
        for (const QJsonValue &port : list) {
            for (const char16_t *key : {u"port", u"description", u"serial_number", u"identity"})
                QVERIFY(port[QString::fromUtf16(key)].isString());
        }
    }

    void demoIsAPort()
    {
        const Outcome fresh = test::dxl({u"--port"_s, u"sim"_s, u"--timeout"_s, u"400"_s, u"ping"_s, u"1"_s});
        QCOMPARE(fresh.err, QString());
        QVERIFY2(fresh.out.startsWith(u"ID 1: XL330-M288"), qPrintable(fresh.out));
        const Outcome arm =
            test::dxl({u"--port"_s, u"sim"_s, u"--baud"_s, u"1000000"_s, u"--timeout"_s, u"400"_s, u"stop"_s});
        QCOMPARE(arm.code, 0);
        QCOMPARE(arm.out.count(u"torque is off"), 6);
    }
};

DYNASCOPE_CORE_TEST(TestDxlInterface)
#include "tst_dxlinterface.moc"
