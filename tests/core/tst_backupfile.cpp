// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/backup/backup.h"
#include "core/yaml/yamltree.h"
#include "tests/support/backupworld.h"
#include "tests/support/builtincatalog.h"
#include "tests/support/testmain.h"

#include <QElapsedTimer>
#include <QFile>
#include <QTemporaryDir>

using namespace dynascope;
using namespace Qt::StringLiterals;
using test::BackupWorld;

namespace {

/// From line 8 on there is `rest`.
QByteArray withHead(const QByteArray &rest, const QByteArray &model = "XM430-W350", int number = 1020)
{
    return "backup: 1\nmodel: " + model + "\nmodel-number: " + QByteArray::number(number)
           + "\nfirmware: 45\nid: 1\nbaud: 57600\ndate: 2026-11-28T20:30:00Z\n" + rest;
}

} // namespace

/// The file of a backup: what is written is read again, and whatever is wrong is said with its place.
class TestBackupFile : public QObject
{
    Q_OBJECT

private slots:
    void isReadAsWritten_data()
    {
        QTest::addColumn<QString>("servo");
        for (const char *servo : {"XM430-W350@57600:1", "XL330-M288@57600:252", "XL-320@1000000:1",
                                  "H54-100-S500-R@57600:1", "YM070-210-M001-RH@57600:1", "PH54-200-S500-R@57600:3"})
            QTest::newRow(servo) << QString::fromLatin1(servo);
    }
    void isReadAsWritten()
    {
        QFETCH(QString, servo);
        BackupWorld world(m_catalog, servo);
        const auto backup = world.backup();
        QVERIFY2(backup, backup ? "" : qPrintable(backup.error().text));
        QCOMPARE(backup->unread, QStringList());
        QCOMPARE(backup->registers.size(), world.servo().table().fields().size());
        for (const BackupRegister &one : backup->registers) {
            const Field &field = backup->fieldOf(one);
            if (field.access != Access::Read)
                QVERIFY2(one.raw == world.servo().value(field), qPrintable(field.name));
        }
        const QByteArray yaml = toYaml(*backup);
        const auto read = backupFromYaml(yaml, u"f"_s, m_catalog);
        QVERIFY2(read, read ? "" : qPrintable(read.error().text));
        QCOMPARE(toYaml(*read), yaml);
        QCOMPARE(read->registers.size(), backup->registers.size());
        QCOMPARE(read->modelNumber, backup->modelNumber);
        QCOMPARE(read->firmware, world.servo().firmware());
        QCOMPARE(read->id, world.servo().id());
        QCOMPARE(read->baudRate, world.servo().baudRate());
        QCOMPARE(read->at, backup->at);
    }

    void isMadeForPeople()
    {
        BackupWorld world(m_catalog, u"XM430-W350@57600:7"_s);
        world.servo().write(u"Homing Offset", -300);
        const QByteArray yaml = toYaml(*world.backup());
        for (const char *line :
             {"model: XM430-W350", "model-number: 1020", "id: 7", "baud: 57600", "date: 2026-11-28T20:30:00Z",
              "registers:", "readings:", "  Operating Mode: 3                  # Position control",
              "  Homing Offset: -300                # -26.37 \xC2\xB0"})
            QVERIFY2(yaml.contains(QByteArray("\n") + line + '\n'), yaml.constData());
        QVERIFY(world.packets() <= 6);
    }

    void bytesOfAnUnknownModel()
    {
        Backup backup;
        backup.modelNumber = 64000;
        backup.model = modelName(m_catalog, 64000);
        backup.id = 3;
        backup.baudRate = 57600;
        backup.at = QDateTime::fromSecsSinceEpoch(0, Qt::UTC);
        backup.table = m_catalog.findOrRaw(64000, 0);
        backup.bytes = {{0, {1, 2, 255}}, {16, Bytes(16, 7)}};
        const auto read = backupFromYaml(toYaml(backup), u"f"_s, m_catalog);
        QVERIFY2(read, read ? "" : qPrintable(read.error().text));
        QCOMPARE(read->bytes, backup.bytes);
        QVERIFY(!read->isKnownModel());
    }

    void isRefused_data()
    {
        QTest::addColumn<QByteArray>("yaml");
        QTest::addColumn<QString>("says");
        const auto row = [](const char *name, const QByteArray &yaml, const QString &says) {
            QTest::newRow(name) << yaml << says;
        };
        row("empty", "", u"f: empty"_s);
        row("a profile", "profile: 1\n", u"f:1:1: \"backup: 1\" is missing"_s);
        row("newer", "backup: 2\n", u"f:1:9: backup is 1 here, not \"2\""_s);
        row("broken", "backup: 1\nmodel: [\n", u"f:"_s);
        row("tabs", "backup: 1\nregisters:\n\tID: 1\n", u"f:3:"_s);
        row("binary", QByteArray(300, '\0'), u"f:"_s);
        row("an alias", "backup: 1\nmodel: &a b\n", u"f:2:"_s);
        row("no head", "backup: 1\n", u"\"model-number\" is missing"_s);
        row("key twice", withHead("registers:\n  LED: 1\n  LED: 0\n"), u"f:10:3"_s);
        row("register twice", withHead("registers:\n  LED: 1\n  led: 0\n"), u"f:10:3: LED stands in line 9 already"_s);
        row("in both sections", withHead("registers:\n  LED: 1\nreadings:\n  LED: 1\n"), u"f:11:3: LED stands in"_s);
        row("unknown key", withHead("speed: 1\n"), u"f:8:1: \"speed\" is no key"_s);
        row("unknown register", withHead("registers:\n  Operating Mood: 3\n"),
            u"f:9:3: XM430-W350 with firmware 45 has no register \"Operating Mood\"; nearest: Operating Mode"_s);
        row("text", withHead("registers:\n  Operating Mode: fast\n"), u"f:9:19: Operating Mode is a whole number"_s);
        row("a list", withHead("registers:\n  Operating Mode: [3]\n"), u"f:9:19: Operating Mode is a whole number"_s);
        row("nothing", withHead("registers:\n  Operating Mode:\n"), u"Operating Mode is a whole number"_s);
        row("too large", withHead("registers:\n  Operating Mode: 256\n"),
            u"f:9:19: Operating Mode is a whole number from 0 to 255, not \"256\""_s);
        row("too large for any", withHead("registers:\n  LED: 99999999999999999999\n"), u"f:9:8: LED is a whole"_s);
        row("not a number", withHead("registers:\n  LED: 1.5\n"), u"f:9:8: LED is a whole"_s);
        row("a list of registers", withHead("registers:\n  - LED\n"), u"f:9:3: registers are \"Name: value\" lines"_s);
        row("other model's name", withHead("", "XL430-W250"),
            u"f:2:8: model number 1020 is that of XM430-W350, not \"XL430-W250\""_s);
        row("another model inside", withHead("registers:\n  Model Number: 1060\n"),
            u"f:9:17: Model Number is 1060 here, but 1020 above"_s);
        row("unknown model", withHead("registers:\n  LED: 1\n", "NX-1", 64000),
            u"f:9:3: no table tells the registers"_s);
        row("firmware",
            "backup: 1\nmodel: XM430-W350\nmodel-number: 1020\nfirmware: 300\nid: 1\nbaud: 57600\n"
            "date: 2026-11-28T20:30:00Z\n",
            u"f:4:11: firmware is a whole number from 0 to 255"_s);
        row("date",
            "backup: 1\nmodel: XM430-W350\nmodel-number: 1020\nfirmware: 45\nid: 1\nbaud: 57600\n"
            "date: yesterday\n",
            u"f:7:7: date is a time"_s);
        row("bytes", withHead("bytes:\n  70: 'zz'\n"), u"f:9:7: bytes are written as pairs"_s);
        row("half a byte", withHead("bytes:\n  70: '0'\n"), u"f:9:7: bytes are written as pairs"_s);
        row("no address", withHead("bytes:\n  LED: '00'\n"), u"f:9:3: an address is a whole number"_s);
        row("deep", withHead("registers: " + QByteArray(100, '[')), u"f:8:"_s);
    }
    void isRefused()
    {
        QFETCH(QByteArray, yaml);
        QFETCH(QString, says);
        const auto backup = backupFromYaml(yaml, u"f"_s, m_catalog);
        QVERIFY(!backup);
        QCOMPARE(backup.error().kind, ErrorKind::BadFile);
        QVERIFY2(backup.error().text.contains(says), qPrintable(backup.error().text));
    }

    void manyFaultsAreTen()
    {
        QByteArray registers = "registers:\n";
        for (int i = 0; i < 500; ++i)
            registers += "  No " + QByteArray::number(i) + ": 1\n";
        const auto backup = backupFromYaml(withHead(registers), u"f"_s, m_catalog);
        QVERIFY(!backup);
        QCOMPARE(backup.error().text.count(u'\n'), 10);
        QVERIFY(backup.error().text.endsWith(u"f: and 490 more"_s));
    }

    void noiseIsRefusedAtOnce()
    {
        QTemporaryDir folder;
        const QString path = folder.filePath(u"noise.yaml"_s);
        QFile file(path);
        QVERIFY(file.open(QIODevice::WriteOnly));
        const QByteArray megabyte(1024 * 1024, 'x');
        for (int i = 0; i < 100; ++i)
            QCOMPARE(file.write(megabyte), megabyte.size());
        file.close();
        QElapsedTimer timer;
        timer.start();
        const auto backup = loadBackup(path, m_catalog);
        QVERIFY(!backup);
        QVERIFY2(backup.error().text.startsWith(path + u": larger than"_s), qPrintable(backup.error().text));
        QVERIFY2(timer.elapsed() < 500, qPrintable(QString::number(timer.elapsed())));
    }

    void onDisk()
    {
        QTemporaryDir folder;
        BackupWorld world(m_catalog, u"XM430-W350@57600:7"_s);
        const auto backup = world.backup();
        QCOMPARE(suggestedFileName(*backup), u"XM430-W350-id007-20261128-203000.yaml"_s);
        const QString path = folder.filePath(suggestedFileName(*backup));
        QVERIFY(saveBackup(path, *backup));
        const auto read = loadBackup(path, m_catalog);
        QVERIFY2(read, read ? "" : qPrintable(read.error().text));
        QCOMPARE(read->file, path);
        QVERIFY(!saveBackup(folder.filePath(u"none/f.yaml"_s), *backup));
        QCOMPARE(loadBackup(folder.filePath(u"none"_s), m_catalog).error().kind, ErrorKind::NotFound);
        QCOMPARE(loadBackup(folder.path(), m_catalog).error().kind, ErrorKind::BadFile);
    }

private:
    const Catalog m_catalog = test::builtInCatalog();
};

DYNASCOPE_CORE_TEST(TestBackupFile)
#include "tst_backupfile.moc"
