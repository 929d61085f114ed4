// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/table/indirect.h"
#include "tests/support/builtincatalog.h"
#include "tests/support/testmain.h"

using namespace dynascope;
using namespace Qt::StringLiterals;

class TestIndirect : public QObject
{
    Q_OBJECT

private slots:
    void knowsItsRegisters_data()
    {
        QTest::addColumn<QString>("name");
        QTest::addColumn<int>("address");
        QTest::addColumn<int>("data");
        QTest::newRow("address") << "Indirect Address 1" << 1 << 0;
        QTest::newRow("last address") << "Indirect Address 256" << 256 << 0;
        QTest::newRow("data") << "Indirect Data 28" << 0 << 28;
        QTest::newRow("without a number") << "Indirect Address" << 0 << 0;
        QTest::newRow("another word") << "Indirect Address Write" << 0 << 0;
        QTest::newRow("something else") << "External Port Data 1" << 0 << 0;
    }

    void knowsItsRegisters()
    {
        QFETCH(QString, name);
        Field field;
        field.name = name;
        QTEST(indirectAddressNumber(field), "address");
        QTEST(indirectDataNumber(field), "data");
    }

    void dataBelongsToTheAddressOfItsNumber()
    {
        const ControlTablePtr table = m_catalog.find(1020, 45);
        const Field *data = table->find(u"Indirect Data 30");
        QVERIFY(data);
        QCOMPARE(table->fields()[std::size_t(indirectAddressOf(*table, *data))].name,
                 QStringLiteral("Indirect Address 30"));
        QCOMPARE(indirectAddressOf(*table, *table->find(u"Goal Position")), -1);
    }

    void understandsWhatIsTyped_data()
    {
        QTest::addColumn<QString>("text");
        QTest::addColumn<QString>("result"); // the address, or a piece of the message
        QTest::newRow("address") << "132"
                                 << "132";
        QTest::newRow("hexadecimal") << "0x84"
                                     << "132";
        QTest::newRow("no register there") << "150"
                                           << "150";
        QTest::newRow("name") << "Present Position"
                              << "132";
        QTest::newRow("as one likes") << " present_position "
                                      << "132";
        QTest::newRow("byte, as it is shown") << "Present Position, byte 2"
                                              << "134";
        QTest::newRow("byte without a comma") << "Present Position byte 2"
                                              << "134";
        QTest::newRow("offset") << "Present Position+3"
                                << "135";
        QTest::newRow("offset with spaces") << "present position + 3"
                                            << "135";
        QTest::newRow("name with a number") << "Indirect Data 2"
                                            << "225";
        QTest::newRow("beyond its bytes") << "Present Position, byte 4"
                                          << "bytes 0 to 3";
        QTest::newRow("beyond its only byte") << "LED + 1"
                                              << "only byte 0";
        QTest::newRow("no register") << "Present Weather"
                                     << "no register";
        QTest::newRow("a sign alone") << "+"
                                      << "no register";
        QTest::newRow("nothing") << ""
                                 << "no register";
    }

    void understandsWhatIsTyped()
    {
        QFETCH(QString, text);
        QFETCH(QString, result);
        const Result<std::int64_t> address = parseAddress(*m_catalog.find(1020, 45), text);
        if (address)
            QCOMPARE(QString::number(*address), result);
        else
            QVERIFY2(address.error().text.contains(result), qPrintable(address.error().text));
    }

    void everyAddressIsUnderstoodAsItIsShown()
    {
        for (const Catalog::ModelInfo &info : m_catalog.models()) {
            const ControlTablePtr table = m_catalog.find(info.modelNumber, info.newestFirmware);
            for (int address = 0; address < table->size() + 8; ++address) {
                const QString text = addressText(*table, address);
                const Result<std::int64_t> back = parseAddress(*table, text);
                QVERIFY2(back && *back == address, qPrintable(info.model + u": "_s + text));
            }
        }
    }

    void findsLongRuns_data()
    {
        QTest::addColumn<int>("model");
        QTest::addColumn<QStringList>("runs");
        QTest::newRow("XM430-W350, in two blocks")
            << 1020
            << QStringList{u"Indirect Address 1 x28"_s, u"Indirect Data 1 x28"_s, u"Indirect Address 29 x28"_s,
                           u"Indirect Data 29 x28"_s};
        QTest::newRow("XL-320 has none") << 350 << QStringList();
        QTest::newRow("PRO, four ports are few")
            << 54024 << QStringList{u"Indirect Address 1 x256"_s, u"Indirect Data 1 x256"_s};
        QTest::newRow("Y, with its history")
            << 4000
            << QStringList{u"Error Code History 1 x16"_s, u"Indirect Address 1 x128"_s, u"Indirect Data 1 x128"_s};
    }

    void findsLongRuns()
    {
        QFETCH(int, model);
        const ControlTablePtr table = m_catalog.find(model, 255);
        QVERIFY(table);
        QStringList runs;
        for (const FieldRun &run : longRuns(*table))
            runs << QStringLiteral("%1 %2 x%3").arg(run.name).arg(run.firstNumber).arg(run.count());
        QTEST(runs, "runs");
    }

private:
    const Catalog m_catalog = test::builtInCatalog();
};

DYNASCOPE_CORE_TEST(TestIndirect)
#include "tst_indirect.moc"
