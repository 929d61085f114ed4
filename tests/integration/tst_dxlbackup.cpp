// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/journal/journal.h"
#include "tests/support/dxlbus.h"
#include "tests/support/testmain.h"

#include <QDir>
#include <QFile>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QTemporaryDir>

using namespace Qt::StringLiterals;
using namespace dynascope;
using dynascope::test::DxlBus;
using dynascope::test::isOneSentence;
using dynascope::test::Outcome;

namespace {

QJsonObject objectOf(const Outcome &outcome)
{
    return QJsonDocument::fromJson(outcome.out.toUtf8()).object();
}

} // namespace

/// `dxl backup`, `restore` and `compare`, over a terminal.
class TestDxlBackup : public QObject
{
    Q_OBJECT

private slots:
    void init()
    {
        QDir(Journal::usualFolder()).removeRecursively();
        m_bus = std::make_unique<DxlBus>(u"XM430-W350@57600:1,XM430-W350@57600:2,XL430-W250@57600:3"_s);
        QVERIFY(!m_bus->path().isEmpty());
        m_folder = std::make_unique<QTemporaryDir>();
    }
    void cleanup() { m_bus.reset(); }

    void thereAndBack()
    {
        const QString file = path("a.yaml");
        const Outcome saved = dxl({u"backup"_s, u"1"_s, file});
        QCOMPARE(saved.err, QString());
        QCOMPARE(saved.code, 0);
        QVERIFY2(saved.out.startsWith(u"XM430-W350 (ID 1): ") && saved.out.contains(file), qPrintable(saved.out));
        QCOMPARE(dxl({u"backup"_s, u"1"_s, file}).code, 2); // it is there
        QCOMPARE(dxl({u"backup"_s, u"1"_s, file, u"--replace"_s}).code, 0);
        QCOMPARE(dxl({u"compare"_s, u"1"_s, file}).code, 0);

        m_bus->set(1, 57600, u"Current Limit", 300);
        m_bus->set(1, 57600, u"Position P Gain", 123);
        const Outcome differs = dxl({u"compare"_s, file, u"1"_s});
        QCOMPARE(differs.code, 1);
        QVERIFY2(differs.out.contains(u"Position P Gain") && differs.out.contains(u"2 not")
                     && !differs.out.contains(u"Present"),
                 qPrintable(differs.out));
        m_bus->forget();
        const Outcome dry = dxl({u"restore"_s, u"1"_s, file, u"--dry-run"_s});
        QCOMPARE(dry.code, 0);
        QVERIFY2(dry.out.contains(u"Position P Gain: 123 -> 800") && dry.out.contains(u"2 registers would be written"),
                 qPrintable(dry.out));
        QCOMPARE(dxl({u"restore"_s, u"1"_s, file}).code, 2); // nobody can be asked
        QCOMPARE(writes(), 0);
        const QJsonObject done = objectOf(dxl({u"restore"_s, u"1"_s, file, u"--yes"_s, u"--json"_s}));
        QCOMPARE(done[u"written"].toInt(), 2);
        QCOMPARE(writes(), 2);
        QCOMPARE(m_bus->value(1, 57600, u"Current Limit"), 1193);
        QCOMPARE(m_bus->value(1, 57600, u"Position P Gain"), 800);
        m_bus->forget();
        QCOMPARE(objectOf(dxl({u"restore"_s, u"1"_s, file, u"--yes"_s, u"--json"_s}))[u"written"].toInt(), 0);
        QCOMPARE(writes(), 0);
        const Outcome journal = test::dxl({u"journal"_s});
        QVERIFY2(journal.out.contains(u"Current Limit") && journal.out.count(u'\n') == 2, qPrintable(journal.out));
    }

    void underTorque()
    {
        const QString file = path("a.yaml");
        QCOMPARE(dxl({u"backup"_s, u"1"_s, file}).code, 0);
        m_bus->set(1, 57600, u"Current Limit", 300);
        m_bus->set(1, 57600, u"Torque Enable", 1);
        const Outcome refused = dxl({u"restore"_s, u"1"_s, file, u"--yes"_s});
        QCOMPARE(refused.code, 2);
        QVERIFY2(refused.err.contains(u"--torque-off allows it"), qPrintable(refused.err));
        QCOMPARE(dxl({u"restore"_s, u"1"_s, file, u"--yes"_s, u"--torque-off"_s, u"--torque-back"_s}).code, 0);
        QCOMPARE(m_bus->value(1, 57600, u"Current Limit"), 1193);
        QCOMPARE(m_bus->value(1, 57600, u"Torque Enable"), 1);
    }

    void toItsPlace()
    {
        const QString file = path("a.yaml");
        QCOMPARE(dxl({u"backup"_s, u"1"_s, file}).code, 0);
        m_bus->set(1, 57600, u"Position P Gain", 123);
        const Outcome taken = dxl({u"restore"_s, u"2"_s, file, u"--yes"_s, u"--with-id-and-baud"_s});
        QVERIFY2(taken.code != 0 && taken.err.contains(u"nothing was written"), qPrintable(taken.err));
        QCOMPARE(dxl({u"write"_s, u"1"_s, u"id=9"_s}).code, 0);
        const Outcome moved = dxl({u"restore"_s, u"9"_s, file, u"--yes"_s, u"--with-id-and-baud"_s});
        QVERIFY2(moved.code == 0, qPrintable(moved.err));
        QCOMPARE(m_bus->value(1, 57600, u"Position P Gain"), 800);
    }

    void manyInAFolder()
    {
        const Outcome saved = dxl({u"backup"_s, u"1-3"_s, u"--folder"_s, path("robot"), u"--json"_s});
        QCOMPARE(saved.code, 0);
        const QJsonArray all = QJsonDocument::fromJson(saved.out.toUtf8()).array();
        QCOMPARE(all.size(), 3);
        QCOMPARE(QDir(path("robot")).entryList({u"*.yaml"_s}).size(), 3);
        QVERIFY(QFile::exists(all[2][u"file"].toString()));
        const QString other = all[2][u"file"].toString();
        const Outcome refused = dxl({u"restore"_s, u"1"_s, other, u"--yes"_s});
        QCOMPARE(refused.code, 2);
        QVERIFY2(isOneSentence(refused.err) && refused.err.contains(u"is the backup of a XL430-W250"),
                 qPrintable(refused.err));
        const Outcome files = test::dxl({u"compare"_s, all[0][u"file"].toString(), other, u"--json"_s}); // no line
        QCOMPARE(files.code, 1);
        QVERIFY(objectOf(files)[u"differing"].toInt() > 2);
    }

    void wrongUsage_data()
    {
        QTest::addColumn<QString>("words");
        QTest::addColumn<QString>("says");
        QTest::newRow("no file") << u"restore 1"_s << u"say the backup's FILE"_s;
        QTest::newRow("two devices") << u"restore 1,2 f.yaml"_s << u"one FILE is restored to one device"_s;
        QTest::newRow("file of many") << u"backup 1,2 f.yaml"_s << u"--folder makes a file of each"_s;
        QTest::newRow("file and folder") << u"backup 1 f.yaml --folder x"_s << u"one of them"_s;
        QTest::newRow("back alone") << u"restore 1 f.yaml --torque-back"_s << u"--torque-back is for --torque-off"_s;
        QTest::newRow("in servo with a file") << u"backup 1 f.yaml --in-servo"_s << u"no FILE"_s;
        QTest::newRow("no such file") << u"restore 1 nowhere.yaml"_s << u"nowhere.yaml: "_s;
        QTest::newRow("no ID") << u"compare 1 300"_s << u"300 is no ID"_s;
    }
    void wrongUsage()
    {
        QFETCH(QString, words);
        QFETCH(QString, says);
        m_bus->forget();
        const Outcome outcome = m_bus->dxl(words.split(u' '));
        QCOMPARE(outcome.code, 2);
        QVERIFY2(outcome.err.contains(says), qPrintable(outcome.err));
        QCOMPARE(writes(), 0);
    }

    void inTheServo()
    {
        m_bus->set(1, 57600, u"Return Delay Time", 3);
        const Outcome none = dxl({u"restore"_s, u"1"_s, u"--in-servo"_s, u"--yes"_s});
        QVERIFY2(none.code == 1 && none.err.contains(u"it holds no backup of its own"), qPrintable(none.err));
        QCOMPARE(dxl({u"backup"_s, u"1"_s, u"--in-servo"_s}).code, 0);
        m_bus->set(1, 57600, u"Return Delay Time", 100);
        QCOMPARE(dxl({u"restore"_s, u"1"_s, u"--in-servo"_s}).code, 2); // overwrites EEPROM
        QCOMPARE(dxl({u"restore"_s, u"1"_s, u"--in-servo"_s, u"--yes"_s}).code, 0);
        QCOMPARE(m_bus->value(1, 57600, u"Return Delay Time"), 3);
        const Outcome journal = test::dxl({u"journal"_s, u"export"_s});
        QVERIFY2(journal.out.contains(u"restore --in-servo 1"), qPrintable(journal.out));
    }

private:
    Outcome dxl(const QStringList &words) { return m_bus->dxl(words); }
    QString path(const char *name) const { return m_folder->filePath(QString::fromLatin1(name)); }
    int writes()
    {
        return static_cast<int>(std::ranges::count_if(m_bus->sent(), [](const Bytes &packet) {
            return packet[7] == static_cast<std::uint8_t>(Instruction::Write);
        }));
    }

    std::unique_ptr<DxlBus> m_bus;
    std::unique_ptr<QTemporaryDir> m_folder;
};

DYNASCOPE_CORE_TEST(TestDxlBackup)
#include "tst_dxlbackup.moc"
