// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/journal/journal.h"
#include "tests/support/dxlbus.h"
#include "tests/support/testmain.h"

#include <QDir>
#include <QFile>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QProcess>

using namespace Qt::StringLiterals;
using namespace dynascope;
using dynascope::test::DxlBus;
using dynascope::test::Outcome;

namespace {

QJsonArray list(const Outcome &outcome)
{
    return QJsonDocument::fromJson(outcome.out.toUtf8()).array();
}

} // namespace

/// What `dxl` writes is in the journal that all programs share, and `dxl journal` takes it back.
class TestDxlJournal : public QObject
{
    Q_OBJECT

private slots:
    void init()
    {
        QDir(Journal::usualFolder()).removeRecursively();
        m_bus = std::make_unique<DxlBus>(u"XM430-W350@57600:1,XL430-W250@57600:2"_s);
        QVERIFY(!m_bus->path().isEmpty());
    }
    void cleanup() { m_bus.reset(); }

    void everyWriteIsListed()
    {
        QCOMPARE(m_bus->dxl(u"read 1 led").code, 0);
        QCOMPARE(m_bus->dxl(u"journal").err, u"dxl: the journal has no such entries\n"_s);
        QCOMPARE(m_bus->dxl(u"write 1 operating_mode=velocity moving_threshold=33").code, 0);
        QCOMPARE(m_bus->dxl(u"write 2 65:1=1").code, 0);
        QCOMPARE(m_bus->dxl(u"torque on 1,2").code, 0);
        QCOMPARE(m_bus->dxl(u"torque off 1,2").code, 0);
        QCOMPARE(m_bus->dxl(u"led off 2").code, 0);
        QCOMPARE(m_bus->dxl(u"write 2 id=5").code, 0);
        QCOMPARE(m_bus->dxl(u"reboot 5").code, 0);
        QCOMPARE(m_bus->dxl(u"packet write 1 65 1").code, 0);
        QCOMPARE(m_bus->dxl(u"packet ping 1").code, 0);
        QCOMPARE(m_bus->dxl(u"stop 1").code, 0);
        QStringList texts;
        for (const QJsonValue &entry : list(m_bus->dxl(u"--json journal"))) {
            const QJsonObject first = entry[u"changes"][0].toObject();
            texts << u"%1 %2 %3: %4 %5 -> %6 %7"_s.arg(entry[u"entry"].toInteger())
                         .arg(entry[u"what"].toString())
                         .arg(entry[u"id"].toInt())
                         .arg(first[u"register"].toString(), first[u"old"].toString(), first[u"new"].toString(),
                              entry[u"state"].toString());
        }
        const QStringList expected{u"1 write 1: Operating Mode 3 -> 1 done"_s,
                                   u"2 write 1: Moving Threshold 10 -> 33 done"_s,
                                   u"3 write 2: LED 0 -> 1 done"_s,
                                   u"4 write 1: Torque Enable 0 -> 1 done"_s,
                                   u"5 write 2: Torque Enable 0 -> 1 done"_s,
                                   u"6 write 1: Torque Enable  -> 0 done"_s,
                                   u"7 write 2: Torque Enable  -> 0 done"_s,
                                   u"8 write 2: LED 1 -> 0 done"_s,
                                   u"9 write 2: ID 2 -> 5 done"_s,
                                   u"10 reboot 5:   ->  done"_s,
                                   u"11 packet 1:   ->  unconfirmed"_s,
                                   u"12 write 1: Torque Enable  -> 0 done"_s};
        QCOMPARE(texts, expected);
        const Outcome text = m_bus->dxl(u"journal list 1-2");
        QVERIFY2(text.out.contains(u"Position control → Velocity control"_s) && text.out.count(u'\n') == 2,
                 qPrintable(text.out));
    }

    void undoesAndRedoes()
    {
        QCOMPARE(m_bus->dxl(u"write 1 position_p_gain=111").code, 0);                      // 1
        QCOMPARE(m_bus->dxl(u"write 1 operating_mode=1").code, 0);                         // 2: resets the gain
        QCOMPARE(m_bus->dxl(u"write 2 id=5").code, 0);                                     // 3
        QCOMPARE(m_bus->dxl(u"write 5 led=1").code, 0);                                    // 4
        const Outcome dry = test::dxl({u"journal"_s, u"undo"_s, u"1-"_s, u"--dry-run"_s}); // asks nobody
        QCOMPARE(dry.code, 0);
        QCOMPARE(dry.out.count(u'\n'), 4);
        QVERIFY2(dry.out.startsWith(u"undo of 4: XL430-W250 #5, LED: On → Off"_s), qPrintable(dry.out));
        QCOMPARE(m_bus->value(1, 57600, u"Operating Mode"), 1);

        const Outcome alone = m_bus->dxl(u"journal undo 1"); // the mode has reset it since
        QCOMPARE(alone.code, 1);
        QVERIFY2(alone.err.contains(u"is 800 by entry 2, which came later"_s), qPrintable(alone.err));
        QCOMPARE(m_bus->value(1, 57600, u"Position P Gain"), 800);
        // Where it was written; a port isn't needed.
        const Outcome all = test::dxl({u"--timeout"_s, u"400"_s, u"journal"_s, u"undo"_s, u"1-"_s});
        QCOMPARE(all.err, QString());
        QCOMPARE(all.code, 0);
        QCOMPARE(m_bus->value(1, 57600, u"Operating Mode"), 3);
        QCOMPARE(m_bus->value(1, 57600, u"Position P Gain"), 80 * 10);
        QCOMPARE(m_bus->value(2, 57600, u"LED"), 0);
        QCOMPARE(m_bus->dxl(u"journal undo last").code, 2); // nothing is left
        QCOMPARE(m_bus->dxl(u"journal redo 2 4").code, 0);
        QCOMPARE(m_bus->value(1, 57600, u"Operating Mode"), 1);
        QCOMPARE(m_bus->value(2, 57600, u"LED"), 1); // who had ID 5 then
    }

    void refusals_data()
    {
        QTest::addColumn<QString>("arguments");
        QTest::addColumn<int>("code");
        QTest::addColumn<QString>("says");
        QTest::newRow("no entry") << u"journal undo 99"_s << 2 << u"has no entry 99"_s;
        QTest::newRow("no number") << u"journal undo x"_s << 2 << u"names no entries"_s;
        QTest::newRow("backwards") << u"journal undo 5-3"_s << 2 << u"names no entries"_s;
        QTest::newRow("nothing named") << u"journal undo"_s << 2 << u"say which entries"_s;
        QTest::newRow("not undone") << u"journal redo 1"_s << 2 << u"is not undone"_s;
        QTest::newRow("torque on") << u"journal undo 3"_s << 2 << u"does not know what it replaced"_s;
        QTest::newRow("under torque") << u"journal undo 1"_s << 1 << u"--torque-off allows it"_s;
        QTest::newRow("would move") << u"journal undo 5"_s << 1 << u"--move allows it"_s;
        QTest::newRow("another port") << u"--port /dev/null journal undo 1"_s << 1 << u"/dev/null"_s;
    }
    void refusals()
    {
        QFETCH(QString, arguments);
        QFETCH(int, code);
        QFETCH(QString, says);
        QCOMPARE(m_bus->dxl(u"write 1 moving_threshold=33").code, 0); // 1
        QCOMPARE(m_bus->dxl(u"torque on 1").code, 0);                 // 2
        QCOMPARE(m_bus->dxl(u"torque off 1").code, 0);                // 3
        QCOMPARE(m_bus->dxl(u"torque on 1").code, 0);                 // 4
        QCOMPARE(m_bus->dxl(u"write 1 goal_position=2100").code, 0);  // 5
        const Outcome outcome = test::dxl(QStringList{u"--timeout"_s, u"400"_s} + arguments.split(u' '));
        QCOMPARE(outcome.code, code);
        QVERIFY2(outcome.err.contains(says), qPrintable(outcome.err));
        QCOMPARE(m_bus->value(1, 57600, u"Moving Threshold"), 33);
        QCOMPARE(m_bus->value(1, 57600, u"Goal Position"), 2100);
        QCOMPARE(m_bus->value(1, 57600, u"Torque Enable"), 1);
    }

    /// A script does the same again; nothing of an entry reaches the shell.
    void exportsAScript()
    {
        QCOMPARE(m_bus->dxl(u"write 1 moving_threshold=33").code, 0);
        QCOMPARE(m_bus->dxl(u"torque on 1").code, 0);
        const QTemporaryDir folder;
        const QString trap = folder.filePath(u"trap"_s);
        {
            Journal journal(Journal::usualFolder());
            JournalEntry hostile = journal.entries().front();
            hostile.device.model = u"x\ntouch "_s + trap;
            hostile.device.line = u"'; touch %1; '"_s.arg(trap);
            hostile.changes.front().name = u"LED$(touch %1)"_s.arg(trap);
            journal.finish(journal.begin(hostile), hostile);
        }
        const Outcome script = m_bus->dxl(u"journal export");
        QCOMPARE(script.code, 0);
        QVERIFY2(script.out.contains(u"\n# left to you: dxl --port"_s), qPrintable(script.out));
        m_bus->set(1, 57600, u"Torque Enable", 0);
        m_bus->set(1, 57600, u"Moving Threshold", 10);
        QFile file(folder.filePath(u"script.sh"_s));
        QVERIFY(file.open(QIODevice::WriteOnly));
        file.write(script.out.toUtf8());
        file.close();
        QProcess shell;
        QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
        environment.insert(u"PATH"_s, QStringLiteral(DYNASCOPE_BIN_DIR ":") + environment.value(u"PATH"_s));
        shell.setProcessEnvironment(environment);
        shell.start(u"sh"_s, {file.fileName()});
        QVERIFY(shell.waitForFinished());
        QCOMPARE(m_bus->value(1, 57600, u"Moving Threshold"), 33);
        QCOMPARE(m_bus->value(1, 57600, u"Torque Enable"), 0);
        QVERIFY(!QFile::exists(trap));
        QVERIFY(shell.exitCode() != 0); // there is no such port
    }

    void theDemoIsNotNoted()
    {
        QCOMPARE(test::dxl({u"--port"_s, u"sim"_s, u"--baud"_s, u"1000000"_s, u"led"_s, u"on"_s, u"1"_s}).code, 0);
        QVERIFY(Journal(Journal::usualFolder()).entries().empty());
    }

private:
    std::unique_ptr<DxlBus> m_bus;
};

DYNASCOPE_CORE_TEST(TestDxlJournal)
#include "tst_dxljournal.moc"
