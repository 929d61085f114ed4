// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/scanner.h"
#include "core/session/volatilespan.h"
#include "tests/support/builtincatalog.h"
#include "tests/support/sessionfixture.h"
#include "tests/support/testmain.h"

#include <QSemaphore>
#include <QSignalSpy>

using namespace dynascope;

/// The scan as the window starts it, in virtual time.
class TestScanner : public QObject
{
    Q_OBJECT

    const Catalog m_catalog = test::builtInCatalog();

private slots:
    void aDoubtfulDeviceIsCountedOnce_data()
    {
        QTest::addColumn<QString>("servos");
        QTest::newRow("two alike") << "XM430-W350@57600:1,XM430-W350@57600:1,XM430-W350@57600:2";
        QTest::newRow("two models") << "XM430-W350@57600:1,XL330-M288@57600:1,XM430-W350@57600:2";
    }

    void aDoubtfulDeviceIsCountedOnce()
    {
        QFETCH(QString, servos);
        VirtualSession world(m_catalog, servos);
        world.line = &world.session.open(QStringLiteral("virtual"), 57600);
        Scanner scanner;
        QSignalSpy finished(&scanner, &Scanner::finished);
        scanner.start(*world.line, {{57600, 1000000}, 0, 20, false});
        QTRY_COMPARE(finished.count(), 1);
        QCOMPARE(finished.front().front().toInt(), 2);
        QCOMPARE(scanner.found(), 2);
        const Device *shared = world.line->deviceAt(1, 57600);
        QVERIFY(shared);
        QVERIFY2(shared->doubt().contains(QStringLiteral("share ID 1")), qPrintable(shared->doubt()));
        const Device *healthy = world.line->deviceAt(2, 57600);
        QVERIFY(healthy);
        QCOMPARE(healthy->doubt(), QString());
        world.close();
    }

    /// That one of them answered a Ping says nothing of the other.
    void aPingLeavesTheDoubt()
    {
        VirtualSession world(m_catalog, QStringLiteral("XM430-W350@57600:1,XM430-W350@57600:1"));
        world.open(57600);
        Found doubted = world.line->devices().front()->found();
        doubted.doubt = QStringLiteral("two of them");
        Device &device = world.line->heard(doubted);
        std::optional<Result<void>> outcome;
        world.commands.ping(device, [&](const Result<void> &result) { outcome = result; });
        QTRY_VERIFY(outcome);
        QVERIFY(*outcome);
        QCOMPARE(device.doubt(), QStringLiteral("two of them"));
        world.close();
    }

    /// A write that is asked for during a sweep goes out before the next Ping but one.
    void aWriteWaitsForOnePingOfASweep()
    {
        VirtualSession world(m_catalog, QStringLiteral("XM430-W350@57600:1,XM430-W350@57600:2"));
        constexpr int At = 50;
        QSemaphore isUnderWay, isQueued;
        std::vector<std::uint8_t> instructions;
        world.factory.onPacket = [&](int count, ByteView packet) {
            instructions.push_back(packet[7]);
            if (count != At)
                return;
            isUnderWay.release();
            isQueued.acquire();
        };
        world.open(57600);
        Scanner scanner;
        QSignalSpy finished(&scanner, &Scanner::finished);
        QSignalSpy progress(&scanner, &Scanner::progressChanged);
        scanner.start(*world.line, {{57600}, 0, 252, true});
        QVERIFY(isUnderWay.tryAcquire(1, 10'000));
        Device &device = *world.line->deviceAt(2, 57600);
        std::optional<Result<void>> outcome;
        world.commands.writeField(device, device.table().indexOf(u"LED"), 1,
                                  [&](const Result<void> &result) { outcome = result; });
        isQueued.release();
        QTRY_VERIFY(outcome);
        QVERIFY2(*outcome, qPrintable(outcome->error().text));
        QTRY_COMPARE(finished.count(), 1);
        world.close();
        const auto written = std::ranges::find(instructions, std::uint8_t(0x03));
        QCOMPARE(written - instructions.begin(), At); // packets 1 to At were Pings
        QVERIFY(progress.count() > 50); // and it says how far it is
    }

    void volatileSpans_data()
    {
        QTest::addColumn<QString>("model");
        QTest::addColumn<int>("address");
        QTest::addColumn<int>("length");
        for (const char *model : {"XM430-W350", "XL430-W250", "XL330-M288"})
            QTest::newRow(model) << QString::fromLatin1(model) << 120 << 27; // to Present Temperature
    }

    void volatileSpans()
    {
        QFETCH(QString, model);
        const Catalog::ModelInfo *info = m_catalog.model(QStringView(model));
        QVERIFY(info);
        const auto span = volatileSpanOf(*m_catalog.find(info->modelNumber, info->newestFirmware));
        QVERIFY(span);
        QTEST(int(span->address), "address");
        QTEST(int(span->length), "length");
        QCOMPARE(span->tickAt, 0);
        QCOMPARE(span->steady.size(), std::size_t(2));
        QCOMPARE(span->steady.front().at, 12);
        QCOMPARE(span->steady.front().size, 4);
    }

    void nothingVolatileIsKnownOfAnUnknownModel()
    {
        QVERIFY(!volatileSpanOf(ControlTable(ControlTable::Description())));
    }
};

DYNASCOPE_CORE_TEST(TestScanner)
#include "tst_scanner.moc"
