// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/table/catalog.h"
#include "core/table/jsonguard.h"
#include "tests/support/testmain.h"

#include <QFile>

using namespace dynascope;

namespace {

/// A file with one of everything, for the tests to damage.
QByteArray contents(const QString &path)
{
    QFile file(path);
    if (!file.open(QIODevice::ReadOnly))
        qFatal("no %s", qPrintable(path));
    return file.readAll();
}

QByteArray resource(const QString &name)
{
    return contents(QStringLiteral(":/controltables/") + name);
}

/// A file with one of everything, for the tests to damage.
QString sound()
{
    return QString::fromUtf8(contents(QStringLiteral(DYNASCOPE_SOURCE_DIR "/tests/data/tables/sound.json")));
}

Error errorOf(const QByteArray &json)
{
    Catalog catalog;
    const Result<void> added = catalog.add(json, QStringLiteral("t.json"));
    return added ? Error{ErrorKind::Cancelled, QStringLiteral("accepted"), 0} : added.error();
}

} // namespace

class TestTableFile : public QObject
{
    Q_OBJECT

private slots:
    void aSoundFile()
    {
        Catalog catalog;
        const Result<void> added = catalog.add(sound().toUtf8(), QStringLiteral("/some/folder/t.json"));
        QVERIFY2(added, added ? "" : qPrintable(added.error().text));
        const ControlTablePtr before = catalog.find(7, 2), after = catalog.find(7, 3);
        QVERIFY(before && after && before != after);
        QCOMPARE(before->at(70)->name, QStringLiteral("Old"));
        QCOMPARE(after->at(70)->name, QStringLiteral("New"));
        QCOMPARE(after->find(u"Goal")->help, QStringLiteral("Goes."));
        QCOMPARE(after->find(u"Goal")->alternates.size(), std::size_t(2));
        QCOMPARE(after->find(u"Goal")->alternates[1].mask, std::uint32_t(1));
        QCOMPARE(after->find(u"Goal")->alternates[1].minimum.reg, QStringLiteral("Limit"));
        QCOMPARE(after->find(u"Goal")->alternates[0].unit == Unit::Pulse, true);
        QCOMPARE(int(after->find(u"Flags")->maximum.number.value_or(0)), 0x31);
        QCOMPARE(int(after->find(u"Port 3")->address), 76);
        QCOMPARE(int(after->find(u"Indirect Data 2")->address), 95);
        QCOMPARE(int(after->find(u"Indirect Address 2")->initial.value_or(0)), 95);
        QVERIFY(!after->hasFastReads(2) && after->hasFastReads(3) && !after->hasBackup(255));
    }

    void theReceiveBuffer()
    {
        const auto bufferOf = [](const QString &json) {
            Catalog catalog;
            const Result<void> added = catalog.add(json.toUtf8(), QStringLiteral("t.json"));
            return added ? catalog.find(7, 3)->receiveBuffer() : -1;
        };
        QCOMPARE(bufferOf(sound()), 1024); // not stated
        QString stated = sound();
        stated.replace(QStringLiteral("\"format\": 1"), QStringLiteral("\"format\": 1, \"receiveBuffer\": 512"));
        QCOMPARE(bufferOf(stated), 512);
        stated.replace(QStringLiteral("\"number\": 7"), QStringLiteral("\"number\": 7, \"receiveBuffer\": 256"));
        QCOMPARE(bufferOf(stated), 256); // the model's own
    }

    void damaged_data()
    {
        QTest::addColumn<QString>("from");
        QTest::addColumn<QString>("to");
        QTest::addColumn<QString>("message");
        QTest::addColumn<int>("line"); // 0: the one that was damaged; -1: none
        const auto row = [](const char *from, const QByteArray &to, const char *message, int line = 0) {
            QTest::addRow("%s", message) << QString::fromUtf8(from) << QString::fromUtf8(to)
                                         << QString::fromUtf8(message) << line;
        };
        // The file
        row("\"format\": 1", "\"format\": 3", "\"format\" must be 1 or 2");
        row("\"format\": 1,", "", "\"format\" must be 1 or 2", -1);
        row("\"format\": 1", "\"format\": 1, \"colour\": 3", "unknown key \"colour\"");
        row("\"format\": 1", "\"format\": 1, \"extends\": \"x\"", "extends \"x\", which is not there");
        row("\"series\": \"T\"", "\"series\": \"T\", \"series\": \"U\"", "line 3: \"series\" stands twice");
        row("\"series\": \"T\"", "\"ser\\u0069es\": \"T\"", "line 3: a key with an escape in it");
        row("\"series\": \"T\",", "\"series\": \"T\"", "line 4: not JSON (unterminated object)");
        row("\"series\": \"T\",", "", "T-1: \"series\" is missing", 31);
        row("\"resolution\": 4096", "\"resolution\": 0",
            "T-1: \"resolution\" must be a whole number from 1 to 100000000");
        row("\"resolution\": 4096", "\"resolution\": 1.5",
            "T-1: \"resolution\" must be a whole number from 1 to 100000000");
        row("\"newestFirmware\": 5", "\"newestFirmware\": 256",
            "T-1: \"newestFirmware\" must be a whole number from 0 to 255");
        row("\"fastReadsSince\": 3", "\"fastReadsSince\": \"3\"",
            "T-1: \"fastReadsSince\" must be a whole number from 0 to 255");
        for (const char *bytes : {"63", "65536", "\"256\"", "256.5"}) {
            row("\"number\": 7", QByteArray("\"number\": 7, \"receiveBuffer\": ") + bytes,
                "T-1: \"receiveBuffer\" must be a whole number from 64 to 65535");
        }
        row("\"1\": 57600", "\"one\": 57600",
            "T-1: \"baudRates\" must be codes from 0 to 255 and rates in bits per second");
        row("\"1\": 57600", "\"1\": 0", "T-1: \"baudRates\" must be codes from 0 to 255 and rates in bits per second");
        row("\"number\": 7", "\"number\": 70000", "T-1: \"number\" must be a whole number from 0 to 65535");
        row("\"number\": 7", "\"number\": 7, \"extends\": \"x\"", "T-1: unknown key \"extends\"");
        row("https:", "ftp:", "T-1: \"manual\" must be an https address");
        row("\"T-1\": {", "\"t_1\": { \"number\": 8, \"manual\": \"https://example.org\" }, \"T-1\": {",
            "T-1: this name is taken by t_1 (number 8); give another name");
        row("\"T-1\": {", "\"T-2\": { \"number\": 7, \"manual\": \"https://example.org\" }, \"T-1\": {",
            "T-1: this name or the number 7 is taken by T-2; \"replaces\": 7 takes its place");
        row("\"models\": {", "\"models\": [], \"model\": {", "unknown key \"model\"");
        row("{ \"number\": 7, \"manual\": \"https://example.org/t-1\" }", "7", "\"T-1\" must be an object");
        // Merging
        row("\"number\": 7", "\"number\": 7, \"registers\": { \"Gaol\": null }",
            "T-1: Gaol is removed, but isn't there");
        row("\"number\": 7", "\"number\": 7, \"registers\": { \"Old\": { \"since\": null } }",
            "T-1: Old: since is removed, but isn't there");
        row("\"number\": 7", "\"number\": 7, \"registers\": { \"Limit\": null }",
            "T-1: Goal: limited by Limit, which is no other register", 23);
        row("\"number\": 7", "\"number\": 7, \"registers\": { \"Typo\": { \"initial\": 3 } }",
            "T-1: Typo: \"size\" is missing, and what the file extends defines no register of this name");
        // Registers
        row("\"address\": 0,", "\"adress\": 0,", "Model Number: unknown key \"adress\"");
        row("\"address\": 0,", "", "T-1: Model Number: \"address\" must be a number from 0 to 65534");
        row("\"address\": 0,", "\"address\": 65535,",
            "T-1: Model Number: \"address\" must be a number from 0 to 65534");
        row("\"address\": 0,", "\"address\": -1,", "T-1: Model Number: \"address\" must be a number from 0 to 65534");
        row("\"address\": 8,", "\"address\": 11,", "T-1: Mode: overlaps Baud Rate at address 11", 17);
        row("\"address\": 20,", "\"address\": 62,", "T-1: Goal: overlaps Limit at address 64", 23);
        row("\"address\": 90,", "\"address\": 92,", "T-1: Indirect Address 2: overlaps Indirect Data 1 at address 94");
        row("\"size\": 2, \"area\": \"EEPROM\"", "\"size\": 3, \"area\": \"EEPROM\"",
            "T-1: Model Number: \"size\" must be 1, 2 or 4");
        row("\"signed\": true", "\"signed\": 1", "T-1: Goal: \"signed\" must be true or false");
        row("\"area\": \"EEPROM\", \"access\": \"R\"", "\"area\": \"ROM\", \"access\": \"R\"",
            "T-1: Model Number: \"area\" must be \"EEPROM\", \"RAM\" or \"HYBRID\"");
        row("\"access\": \"R\"", "\"access\": \"W\"", "T-1: Model Number: \"access\" must be \"R\" or \"RW\"");
        row("\"model number\"", "\"serial number\"",
            "T-1: Model Number: \"initial\" must be a whole number or \"model number\"");
        row("\"initial\": 100", "\"initial\": 1.5",
            "T-1: Limit: \"initial\" must be a whole number or \"model number\"");
        row("\"initial\": 100", "\"initial\": 4096", "T-1: Limit: initial value 4096 lies outside the range");
        row("\"initial\": 100", "\"initial\": -1", "T-1: Limit: initial value -1 doesn't fit unsigned 4 byte(s)");
        row("[0, 4095]", "[4095, 0]", "T-1: Limit: range 4095 to 0 is upside down");
        row("[0, 4095]", "[0, 4294967296]", "T-1: Limit: limit 4294967296 doesn't fit unsigned 4 byte(s)");
        row("[0, 4095]", "[0]",
            "T-1: Limit: \"range\" must be [minimum, maximum], or \"values\" or \"bits\" of a register that has them");
        row("[0, 4095]", "\"bits\"",
            "T-1: Limit: \"range\" must be [minimum, maximum], or \"values\" or \"bits\" of a register that has them");
        row("[0, 4095]", "[0, true]", "T-1: Limit: a limit must be a whole number or the name of a register");
        row("\"-Limit\"", "\"-Limits\"", "T-1: Goal: limited by Limits, which is no other register");
        row("\"-Limit\"", "\"Goal\"", "T-1: Goal: limited by Goal, which is no other register");
        row("\"pulse\"", "\"furlong\"", "T-1: Goal: unknown unit \"furlong\"");
        row("\"scale\": 2", "\"scale\": 0",
            "T-1: Goal: \"scale\" must be a number above 0, or the name of one of \"scales\"");
        row("\"help\": \"Bounds.\"", "\"help\": \"Bounds.\", \"scale\": 2", "T-1: Limit: \"scale\" without \"unit\"");
        row("\"help\": \"Bounds.\"", "\"help\": 5", "T-1: Limit: \"help\" must be a text of at most 600 characters");
        row("\"Limit\": {", "\" Limit\": {", "T-1:  Limit: not a name for a register");
        row("\"Port #\": { \"address\": 72, \"count\": 3,", "\"li-mit\": { \"address\": 72,",
            "T-1: Limit and li-mit are one name");
        // Format 2
        row("\"series\": \"T\"", "\"series\": \"T\", \"uses\": [\"brake\"]", "uses \"brake\", which is no variant");
        row("\"series\": \"T\"", "\"series\": \"T\", \"uses\": \"brake\"", "\"uses\" must be a list of texts");
        row("\"series\": \"T\"", "\"series\": \"T\", \"uses\": [\"v\"], \"variants\": { \"v\": { \"registers\": { \"X\": null } } }",
            "X is removed, but isn't there");
        row("\"series\": \"T\"", "\"series\": \"T\", \"variants\": { \"v\": { \"series\": \"U\" } }",
            "v: unknown key \"series\"");
        row("\"number\": 7", "\"number\": 7, \"gearRatio\": [\"Limit\", \"Gone\"]",
            "T-1: \"gearRatio\" must be two registers");
        row("\"number\": 7", "\"number\": 7, \"torqueConstant\": -1", "T-1: \"torqueConstant\" must be a number above 0");
        row("\"number\": 7", "\"number\": 7, \"replaces\": 8",
            "T-1: \"replaces\" must be the number of this model and of one that is there");
        row("\"number\": 7", "\"number\": 7, \"axes\": 0", "T-1: \"axes\" must be a whole number from 1 to 8");
        row("\"resolution\": 4096,", "", "T-1: Goal: counts in pulses, but \"resolution\" is missing", 23);
        row("\"scale\": 2", "\"scale\": \"fast\"", "T-1: Goal: \"scales\" has no \"fast\"");
        row("\"help\": \"Bounds.\"", "\"help\": \"Bounds.\", \"directionBit\": 32",
            "T-1: Limit: \"directionBit\" must be a bit above the lowest of an unsigned register");
        row("\"help\": \"Bounds.\"", "\"help\": \"Bounds.\", \"doubt\": 1",
            "T-1: Limit: \"doubt\" must be a text of at most 600 characters");
        row("\"help\": \"Bounds.\"", "\"help\": \"Bounds.\", \"special\": \"codes\"",
            "T-1: Limit: \"special\" must be an object, \"baud rates\" or one of \"valueLists\"");
        row("\"count\": 3,", "\"count\": 3, \"stride\": 0,", "T-1: Port #: \"stride\" must be a whole number from 1 to 256");
        row("\"count\": 3,", "\"count\": 3, \"stride\": 1,", "T-1: Port 2: overlaps Port 1 at address 73");
        // Values, bits, alternates
        row("\"3\": \"Joint\"", "\"x\": \"Joint\"", "T-1: Mode: \"x\" is not a whole number");
        row("\"3\": \"Joint\"", "\"03\": \"Joint\"", "T-1: Mode: \"03\" is not a whole number");
        row("\"3\": \"Joint\"", "\"300\": \"Joint\"", "T-1: Mode: value 300 doesn't fit unsigned 1 byte(s)");
        row("\"Joint\"", "\"wheel\"", "T-1: Mode: two values are called \"Wheel\"");
        row("\"Joint\"", "\"Joint, or not\"",
            "T-1: Mode: \"Joint, or not\" is not a name: 1 to 80 characters, no + and no comma");
        row("\"Joint\"", "3", "T-1: Mode: \"\" is not a name: 1 to 80 characters, no + and no comma");
        row("{ \"3\": \"Joint\", \"4\": \"Wheel\" }", "[1]", "Mode: \"values\" must be an object");
        row("\"values\": \"baud rates\"", "\"values\": \"bauds\"",
            "T-1: Baud Rate: \"values\" must be an object, \"baud rates\" or one of \"valueLists\"");
        row("{ \"bit\": 0 }", "0", "T-1: Flags: bit \"First\" must be an object");
        row("{ \"bit\": 0 }", "{ \"bit\": 8 }",
            "T-1: Flags: \"First\" needs \"bit\": n or \"bits\": [first, last] within the register");
        row("{ \"bit\": 0 }", "{ \"bit\": 0, \"bits\": [0, 1] }",
            "T-1: Flags: \"First\" needs \"bit\": n or \"bits\": [first, last] within the register");
        row("{ \"bit\": 0 }", "{ \"bit\": 0, \"mask\": 1 }", "Flags: First: unknown key \"mask\"");
        row("{ \"bit\": 0 }", "{ \"bit\": 5 }", "T-1: Flags: \"First\" and \"Shape\" overlap");
        row("\"1\": \"Round\"", "\"4\": \"Round\"", "T-1: Flags: value 4 doesn't fit \"Shape\"");
        row("\"resets\": [\"Goal\"]", "\"resets\": [\"Gaol\"]", "T-1: Mode: resets Gaol, which is no register");
        row("\"resets\": [\"Goal\"]", "\"needs\": \"luck\"", "T-1: Mode: \"needs\" must be \"torque off\"");
        row("\"resets\": [\"Goal\"]", "\"resets\": \"Goal\"", "T-1: Mode: \"resets\" must be a list of registers");
        row("\"register\": \"Mode\"", "\"register\": \"Moed\"",
            "T-1: Goal: an alternate needs \"register\", one of this table, and either \"bit\" or \"values\"");
        row("\"values\": [4]", "\"values\": [5]", "T-1: Goal: Mode has none of the values of an alternate");
        row("\"bit\": \"First\"", "\"bit\": \"Second\"", "T-1: Goal: Flags has no single bit \"Second\"");
        row("\"bit\": \"First\"", "\"bit\": \"Shape\"", "T-1: Goal: Flags has no single bit \"Shape\"");
        row("\"bit\": \"First\"", "\"when\": 1", "Goal: unknown key \"when\"");
        row("[-99999, 99999]", "[-99999, \"Far\"]", "T-1: Goal: limited by Far, which is no other register");
        // Firmware, numbered registers, indirect blocks
        row("\"until\": 2", "\"until\": 300", "T-1: Old: \"until\" must be a whole number from 0 to 255");
        row("\"until\": 2", "\"since\": 4, \"until\": 2", "T-1: Old: \"since\" is later than \"until\"");
        row("\"until\": 2", "\"until\": 3", "T-1: Old: overlaps New at address 70");
        row("\"Port #\"", "\"Port\"", "T-1: Port: \"count\" needs a # in the name, for the number");
        row("\"count\": 3", "\"count\": 0", "T-1: Port #: \"count\" must be a whole number from 1 to 512");
        row("\"count\": 3, ", "", "T-1: Port #: \"count\" must be a whole number from 1 to 512");
        row("\"count\": 2", "\"count\": 100000", "T-1: indirect: \"count\" must be a whole number from 1 to 512");
        row("\"dataAddress\": 94", "\"data\": 94", "indirect: unknown key \"data\"");
        row("\"range\": [64, 99], ", "", "T-1: indirect: needs \"range\", and definitions of the two registers");
        row("\"range\": [64, 99], ", "\"range\": [64, 90], ",
            "T-1: Indirect Address 1: initial value 94 lies outside the range");
        row("\"indirect\": [ {", "\"indirect\": [ 5, {", "\"indirect\" must be a list of objects");
    }

    void damaged()
    {
        QFETCH(QString, from);
        QFETCH(QString, to);
        QString text = sound();
        const qsizetype at = text.indexOf(from);
        QVERIFY(at >= 0);
        text.replace(at, from.size(), to);
        const Error error = errorOf(text.toUtf8());
        QFETCH(QString, message);
        QFETCH(int, line);
        if (line == 0)
            line = int(QStringView(text).first(at).count(u'\n')) + 1;
        if (line > 0 && !message.startsWith(u"line "))
            message.prepend(QStringLiteral("line %1: ").arg(line));
        QCOMPARE(error.text, QStringLiteral("t.json: ") + message);
        QCOMPARE(error.kind, ErrorKind::BadFile);
    }

    void notEvenJson_data()
    {
        QTest::addColumn<QByteArray>("json");
        QTest::addColumn<QString>("message");
        QTest::newRow("nothing") << QByteArray() << QStringLiteral("line 1: not JSON (illegal value)");
        QTest::newRow("text") << QByteArray("\n\nhello") << QStringLiteral("line 3: not JSON (illegal value)");
        QTest::newRow("list") << QByteArray("[]") << QStringLiteral("not a JSON object");
        QTest::newRow("open string") << QByteArray("{\n\"a")
                                     << QStringLiteral("line 2: not JSON (unterminated string)");
        QTest::newRow("after the end") << QByteArray("{}\n{}")
                                       << QStringLiteral("line 2: not JSON (garbage at the end of "
                                                         "the document)");
        QTest::newRow("zeros") << QByteArray(100, '\0') << QStringLiteral("line 1: not JSON (illegal value)");
        QTest::newRow("not UTF-8") << QByteArray("{\"\xff\": 1}")
                                   << QStringLiteral("line 1: not JSON (invalid UTF8 string)");
        QTest::newRow("deep") << QByteArray(200000, '[') << QStringLiteral("line 1: nested more than 12 deep");
        QTest::newRow("deep objects") << QByteArray("{\"a\":").repeated(100000)
                                      << QStringLiteral("line 1: nested more than 12 deep");
        QTest::newRow("large") << QByteArray(MaximumTableFileSize + 1, ' ')
                               << QStringLiteral("larger than 1048576 bytes");
    }

    void notEvenJson()
    {
        QFETCH(QByteArray, json);
        QFETCH(QString, message);
        QCOMPARE(errorOf(json).text, QStringLiteral("t.json: ") + message);
    }

    void aRefusedFileChangesNothing()
    {
        Catalog catalog;
        QVERIFY(catalog.add(sound().toUtf8(), QStringLiteral("t.json")));
        QString other = sound();
        other.replace(QStringLiteral("\"T-1\": {"),
            QStringLiteral("\"A-1\": { \"number\": 9, \"manual\": \"https://example.org\" }, \"T-1\": {"));
        QVERIFY(!catalog.add(other.toUtf8(), QStringLiteral("u.json")));
        QCOMPARE(catalog.models().size(), std::size_t(1));
        QVERIFY(!catalog.find(9, 5));
        const Result<void> again = catalog.add(sound().toUtf8(), QStringLiteral("elsewhere/t.json"));
        QCOMPARE(again.error().text, QStringLiteral("elsewhere/t.json: sound in itself, but there is a file of this name "
                                                    "already; give it another"));
        QVERIFY(!catalog.add(QByteArray("{\"format\":1,\"extends\":\"u\"}"), QStringLiteral("v.json")));
        QVERIFY(catalog.add(QByteArray("{\"format\":1,\"extends\":\"t\"}"), QStringLiteral("v.json")));
    }

    /// Any byte lost, changed or cut off: an error with a text or another table, never a crash.
    void anyDamageIsSurvived()
    {
        Catalog base;
        QVERIFY(base.add(resource(QStringLiteral("common.json")), QStringLiteral("common.json")));
        QVERIFY(base.add(resource(QStringLiteral("x.json")), QStringLiteral("x.json")));
        const auto survive = [&](const QByteArray &json) {
            Catalog catalog = base;
            const Result<void> added = catalog.add(json, QStringLiteral("f.json"));
            QVERIFY(added ? !catalog.models().empty() || !json.contains("\"number\"")
                          : added.error().text.startsWith(u"f.json: "));
        };
        const QByteArray json = resource(QStringLiteral("xl330.json"));
        for (qsizetype i = 0; i < json.size(); i += 3)
            survive(json.first(i));
        unsigned random = 1;
        for (int i = 0; i < 600; ++i) {
            QByteArray damaged = json;
            for (int n = 0; n <= i % 3; ++n) {
                random = random * 1664525u + 1013904223u;
                damaged[qsizetype(random >> 8) % damaged.size()] = "\"{}[],:019-.ex\n\xff"[(random >> 3) % 16];
            }
            survive(damaged);
        }
    }
};

DYNASCOPE_CORE_TEST(TestTableFile)
#include "tst_tablefile.moc"
