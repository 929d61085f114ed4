// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/dxlprocess.h"
#include "tests/support/testmain.h"

#include <QDir>
#include <QFile>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>

using namespace Qt::StringLiterals;
using dynascope::test::dxl;
using dynascope::test::Outcome;

/// `dxl models`: the library of control tables on the command line.
class TestDxlModels : public QObject
{
    Q_OBJECT

    QTemporaryDir m_folder;

    QString file(const QString &name, const QByteArray &bytes)
    {
        QFile out(m_folder.filePath(name));
        if (!out.open(QIODevice::WriteOnly) || out.write(bytes) != bytes.size())
            qFatal("can't write %s", qPrintable(name));
        return out.fileName();
    }

private slots:
    void init() { qputenv("DYNASCOPE_TABLES", QFile::encodeName(m_folder.path())); }
    void cleanup()
    {
        for (const QString &name : QDir(m_folder.path()).entryList(QDir::Files))
            QFile::remove(m_folder.filePath(name));
    }

    void listsAll()
    {
        const Outcome outcome = dxl({u"models"_s});
        QCOMPARE(outcome.code, 0);
        QCOMPARE(outcome.out.count(u'\n'), 109);
        QVERIFY(outcome.out.contains(u" 1020 XM430-W350"_s));
        QVERIFY(outcome.out.contains(u" 1700 XC335-T332"_s) && outcome.out.contains(u"addresses only"_s));
    }

    void listsAllAsJson()
    {
        const Outcome outcome = dxl({u"--json"_s, u"models"_s, u"list"_s});
        const QJsonArray models = QJsonDocument::fromJson(outcome.out.toUtf8()).array();
        QCOMPARE(models.size(), 109);
        QCOMPARE(models[0].toObject().value(u"model").toString(), u"MX-28(2.0)"_s);
        QCOMPARE(models[0].toObject().value(u"newest_firmware").toInt(), 45);
        QCOMPARE(models[0].toObject().value(u"file").toString(), u"mx.json"_s);
    }

    void shows_data()
    {
        QTest::addColumn<QString>("model");
        QTest::addColumn<QString>("has");
        QTest::newRow("by name") << u"xl-320"_s << u"   32  2 RAM    RW Moving Speed"_s;
        QTest::newRow("by number") << u"1060"_s << u"XL430-W250, model number 1060"_s;
        QTest::newRow("other name") << u"XC430-T150BB"_s << u"XC430-W150, model number 1070"_s;
        QTest::newRow("older firmware") << u"XL330-M288/52"_s << u"firmware 46 to 52"_s;
        QTest::newRow("newer than known") << u"XL330-M288/60"_s << u"Firmware 60 is newer than the newest known, 53"_s;
        QTest::newRow("doubtful") << u"YM070-210-M001-RH"_s << u"(doubtful: 0.01 V in every manual"_s;
        QTest::newRow("values") << u"XM430-W350"_s << u"0 Current control, 1 Velocity control"_s;
        QTest::newRow("bits") << u"XM430-W350"_s << u"bit 0 Input voltage"_s;
        QTest::newRow("gear") << u"YM070-210-R051-RH"_s << u"geared: "_s;
        QTest::newRow("gears in front of the joint")
            << u"YM070-210-R051-RH"_s << u"524288 pulses per motor turn, gear ratio 51."_s;
        QTest::newRow("no gears") << u"YM070-210-M001-RH"_s << u"524288 steps per turn."_s;
        QTest::newRow("abilities") << u"XL330-M288"_s
                                   << u"Fast reads from firmware 46, backup from firmware 46, clear"_s;
        QTest::newRow("addresses only") << u"HX5-D20-RR"_s << u" 1149  1 ?      ?  SyncTable 1 Read Data 72"_s;
    }

    void shows()
    {
        QFETCH(QString, model);
        QFETCH(QString, has);
        const Outcome outcome = dxl({u"models"_s, u"show"_s, model});
        QCOMPARE(outcome.code, 0);
        QVERIFY2(outcome.out.contains(has), qPrintable(outcome.out.left(2000)));
    }

    void showsAsJson()
    {
        const Outcome outcome = dxl({u"--json"_s, u"models"_s, u"show"_s, u"XM430-W350"_s});
        const QJsonObject table = QJsonDocument::fromJson(outcome.out.toUtf8()).object();
        QCOMPARE(table.value(u"number").toInt(), 1020);
        const QJsonObject id = table.value(u"registers").toArray().at(3).toObject();
        QCOMPARE(id.value(u"name").toString(), u"ID"_s);
        QCOMPARE(id.value(u"area").toString(), u"EEPROM"_s);
        QCOMPARE(id.value(u"maximum").toString(), u"252"_s);
    }

    void showsAlternatesAsJson()
    {
        const Outcome outcome = dxl({u"--json"_s, u"models"_s, u"show"_s, u"XL-320"_s});
        const QJsonArray registers =
            QJsonDocument::fromJson(outcome.out.toUtf8()).object().value(u"registers").toArray();
        QJsonArray alternates;
        for (const QJsonValue &one : registers) {
            if (one[u"name"].toString() == u"Moving Speed")
                alternates = one[u"alternates"].toArray();
        }
        QCOMPARE(alternates.size(), 2);
        QCOMPARE(alternates[0][u"register"].toString(), u"Control Mode"_s);
        QCOMPARE(alternates[0][u"values"][0][u"value"].toInt(), 1);
        QCOMPARE(alternates[0][u"unit"].toString(), u"%"_s);
        QCOMPARE(alternates[0][u"direction_bit"].toInt(), 10);
        QCOMPARE(alternates[1][u"maximum"].toString(), u"1023"_s);
    }

    void refuses_data()
    {
        QTest::addColumn<QStringList>("arguments");
        QTest::addColumn<int>("code");
        QTest::addColumn<QString>("says");
        QTest::newRow("unknown") << QStringList{u"show"_s, u"XQ1"_s} << 2 << u"no model is called XQ1"_s;
        QTest::newRow("series") << QStringList{u"show"_s, u"XL330"_s} << 2
                                << u"no model is called XL330; nearest: XL330-M077, XL330-M288"_s;
        QTest::newRow("firmware") << QStringList{u"show"_s, u"1020/new"_s} << 2 << u"number from 0 to 255"_s;
        QTest::newRow("no file") << QStringList{u"check"_s, u"/nowhere.json"_s} << 1 << u"/nowhere.json: "_s;
        QTest::newRow("no model") << QStringList{u"show"_s} << 2 << u"required"_s;
    }

    void refuses()
    {
        QFETCH(QStringList, arguments);
        QFETCH(QString, says);
        const Outcome outcome = dxl(QStringList{u"models"_s} + arguments);
        QTEST(outcome.code, "code");
        QVERIFY2(outcome.err.contains(says), qPrintable(outcome.err));
        QVERIFY(outcome.out.isEmpty());
    }

    void checksWithTheLine()
    {
        const QString bad = file(u"bad.txt"_s, "{ \"format\": 2, \"extends\": \"x330\",\n  \"registers\": {\n"
                                               "    \"LED\": { \"unit\": \"lux\" }\n  },\n"
                                               "  \"models\": { \"Own\": { \"number\": 9001 } } }\n");
        const Outcome outcome = dxl({u"models"_s, u"check"_s, bad});
        QCOMPARE(outcome.code, 1);
        QCOMPARE(outcome.err, u"dxl: %1: line 3: Own: LED: unknown unit \"lux\"\n"_s.arg(bad));
        const QString good = file(u"good.txt"_s, "{ \"format\": 2, \"extends\": \"x330\", "
                                                 "\"models\": { \"Own\": { \"number\": 9001 } } }\n");
        QCOMPARE(dxl({u"models"_s, u"check"_s, good}).out, u"%1: sound, 1 new model\n"_s.arg(good));
    }

    /// A file that is in use already is no hindrance to itself or to a copy, nor are others of the folder mentioned.
    void checksWhatIsInUse()
    {
        file(u"bad.json"_s, "no table");
        const QByteArray json = "{ \"format\": 2, \"extends\": \"x330\", "
                                "\"models\": { \"Own\": { \"number\": 9001 } } }\n";
        const QString own = file(u"own.json"_s, json);
        const Outcome outcome = dxl({u"models"_s, u"check"_s, own});
        QCOMPARE(outcome.err, QString());
        QCOMPARE(outcome.out, u"%1: sound, 1 new model\n"_s.arg(own));
        const QString copy = file(u"copy.txt"_s, json);
        QCOMPARE(dxl({u"models"_s, u"check"_s, copy}).out, u"%1: sound, the same as %2\n"_s.arg(copy, own));
    }

    void checksATableOfTheProgram()
    {
        QFile table(QStringLiteral(DYNASCOPE_SOURCE_DIR) + u"/resources/controltables/x330.json"_s);
        QVERIFY(table.open(QIODevice::ReadOnly));
        const QString same = file(u"x330.txt"_s, table.readAll());
        const Outcome outcome = dxl({u"models"_s, u"check"_s, same});
        QCOMPARE(outcome.code, 0);
        QCOMPARE(outcome.out, u"%1: sound, the same as the built-in x330.json\n"_s.arg(same));
    }

    void badFiles_data()
    {
        QTest::addColumn<QByteArray>("bytes");
        QTest::addColumn<QString>("says"); // behind the file's name
        const QByteArray model = "\n\"models\": { \"Own\": { \"number\": 9001 } } }";
        QTest::newRow("empty") << QByteArray() << u"line 1: "_s;
        QTest::newRow("no JSON") << QByteArray("address,size,name\n0,2,Model Number\n") << u"line 1: "_s;
        QTest::newRow("binary") << QByteArray("\x7f" "ELF\0\0\0", 7) << u"line 1: "_s;
        QTest::newRow("cut off") << QByteArray("{ \"format\": 2,\n\"extends\": \"x") << u"line 2: "_s;
        QTest::newRow("huge") << QByteArray("{ \"format\": 2 }") + QByteArray(1 << 20, ' ')
                              << u"larger than 1048576 bytes"_s;
        QTest::newRow("deep") << QByteArray("{ \"format\": 2,\n\"registers\": ") + QByteArray(100'000, '[')
                              << u"line 2: "_s;
        const auto registers = [&model](const QByteArray &text) {
            return "{ \"format\": 2, \"extends\": \"x330\", \"registers\": {\n" + text + " }," + model;
        };
        QTest::newRow("key twice") << registers("\"LED\": {},\n\"LED\": {}") << u"line 3: "_s;
        QTest::newRow("unknown key") << "{ \"format\": 2,\n\"color\": 1," + model << u"line 2: "_s;
        QTest::newRow("of tomorrow") << QByteArray("{\n\"format\": 3 }") << u"line 2: "_s;
        QTest::newRow("extends nothing") << "{ \"format\": 2,\n\"extends\": \"x999\"," + model
                                         << u"line 2: extends \"x999\", which is not there"_s;
        QTest::newRow("overlap") << registers("\"LED\": { \"address\": 64 }")
                                 << u"line 2: Own: Torque Enable: overlaps LED at address 64"_s;
        QTest::newRow("range that its size can't hold")
            << registers("\"LED\": { \"values\": null,\n\"range\": [0, 256] }") << u"line 3: Own: LED: "_s;
        QTest::newRow("turned range") << registers("\"Current Limit\": { \"range\": [9, 1] }")
                                      << u"line 2: Own: Current Limit: "_s;
        QTest::newRow("limited by nobody")
            << registers("\"Goal PWM\": { \"range\": [0, \"PWM Limits\"] }")
            << u"line 2: Own: Goal PWM: limited by PWM Limits, which is no other register"_s;
        QTest::newRow("of a built-in model")
            << QByteArray("{ \"format\": 2, \"extends\": \"x330\",\n\"models\": { \"Own\": {\n\"number\": 1020 } } }")
            << u"line 3: Own: this name or the number 1020 is taken by XM430-W350"_s;
    }

    /// Whatever it is: refused with its place, in one sentence, soon.
    void badFiles()
    {
        QFETCH(QByteArray, bytes);
        QFETCH(QString, says);
        const QString path = file(u"bad.txt"_s, bytes);
        const Outcome outcome = dxl({u"models"_s, u"check"_s, path});
        QCOMPARE(outcome.code, 1);
        QVERIFY(outcome.out.isEmpty());
        QVERIFY2(outcome.err.startsWith(u"dxl: %1: %2"_s.arg(path, says)), qPrintable(outcome.err.left(500)));
        QCOMPARE(outcome.err.count(u'\n'), 1);
        QVERIFY(outcome.err.size() < 500);
        // The same file in the person's folder is said, and changes nothing.
        QVERIFY(QFile::rename(path, m_folder.filePath(u"bad.json"_s)));
        const Outcome listed = dxl({u"models"_s});
        QCOMPARE(listed.code, 0);
        QCOMPARE(listed.out.count(u'\n'), 109);
        QVERIFY2(listed.err.contains(u"bad.json: %1"_s.arg(says)), qPrintable(listed.err.left(500)));
    }

    void badImports_data()
    {
        QTest::addColumn<QByteArray>("bytes");
        QTest::addColumn<QString>("says");
        QTest::newRow("empty") << QByteArray() << u""_s;
        QTest::newRow("no table") << QByteArray("Hello\nworld\n") << u""_s;
        QTest::newRow("huge") << QByteArray(2 << 20, '\n') << u"larger than 1048576 bytes"_s;
        QTest::newRow("overlap") << QByteArray("address,size,name\n0,4,One\n2,2,Two\n") << u"line 3"_s;
        QTest::newRow("size") << QByteArray("address,size,name\n0,3,One\n") << u"line 2"_s;
    }

    void badImports()
    {
        QFETCH(QByteArray, bytes);
        QFETCH(QString, says);
        const QString out = m_folder.filePath(u"out.json"_s);
        const Outcome outcome = dxl({u"models"_s, u"import"_s, file(u"bad.csv"_s, bytes), u"--number"_s, u"9001"_s,
                                     u"--out"_s, out});
        QCOMPARE(outcome.code, 1);
        QVERIFY(outcome.out.isEmpty() && !QFile::exists(out));
        QVERIFY2(outcome.err.contains(u"bad.csv"_s) && outcome.err.contains(says), qPrintable(outcome.err));
    }

    /// A file imported into the folder is a model at the next start.
    void importsAndUses()
    {
        const QString csv =
            file(u"xq_1.csv"_s, "address,size,name,area,access,initial\n0,2,Model Number,EEPROM,R,1999\n"
                                "64,1,Torque Enable,RAM,RW,0\n");
        const QString own = m_folder.filePath(u"own.json"_s);
        const Outcome imported = dxl({u"models"_s, u"import"_s, csv, u"--out"_s, own});
        QCOMPARE(imported.code, 0);
        QVERIFY(imported.out.isEmpty() && imported.err.contains(u"written to "_s));
        const Outcome again = dxl({u"models"_s, u"import"_s, csv, u"--out"_s, own});
        QCOMPARE(again.code, 2);
        QVERIFY(again.err.contains(u"is there already"_s));
        QVERIFY(dxl({u"models"_s, u"show"_s, u"XQ-1"_s}).out.contains(u"   64  1 RAM    RW Torque Enable"_s));
        QVERIFY(dxl({u"models"_s}).out.contains(u"from own.json"_s));
        QVERIFY(dxl({u"models"_s, u"import"_s, csv}).out.startsWith(u"{\n  \"format\": 2,"_s));
    }

    /// What it would be refused for at the next start is said when it is made.
    void importSaysWhatIsTaken()
    {
        const QString csv = file(u"xq_1.csv"_s, "address,size,name\n0,2,Model Number\n");
        const auto noted = [&csv](const QString &name, const QString &number) {
            return dxl({u"models"_s, u"import"_s, csv, u"--name"_s, name, u"--number"_s, number});
        };
        const Outcome free = noted(u"XQ-1"_s, u"9001"_s);
        QVERIFY2(free.code == 0 && free.err.isEmpty(), qPrintable(free.err));
        const Outcome name = noted(u"XM430-W350"_s, u"9001"_s);
        QCOMPARE(name.code, 0);
        QVERIFY2(name.err.contains(u"this name is taken by XM430-W350 (number 1020)"_s), qPrintable(name.err));
        const Outcome number = noted(u"XQ-1"_s, u"1020"_s);
        QVERIFY2(number.code == 0 && number.err.contains(u"the number 1020 is taken by XM430-W350"_s),
                 qPrintable(number.err));
    }

    void aBadFileOfOnesOwnIsSaid()
    {
        file(u"own.json"_s,
             "{ \"format\": 2,\n  \"extends\": \"x330\",\n  \"models\": { \"Own\": { \"number\": 1020 } } }");
        const Outcome outcome = dxl({u"models"_s, u"show"_s, u"1020"_s});
        QCOMPARE(outcome.code, 0);
        QVERIFY(outcome.out.startsWith(u"XM430-W350, "_s));
        QVERIFY2(outcome.err.contains(u"own.json: line 3: Own: this name or the number 1020 is taken by XM430-W350"_s),
                 qPrintable(outcome.err));
    }
};

DYNASCOPE_CORE_TEST(TestDxlModels)
#include "tst_dxlmodels.moc"
