// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/yaml/yamltree.h"
#include "tests/support/testmain.h"

using namespace dynascope;
using namespace Qt::StringLiterals;

/// Where a scalar stands in the text, so that it can be replaced there; what is refused is in tst_busplan.
class TestYamlTree : public QObject
{
    Q_OBJECT

private slots:
    void scalars_data()
    {
        QTest::addColumn<QByteArray>("yaml");
        QTest::addColumn<QByteArray>("part"); ///< of the text
        QTest::addColumn<QString>("text");
        QTest::addColumn<YamlNode::Style>("style");
        const auto row = [](const char *name, const QByteArray &yaml, const QByteArray &part, const QString &text,
                            YamlNode::Style style) { QTest::newRow(name) << yaml << part << text << style; };
        using Style = YamlNode::Style;
        row("plain", "k: 180 deg  # why\n", "180 deg", u"180 deg"_s, Style::Plain);
        row("at the end", "k: 7", "7", u"7"_s, Style::Plain);
        row("single", "k: 'it''s' # x", "'it''s'", u"it's"_s, Style::Single);
        row("double", "k: \"a \\\"b\\\\\" # x", "\"a \\\"b\\\\\"", u"a \"b\\"_s, Style::Double);
        row("double over two lines", "k: \"a\n  b\"\n", "\"a\n  b\"", u"a b"_s, Style::Double);
        row("not ASCII before", "j: µm ° # é\nk: 90 °\n", "90 °", u"90 °"_s, Style::Plain);
        row("byte order mark", "\xEF\xBB\xBFk: 7\n", "7", u"7"_s, Style::Plain);
        row("carriage returns", "j: 1\r\nk: 8 # b\r\n", "8", u"8"_s, Style::Plain);
        row("in brackets", "{ j: 1, k: 8 }", "8", u"8"_s, Style::Plain);
        row("block", "k: |\n  8\n", "", u"8\n"_s, Style::Spread);
        row("plain over two lines", "k: 8\n  deg\n", "", u"8 deg"_s, Style::Spread);
        row("behind a tab", "k:\t8\n", "8", u"8"_s, Style::Plain);
    }
    void scalars()
    {
        QFETCH(QByteArray, yaml);
        const auto root = readYaml(yaml, QStringLiteral("f"));
        QVERIFY2(root, root ? "" : qPrintable(root.error().text));
        const YamlNode *node = root->find(u"k");
        QVERIFY(node);
        QTEST(node->text, "text");
        QTEST(node->style, "style");
        if (node->style != YamlNode::Style::Spread)
            QTEST(yaml.mid(node->begin, node->end - node->begin), "part");
    }

    void collections()
    {
        const QByteArray yaml = "a:\n  - b: 1\n    c: { d: 2 }\n";
        const auto root = readYaml(yaml, QStringLiteral("f"));
        QVERIFY(root && !root->isFlow);
        const YamlNode &entry = root->find(u"a")->children.front();
        QVERIFY(!entry.isFlow);
        const YamlNode *flow = entry.find(u"c");
        QVERIFY(flow->isFlow);
        QCOMPARE(yaml[flow->begin], '{');
        QCOMPARE(yaml[entry.begin], 'b');
    }
};

DYNASCOPE_CORE_TEST(TestYamlTree)
#include "tst_yamltree.moc"
