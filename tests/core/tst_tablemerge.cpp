// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/table/tablemerge.h"
#include "tests/support/testmain.h"

#include <QJsonDocument>

using namespace dynascope;

namespace {

QJsonObject object(const QString &json)
{
    const QJsonDocument document = QJsonDocument::fromJson(json.toUtf8());
    if (!document.isObject())
        qFatal("%s", qPrintable(json));
    return document.object();
}

} // namespace

class TestTableMerge : public QObject
{
    Q_OBJECT

private slots:
    void merges_data()
    {
        QTest::addColumn<QString>("base");
        QTest::addColumn<QString>("changes");
        QTest::addColumn<QString>("expected"); // or what is wrong
        const auto row = [](const char *name, const char *base, const char *changes, const char *expected) {
            QTest::newRow(name) << QString::fromUtf8(base) << QString::fromUtf8(changes) << QString::fromUtf8(expected);
        };
        row("nothing", R"({"a": 1})", "{}", R"({"a": 1})");
        row("a new key", R"({"a": 1})", R"({"b": 2})", R"({"a": 1, "b": 2})");
        row("a value is replaced", R"({"a": 1})", R"({"a": "x"})", R"({"a": "x"})");
        row("a list is replaced whole", R"({"a": [1, 2]})", R"({"a": [3]})", R"({"a": [3]})");
        row("an object key by key", R"({"a": {"b": 1, "c": 2}})", R"({"a": {"c": 3, "d": 4}})",
            R"({"a": {"b": 1, "c": 3, "d": 4}})");
        row("an object replaces a value", R"({"a": 1})", R"({"a": {"b": 2}})", R"({"a": {"b": 2}})");
        row("null removes", R"({"a": {"b": 1, "c": 2}})", R"({"a": {"b": null}})", R"({"a": {"c": 2}})");
        row("null of what isn't there", R"({"a": {}})", R"({"a": {"b": null}})", "a: b is removed, but isn't there");
        row("only the first mistake", "{}", R"({"a": null, "b": null})", "a is removed, but isn't there");
        row("a new register starts from its definition",
            R"({"definitions": {"LED": {"size": 1, "access": "RW"}}})", R"({"registers": {"LED": {"address": 65}}})",
            R"({"definitions": {"LED": {"size": 1, "access": "RW"}},
                "registers": {"LED": {"size": 1, "access": "RW", "address": 65}}})");
        row("a definition of the same file", "{}",
            R"({"definitions": {"LED": {"size": 1}}, "registers": {"LED": {"address": 65}}})",
            R"({"definitions": {"LED": {"size": 1}}, "registers": {"LED": {"size": 1, "address": 65}}})");
        row("one that is there doesn't",
            R"({"definitions": {"LED": {"size": 1}}, "registers": {"LED": {"address": 65}}})",
            R"({"registers": {"LED": {"address": 66}}})",
            R"({"definitions": {"LED": {"size": 1}}, "registers": {"LED": {"address": 66}}})");
        row("a register is named without its section", R"({"registers": {"LED": {"size": 1}}})",
            R"({"registers": {"LED": {"unit": null}}})", "LED: unit is removed, but isn't there");
    }

    void merges()
    {
        QFETCH(QString, base);
        QFETCH(QString, changes);
        QFETCH(QString, expected);
        TableFault fault;
        const QJsonObject result = merged(object(base), object(changes), {}, &fault);
        if (expected.startsWith(u'{'))
            QCOMPARE(result, object(expected));
        QCOMPARE(fault.text, expected.startsWith(u'{') ? QString() : expected);
    }

    void knowsItsKeys_data()
    {
        QTest::addColumn<QString>("file");
        QTest::addColumn<QString>("wrong");
        const auto row = [](const char *file, const char *wrong) {
            QTest::newRow(file) << QString::fromUtf8(file) << QString::fromUtf8(wrong);
        };
        row(R"({"format": 1, "series": "X", "registers": {"LED": {"address": 65, "size": 1}}})", "");
        row(R"({"registers": {"LED": null}})", "");
        row(R"({"colour": 1})", "unknown key \"colour\"");
        row(R"({"registers": []})", "\"registers\" must be an object");
        row(R"({"registers": {"LED": 7}})", "\"LED\" must be an object");
        row(R"({"registers": {"LED": {"addres": 65}}})", "LED: unknown key \"addres\"");
        row(R"({"definitions": {"LED": {"bits": {"On": {"bid": 1}}}}})", "LED: On: unknown key \"bid\"");
        row(R"({"registers": {"LED": {"alternates": {}}}})", "LED: \"alternates\" must be a list");
        row(R"({"registers": {"LED": {"alternates": [1]}}})", "LED: \"alternates\" must be a list of objects");
        row(R"({"models": {"T-1": {"format": 1}}})", "T-1: unknown key \"format\"");
        row(R"({"models": {"T-1": {"indirect": [{"blocks": [{"adress": 1}]}]}}})",
            "T-1: indirect: unknown key \"adress\"");
        row(R"({"colour": 1, "registers": {"LED": {"addres": 65}}})", "unknown key \"colour\"");
    }

    void knowsItsKeys()
    {
        QFETCH(QString, file);
        QTEST(wrongKeys(object(file)).text, "wrong");
    }
};

DYNASCOPE_CORE_TEST(TestTableMerge)
#include "tst_tablemerge.moc"
