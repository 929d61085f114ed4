// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/table/catalog.h"
#include "core/table/jsonguard.h"
#include "core/table/tableimport.h"
#include "core/table/units.h"
#include "tests/support/builtincatalog.h"
#include "tests/support/tablefacts.h"
#include "tests/support/testmain.h"

using namespace dynascope;
using namespace dynascope::test;

namespace {

const QByteArray Model = "[type info]\n"
                         "name\tvalue\n"
                         "value_of_zero_radian_position\t2048\n"
                         "value_of_max_radian_position\t4095\n"
                         "value_of_min_radian_position\t0\n"
                         "min_radian\t-3.14159265\n"
                         "max_radian\t3.14159265\n"
                         "\n"
                         "[unit info]\n"
                         "Data Name\tvalue\tunit\tSign Type\n"
                         "Present Velocity\t0.0239691227\trad/s\tsigned\n"
                         "Present Current\t0.001\tN/m\tsigned\n"
                         "Profile Time\t0.001\ts\tunsigned\n"
                         "\n"
                         "[control table]\n"
                         "Address\tSize\tData Name\n"
                         "0\t2\tModel Number\n"
                         "7\t1\tID\n"
                         "112\t4\tProfile Velocity\n"
                         "112\t4\tProfile Time\n"
                         "126\t2\tPresent Current\n"
                         "128\t4\tPresent Velocity\n"
                         "132\t4\tPresent Position\n";

const QByteArray Csv = "address,size,name,area,access,initial,min,max,unit,scale,signed\n"
                       "0,2,Model Number,EEPROM,R,1999,,,,,0\n"
                       "38,2,Current Limit,EEPROM,RW,100,0,1193,mA,2.69,0\n"
                       "102,2,Goal Current,HYBRID,RW,,-Current Limit,Current Limit,mA,2.69,1\n"
                       "108,4,Profile Acceleration,RAM,RW,0,0,32767,rev/min^2,214.577,0\n";

ControlTablePtr tableOf(const ImportedTable &imported)
{
    Catalog catalog;
    if (const auto added = catalog.add(imported.json, QStringLiteral("own.json")); !added)
        qFatal("%s", qPrintable(added.error().text));
    return catalog.find(catalog.models().front().modelNumber, 0);
}

QString wrong(const QByteArray &text, const ImportOptions &options)
{
    const auto imported = importTable(text, QStringLiteral("f"), options);
    return imported ? QStringLiteral("accepted") : imported.error().text;
}

QByteArray replaced(QByteArray text, const QByteArray &from, const QByteArray &to)
{
    Q_ASSERT(text.contains(from));
    return text.replace(text.indexOf(from), from.size(), to);
}

} // namespace

class TestTableImport : public QObject
{
    Q_OBJECT

private slots:
    void aModelFile()
    {
        const auto imported = importTable(Model, QStringLiteral("xq_1.model"), {{}, 1999});
        QVERIFY2(imported, imported ? "" : qPrintable(imported.error().text));
        const ControlTablePtr table = tableOf(*imported);
        QCOMPARE(table->model(), QStringLiteral("XQ-1"));
        QCOMPARE(table->modelNumber(), std::uint16_t(1999));
        QCOMPARE(table->resolution(), 4096);
        QCOMPARE(table->fields().size(), std::size_t(6));
        const Field *velocity = table->find(u"Present Velocity");
        QVERIFY(velocity->isSigned && velocity->unit == Unit::RevPerMin && qAbs(velocity->scale - 0.229) < 0.001);
        // What the file doesn't say nobody guesses: the program won't write such a register by itself.
        QVERIFY(velocity->area == Area::Unknown && velocity->mayBeTried() && !velocity->isWritable());
        QVERIFY(table->find(u"Present Current")->unit == Unit::None);
        // X has no row for the unit of its positions: what they are [type info] says.
        const Field *position = table->find(u"Present Position");
        QVERIFY(position->isSigned && position->unit == Unit::Pulse);
        QVERIFY(!table->description().doubt.isEmpty());
        QCOMPARE(imported->notes.size(), 3);
        QCOMPARE(imported->notes[0],
                 QStringLiteral("xq_1.model: line 20: Profile Time is left out: it lies where Profile Velocity is"));
        QCOMPARE(imported->notes[2],
                 QStringLiteral("xq_1.model: line 13: the unit of Profile Time is left out, as the register is: "
                                "see line 20"));
    }

    void aCsv()
    {
        const auto imported = importTable(Csv, QStringLiteral("xq_1.csv"), {});
        QVERIFY2(imported, imported ? "" : qPrintable(imported.error().text));
        const ControlTablePtr table = tableOf(*imported);
        QCOMPARE(table->modelNumber(), std::uint16_t(1999));
        const Field *goal = table->find(u"Goal Current");
        QVERIFY(goal->area == Area::Hybrid && goal->isSigned && goal->minimum.negated && goal->scale == 2.69);
        QVERIFY(table->find(u"Profile Acceleration")->unit == Unit::RevPerMin2);
        QCOMPARE(imported->notes, QStringList());
    }

    void signedInWords()
    {
        const auto imported = importTable(replaced(Csv, "2.69,1", "2.69,Yes"), QStringLiteral("xq_1.csv"), {});
        QVERIFY(imported && tableOf(*imported)->find(u"Goal Current")->isSigned);
    }

    /// Every complete table of the library, written as CSV and read again, is the same.
    void everyTableAndBack()
    {
        const Catalog catalog = builtInCatalog();
        static const QStringList columns =
            QStringLiteral("address,size,name,area,access,initial,min,max,unit,scale,signed").split(u',');
        for (const Catalog::ModelInfo &info : catalog.models()) {
            if (info.addressesOnly)
                continue;
            const ControlTablePtr table = catalog.find(info.modelNumber, 255);
            QStringList lines{columns.join(u',')};
            for (const Field &field : table->fields()) {
                QStringList cells;
                for (const QString &column : columns)
                    cells.append(factsOf(field)[column]);
                lines.append(cells.join(u','));
            }
            const auto imported = importTable(lines.join(u'\n').toUtf8(), QStringLiteral("t.csv"), {info.model, -1});
            QVERIFY2(imported, imported ? "" : qPrintable(info.model + imported.error().text));
            const ControlTablePtr again = tableOf(*imported);
            QCOMPARE(again->modelNumber(), info.modelNumber);
            QCOMPARE(again->fields().size(), table->fields().size());
            for (std::size_t i = 0; i < table->fields().size(); ++i)
                QCOMPARE(factsOf(again->fields()[i]), factsOf(table->fields()[i]));
        }
    }

    void notes_data()
    {
        QTest::addColumn<QByteArray>("text");
        QTest::addColumn<QString>("note");
        const QByteArray row = "Profile Time\t0.001\ts\tunsigned\n";
        QTest::newRow("another resolution")
            << replaced(Model, row, "Present Position\t0.0007669904\trad\tsigned\n")
            << QStringLiteral(
                   "line 13: Present Position stays a bare number: it has 8192 steps a turn, the others 4096");
        QTest::newRow("negative scale")
            << replaced(Model, "0.0239691227", "-0.0239691227")
            << QStringLiteral("line 11: Present Velocity stays a bare number: its scale isn't above 0");
        QTest::newRow("negative angle")
            << replaced(Model, row, "Present Position\t-0.0015\trad\tsigned\n")
            << QStringLiteral("line 13: Present Position stays a bare number: its scale isn't above 0");
        QTest::newRow("no such register")
            << replaced(Model, "Profile Time\t0.001", "Profile Tide\t0.001")
            << QStringLiteral("line 13: the unit of Profile Tide is left out: no such register follows");
        QTest::newRow("half a range")
            << replaced(Csv, ",100,0,1193", ",100,,1193")
            << QStringLiteral("line 3: the range of Current Limit is left out: min and max must both be there");
        QTest::newRow("scale of nothing")
            << replaced(Csv, "1193,mA,", "1193,,")
            << QStringLiteral("line 3: the scale of Current Limit is left out: it has no unit");
    }

    /// Nothing is left out in silence.
    void notes()
    {
        QFETCH(QByteArray, text);
        QFETCH(QString, note);
        const auto imported = importTable(text, QStringLiteral("f"), {{}, 1999});
        QVERIFY2(imported, imported ? "" : qPrintable(imported.error().text));
        QVERIFY2(imported->notes.contains(QStringLiteral("f: ") + note), qPrintable(imported->notes.join(u'\n')));
    }

    void readers_data()
    {
        QTest::addColumn<QByteArray>("text");
        QTest::addColumn<QString>("file");
        QTest::addColumn<QString>("message"); // empty: accepted
        const QByteArray mark = "\xEF\xBB\xBF";
        QTest::newRow("model with a byte order mark") << mark + Model << QStringLiteral("f") << QString();
        QTest::newRow("CSV with a byte order mark") << mark + Csv << QStringLiteral("f") << QString();
        QTest::newRow("model behind a remark") << "# mine\n" + Model << QStringLiteral("f.MODEL") << QString();
        QTest::newRow("CSV behind a remark") << "# mine\n" + Csv << QStringLiteral("f.csv") << QString();
        QTest::newRow("no model at all")
            << QByteArray("\x7f"
                          "ELF")
            << QStringLiteral("f.model")
            << QStringLiteral("f.model: line 1: not within [type info], [unit info] or [control table]");
    }

    void readers()
    {
        QFETCH(QByteArray, text);
        QFETCH(QString, file);
        const auto imported = importTable(text, file, {{}, 1999});
        QTEST(imported ? QString() : imported.error().text, "message");
    }

    void whatCannotBe_data()
    {
        QTest::addColumn<QByteArray>("text");
        QTest::addColumn<QString>("message");
        const auto model = [](const char *from, const char *to, const char *message) {
            QTest::addRow("%s", message) << replaced(Model, from, to)
                                         << QStringLiteral("f: ") + QString::fromUtf8(message);
        };
        const auto csv = [](const char *from, const char *to, const char *message) {
            QTest::addRow("%s", message) << replaced(Csv, from, to)
                                         << QStringLiteral("f: ") + QString::fromUtf8(message);
        };
        model("7\t1\tID", "7\t1", "line 18: needs address, size and name, with tabs between");
        model("Profile Time\t0.001\ts", "Profile Time 0.001 s",
              "line 13: needs name, value and unit, with tabs between");
        model("s\tunsigned", "s\tsinged", "line 13: the sign type is \"singed\"; it must be signed or unsigned");
        csv("2.69,1", "2.69,maybe", "line 4: Goal Current: \"maybe\" is neither 1 nor 0, which signed must be");
        csv("2.69", "abc", "line 3: Current Limit: the scale is \"abc\"; it must be a number from 1e-9 to 1e9");
        model("7\t1\tID", "x\t1\tID", "line 18: the address is \"x\"; it must be a number from 0 to 65535");
        model("7\t1\tID", "7\t3\tID", "line 18: ID: the size must be 1, 2 or 4");
        model("7\t1\tID", "7\t1\tModel-Number", "line 18: Model-Number: stands twice");
        model("7\t1\tID", "7\t1\tI\"D", "line 18: \"I\"D\" is not a name for a register");
        model("7\t1\tID", "65535\t2\tID", "line 18: OWN: ID: \"address\" must be a number from 0 to 65534");
        model("0.0239691227", "fast", "line 11: \"fast\" is no number");
        model("[type info]\nname\tvalue\n", "[type info]\nname value\nvalue_of_zero_radian_position 2048\n",
              "line 3: needs name and value, with a tab between");
        model("[control table]", "[table]", "line 17: not within [type info], [unit info] or [control table]");
        csv("address,", "place,",
            "line 1: the first line must name the columns: address, size, name and any of area, "
            "access, initial, min, max, unit, scale, signed");
        csv("38,2,", "1,2,", "line 3: Current Limit: overlaps Model Number");
        csv("HYBRID", "ROM", "line 4: Goal Current: \"ROM\" is neither EEPROM, RAM nor HYBRID");
        csv(",RW,100", ",W,100", "line 3: Current Limit: \"W\" is neither R nor RW");
        csv("1999", "x", "line 2: the initial value is \"x\"; it must be a number from -4294967295 to 4294967295");
        csv("1999", "", "the number of the model isn't in it: give --number");
        csv(",100,0,1193", ",100,0,-", "line 3: \"-\" is neither a number nor a register");
        csv("-Current Limit", "-Torque Limit",
            "line 4: F: Goal Current: limited by Torque Limit, which is no other register");
        csv(",100,0,1193", ",100,0,50", "line 3: F: Current Limit: initial value 100 lies outside the range");
        QTest::newRow("nothing") << QByteArray() << QStringLiteral("f: there is no register in it");
        QTest::newRow("header alone") << QByteArray("address,size,name\n")
                                      << QStringLiteral("f: there is no register in it");
        QTest::newRow("large") << QByteArray(MaximumTableFileSize + 1, 'x')
                               << QStringLiteral("f: larger than 1048576 bytes");
        QTest::newRow("long") << QByteArray("address,size,name\n") + QByteArray("0,1,A\n").repeated(3000)
                              << QStringLiteral("f: line 2001: more than 2000 lines");
    }

    void whatCannotBe()
    {
        QFETCH(QByteArray, text);
        const bool isModel = text.startsWith('[');
        QTEST(wrong(text, isModel ? ImportOptions{QStringLiteral("OWN"), 1999} : ImportOptions{}), "message");
    }
};

DYNASCOPE_CORE_TEST(TestTableImport)
#include "tst_tableimport.moc"
