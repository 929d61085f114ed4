// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/table/jsonguard.h"
#include "tests/support/testmain.h"

using namespace dynascope;

namespace {

QString outcome(const QByteArray &json)
{
    const Result<QJsonObject> read = readJsonObject(json, QStringLiteral("t"));
    return read ? QStringLiteral("%1 keys").arg(read->size()) : read.error().text;
}

QByteArray nested(int depth, char open, char close)
{
    return "{\"a\":" + QByteArray(depth - 1, open) + QByteArray(depth - 1, close) + '}';
}

} // namespace

class TestJsonGuard : public QObject
{
    Q_OBJECT

private slots:
    void reads_data()
    {
        QTest::addColumn<QByteArray>("json");
        QTest::addColumn<QString>("says");
        const auto row = [](const char *name, const QByteArray &json, const char *says) {
            QTest::newRow(name) << json << QString::fromUtf8(says);
        };
        row("empty object", "{}", "0 keys");
        row("two keys", R"({"a": 1, "b": 2})", "2 keys");
        row("the same key in different objects", R"({"a": {"c": 1}, "b": {"c": 2}})", "2 keys");
        row("the same key in a list's objects", R"({"a": [{"c": 1}, {"c": 2}], "b": 1})", "2 keys");
        row("a key as a value", R"({"a": "b", "b": "a"})", "2 keys");
        row("brackets and quotes in a string", "{\"a\": \"}],{[\\\"\", \"b\": \":\"}", "2 keys");
        row("the same key twice", R"({"a": 1, "a": 2})", "t: line 1: \"a\" stands twice");
        row("twice, on its line", "{\n\"a\": 1,\n\"a\": 2}", "t: line 3: \"a\" stands twice");
        row("twice, behind a nested object", R"({"a": {"b": [1, 2]}, "a": 2})", "t: line 1: \"a\" stands twice");
        row("twice, deep", R"({"a": [{"b": {"c": 1, "c": 2}}]})", "t: line 1: \"c\" stands twice");
        row("twice, one written with an escape", "{\"a\": 1, \"\\u0061\": 2}", "t: line 1: a key with an escape in it");
        row("longest key", "{\"" + QByteArray(128, 'k') + "\": 1}", "1 keys");
        row("a key too long", "{\"" + QByteArray(129, 'k') + "\": 1}", "t: line 1: a key longer than 128 bytes");
        row("a list", "[1]", "t: not a JSON object");
        row("nothing", "", "t: line 1: not JSON (illegal value)");
        row("deepest", nested(MaximumTableFileDepth, '[', ']'), "1 keys");
        row("too deep", nested(MaximumTableFileDepth + 1, '[', ']'), "t: line 1: nested more than 12 deep");
    }

    void reads()
    {
        QFETCH(QByteArray, json);
        QFETCH(QString, says);
        QCOMPARE(outcome(json), says);
    }

    void isBoundedInSize()
    {
        QByteArray json = "{\"a\": 1}";
        json += QByteArray(MaximumTableFileSize - json.size(), ' ');
        QCOMPARE(outcome(json), QStringLiteral("1 keys"));
        QCOMPARE(outcome(json + ' '), QStringLiteral("t: larger than %1 bytes").arg(MaximumTableFileSize));
    }

    /// Whatever is cut off is refused by somebody, and nobody reads past its end.
    void anyPrefixIsRefused()
    {
        const QByteArray json = "{\"a\": [{\"b\": \"x\\\"y\"}, 1.5e3, null], \"c\": {\"d\": \"\\\\\"}}";
        QCOMPARE(outcome(json), QStringLiteral("2 keys"));
        for (qsizetype length = 0; length < json.size(); ++length)
            QVERIFY2(!readJsonObject(json.first(length), QStringLiteral("t")), json.first(length).constData());
    }
};

DYNASCOPE_CORE_TEST(TestJsonGuard)
#include "tst_jsonguard.moc"
