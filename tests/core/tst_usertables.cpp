// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/table/usertables.h"
#include "core/table/jsonguard.h"
#include "tests/support/builtincatalog.h"
#include "tests/support/testmain.h"

#include <QFile>
#include <QTemporaryDir>

#include <memory>

using namespace dynascope;
using namespace dynascope::test;

namespace {

/// A table of one register.
QByteArray model(const QByteArray &name, int number, const QByteArray &more = {})
{
    return "{\n  \"format\": 2, \"series\": \"Own\",\n  \"registers\": {\n"
           "    \"Mine\": { \"address\": 5, \"size\": 1, \"area\": \"RAM\", \"access\": \"RW\" }\n  },\n"
           "  \"models\": {\n    \""
           + name + "\": { \"number\": " + QByteArray::number(number) + more + " }\n  }\n}\n";
}

} // namespace

class TestUserTables : public QObject
{
    Q_OBJECT

    std::unique_ptr<QTemporaryDir> m_folder; ///< of this test function

    void write(const QString &name, const QByteArray &bytes)
    {
        QFile file(m_folder->filePath(name));
        QVERIFY(file.open(QIODevice::WriteOnly));
        file.write(bytes);
    }

private slots:
    void init()
    {
        m_folder = std::make_unique<QTemporaryDir>();
        QVERIFY(m_folder->isValid());
    }

    void whereTheyAre()
    {
        qputenv("DYNASCOPE_TABLES", "/some/where");
        QCOMPARE(userTablesFolder(), QStringLiteral("/some/where"));
        qunsetenv("DYNASCOPE_TABLES");
        QVERIFY(userTablesFolder().endsWith(u"/dynascope/controltables"));
    }

    void aFolderThatIsNotThere()
    {
        Catalog catalog = builtInCatalog();
        const UserTables tables = addUserTables(catalog, QStringLiteral("/nowhere/at/all"));
        QVERIFY(tables.added.isEmpty() && tables.refused.empty());
    }

    /// In any order of names; upon each other and upon those of the program.
    void filesExtendEachOther()
    {
        write(QStringLiteral("a.json"), "{\"format\":2,\"extends\":\"b\",\"models\":{\"Own A\":{\"number\":9001}}}");
        write(QStringLiteral("b.json"), "{\"format\":2,\"extends\":\"x330\",\"models\":{\"Own B\":{\"number\":9002}}}");
        Catalog catalog = builtInCatalog();
        const UserTables tables = addUserTables(catalog, m_folder->path());
        QCOMPARE(tables.added, (QStringList{QStringLiteral("b.json"), QStringLiteral("a.json")}));
        QVERIFY(tables.refused.empty());
        QCOMPARE(int(catalog.find(9001, 53)->find(u"Goal Position")->address), 116);
        QVERIFY(!catalog.model(9001)->isBuiltIn && catalog.model(9001)->file == u"a");
    }

    void oneBadFileKeepsNoOtherOut()
    {
        write(QStringLiteral("a.json"), "{ \"format\": 2,\n  \"what\": 1 }");
        write(QStringLiteral("b.json"), model("Own", 9001));
        write(QStringLiteral("c.json"), "{\"format\":2,\"extends\":\"d\"}");
        write(QStringLiteral("d.json"), "{\"format\":2,\"extends\":\"c\"}");
        write(QStringLiteral("e.json"), QByteArray(MaximumTableFileSize + 1, ' '));
        write(QStringLiteral("notes.txt"), "not a table");
        Catalog catalog = builtInCatalog();
        const UserTables tables = addUserTables(catalog, m_folder->path());
        QCOMPARE(tables.added, QStringList{QStringLiteral("b.json")});
        QStringList said;
        for (const Error &error : tables.refused)
            said.append(error.text.mid(error.text.lastIndexOf(u'/') + 1));
        said.sort();
        QCOMPARE(said, (QStringList{QStringLiteral("a.json: line 2: unknown key \"what\""),
                                    QStringLiteral("c.json: line 1: extends \"d\", which is not there"),
                                    QStringLiteral("d.json: line 1: extends \"c\", which is not there"),
                                    QStringLiteral("e.json: larger than 1048576 bytes")}));
        QVERIFY(catalog.find(9001, 0));
    }

    /// A model of the program is not taken over in silence.
    void shadowing_data()
    {
        QTest::addColumn<QByteArray>("file");
        QTest::addColumn<QString>("message"); // empty: accepted
        const QString taken =
            QStringLiteral("line 7: %1: this name or the number %2 is taken by XM430-W350; \"replaces\": "
                           "%2 takes its place");
        const QString wrong =
            QStringLiteral("line 7: %1: \"replaces\" must be the number of this model and of one that is there");
        QTest::newRow("its number") << model("Own", 1020) << taken.arg(QStringLiteral("Own")).arg(1020);
        QTest::newRow("its name")
            << model("xm430 w350", 9001)
            << QStringLiteral("line 7: xm430 w350: this name is taken by XM430-W350 (number 1020); give another name");
        QTest::newRow("its number in Modbus mode")
            << model("Own", 4001)
            << QStringLiteral(
                   "line 7: Own: this name or the number 4001 is taken by YM070-210-M001-RH; \"replaces\": 4001 "
                   "takes its place");
        QTest::newRow("on purpose") << model("Own", 1020, ", \"replaces\": 1020") << QString();
        QTest::newRow("with the same name") << model("XM430-W350", 1020, ", \"replaces\": 1020") << QString();
        QTest::newRow("another's") << model("Own", 9001, ", \"replaces\": 1020") << wrong.arg(QStringLiteral("Own"));
        QTest::newRow("nobody's") << model("Own", 9001, ", \"replaces\": 9001") << wrong.arg(QStringLiteral("Own"));
        QTest::newRow("its number, another's name")
            << model("XM430-W210", 1020, ", \"replaces\": 1020")
            << QStringLiteral("line 7: XM430-W210: this name is taken by XM430-W210 (number 1030); give another name");
    }

    void shadowing()
    {
        QFETCH(QByteArray, file);
        QFETCH(QString, message);
        write(QStringLiteral("own.json"), file);
        Catalog catalog = builtInCatalog();
        const std::size_t before = catalog.models().size();
        const UserTables tables = addUserTables(catalog, m_folder->path());
        QCOMPARE(catalog.models().size(), before);
        if (message.isEmpty()) {
            QVERIFY2(tables.refused.empty(), tables.refused.empty() ? "" : qPrintable(tables.refused.front().text));
            QVERIFY(catalog.find(1020, 45)->find(u"Mine") && !catalog.model(1020)->isBuiltIn);
            return;
        }
        QCOMPARE(tables.refused.size(), std::size_t(1));
        QCOMPARE(tables.refused.front().text, m_folder->filePath(QStringLiteral("own.json: ")) + message);
        QVERIFY(catalog.find(1020, 45)->find(u"Torque Enable"));
    }

    void manyFiles()
    {
        for (int i = 0; i < 201; ++i)
            write(QStringLiteral("f%1.json").arg(i), "{\"format\":2}");
        Catalog catalog = builtInCatalog();
        const UserTables tables = addUserTables(catalog, m_folder->path());
        QCOMPARE(tables.added.size(), 200);
        QCOMPARE(tables.refused.size(), std::size_t(1));
        QVERIFY(tables.refused.front().text.endsWith(u"more than 200 files; only the first are read"));
    }
};

DYNASCOPE_CORE_TEST(TestUserTables)
#include "tst_usertables.moc"
