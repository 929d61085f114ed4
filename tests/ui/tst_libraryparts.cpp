// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/builtincatalog.h"
#include "tests/support/uitest.h"
#include "ui/library/firmwarechanges.h"
#include "ui/library/libraryreader.h"
#include "ui/library/librarytexts.h"
#include "ui/library/registermodel.h"
#include "ui/library/searchmodel.h"

#include <QAbstractItemModelTester>
#include <QSignalSpy>

using namespace Qt::StringLiterals;
using namespace dynascope;

/// What the library's window is made of: models, words, the reader.
class TestLibraryParts : public QObject
{
    Q_OBJECT

    const Catalog m_catalog = test::builtInCatalog();
    const QPalette m_palette = palette(ColorScheme::Light);

private slots:
    void modelsAreSound()
    {
        RegisterModel registers;
        const QAbstractItemModelTester first(&registers, QAbstractItemModelTester::FailureReportingMode::QtTest);
        registers.setTable(m_catalog.find(1020, 45), {m_catalog.find(1020, 45)});
        registers.setTable(nullptr, {});
        SearchModel results(m_catalog);
        const QAbstractItemModelTester second(&results, QAbstractItemModelTester::FailureReportingMode::QtTest);
        RegisterIndex index;
        index.add(*m_catalog.find(1020, 45));
        index.add(*m_catalog.find(1060, 45));
        results.setMatches(index.find(u"goal"_s));
        results.setMatches({});
    }

    /// Every register of every model can be looked at, and nothing of it is marked up by accident.
    void everyPageOfEveryModel()
    {
        for (const Catalog::ModelInfo &info : m_catalog.models()) {
            std::vector<ControlTablePtr> all;
            for (const int firmware : m_catalog.firmwareSteps(info.modelNumber))
                all.push_back(m_catalog.find(info.modelNumber, firmware));
            const QString about = modelFacts(info, *all.back(), u"/home"_s, m_palette);
            QVERIFY(about.contains(info.file));
            QString last;
            for (const Field &field : all.back()->fields()) {
                if (field.name.startsWith(u"Indirect ") || field.name.startsWith(u"SyncTable"))
                    continue; // hundreds alike
                const QString html = registerPage(field, *all.back(), all, {}, m_palette);
                QVERIFY2(html.contains(field.name) && html.contains(field.help.toHtmlEscaped()),
                         qPrintable(field.name));
                QVERIFY2(html != last, qPrintable(field.name));
                last = html;
            }
        }
    }

    void firmwareWords_data()
    {
        QTest::addColumn<int>("from");
        QTest::addColumn<int>("to");
        QTest::addColumn<QString>("text");
        QTest::newRow("any") << 0 << 255 << u"any firmware"_s;
        QTest::newRow("newer") << 45 << 255 << u"firmware 45 and newer"_s;
        QTest::newRow("older") << 0 << 44 << u"firmware 44 and older"_s;
        QTest::newRow("between") << 42 << 44 << u"firmware 42 to 44"_s;
        QTest::newRow("one") << 52 << 52 << u"firmware 52"_s;
    }

    void firmwareWords()
    {
        QFETCH(int, from);
        QFETCH(int, to);
        QTEST(firmwareText(from, to), "text");
    }

    /// The whole library is read for a search without the window standing still.
    void readingDoesNotBlock()
    {
        LibraryReader reader(m_catalog, nullptr, std::chrono::milliseconds(0)); // as on a machine that is slow
        const QSignalSpy turns(&reader, &LibraryReader::progressed);
        reader.start();
        QTRY_VERIFY(reader.isDone());
        QCOMPARE(reader.done(), int(m_catalog.models().size()));
        QCOMPARE(turns.count(), reader.total());
        QVERIFY(!reader.index().find(u"Goal Current"_s).empty());
    }
};

DYNASCOPE_UI_TEST(TestLibraryParts)
#include "tst_libraryparts.moc"
