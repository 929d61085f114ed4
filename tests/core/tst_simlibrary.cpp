// SPDX-License-Identifier: GPL-3.0-or-later
// Every model of the library, simulated: found by a scan, read whole, one register of each kind written and read back.
// In virtual time; integration_dxlsimlibrary does the same over a terminal.
#include "core/bus/scan.h"
#include "core/table/catalog.h"
#include "tests/support/builtincatalog.h"
#include "tests/support/modelwalk.h"
#include "tests/support/sessionfixture.h"
#include "tests/support/testmain.h"

using namespace dynascope;
using namespace dynascope::test;

class TestSimLibrary : public QObject
{
    Q_OBJECT

    const Catalog m_catalog = builtInCatalog();

private slots:
    void everyModel_data()
    {
        QTest::addColumn<QString>("model");
        for (const Catalog::ModelInfo &info : m_catalog.models()) {
            if (!info.addressesOnly)
                QTest::addRow("%s", qPrintable(info.model)) << info.model;
        }
    }

    void everyModel()
    {
        QFETCH(QString, model);
        const Catalog::ModelInfo &info = *m_catalog.model(QStringView(model));
        const ControlTablePtr table = m_catalog.find(info.modelNumber, info.newestFirmware);
        VirtualBus virtualBus(m_catalog,
                              model + (table->axes() == 2 ? QStringLiteral("@57600:1+2") : QStringLiteral("@57600:1")));
        const auto found = scanBaud(*virtualBus.bus, {}, {});
        QVERIFY2(found, found ? "" : qPrintable(found.error().text));
        QCOMPARE(found->devices.size(), std::size_t(table->axes()));
        QCOMPARE(found->devices.front().modelNumber, info.modelNumber);
        QCOMPARE(int(found->devices.front().firmware), info.newestFirmware);
        Result<Bytes> whole = readWhole(*virtualBus.bus, 1, *table);
        QVERIFY2(whole, whole ? "" : qPrintable(whole.error().text));
        const std::vector<const Field *> fields = oneOfEachKind(*table);
        QVERIFY(fields.size() > 3);
        for (const Field *field : fields) {
            const Result<void> written = writeAndReadBack(*virtualBus.bus, 1, *table, *field, *whole);
            QVERIFY2(written, written ? "" : qPrintable(written.error().text));
        }
    }
};

DYNASCOPE_CORE_TEST(TestSimLibrary)
#include "tst_simlibrary.moc"
