// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/monitor.h"
#include "tests/support/sessionfixture.h"
#include "tests/support/testmain.h"

using namespace dynascope;

class TestMonitor : public QObject
{
    Q_OBJECT

private slots:
    void initTestCase()
    {
        auto catalog = Catalog::builtIn();
        QVERIFY2(catalog, catalog ? "" : qPrintable(catalog.error().text));
        m_catalog = std::move(*catalog);
    }

    void everyNewBusThreadIsToldWhatToPoll()
    {
        VirtualSession all(m_catalog, QStringLiteral("XM430-W350@57600:1"));
        std::atomic<int> packets = 0;
        all.factory.onPacket = [&](int, ByteView) { ++packets; };
        Monitor monitor(all.session);
        all.open(57600); // its state is due once: virtual time stands still then
        QVERIFY(VirtualSession::waitFor([&] { return packets > 0; }));
        const int generation = all.line->generation();
        all.line->bus().close();
        packets = 0;
        all.line->reopen();
        QVERIFY(all.line->generation() > generation);
        QVERIFY(VirtualSession::waitFor([&] { return packets > 0; }));
        all.close();
        packets = 0;
        all.open(57600);
        QVERIFY(VirtualSession::waitFor([&] { return packets > 0; }));
    }

    void aTraceKeepsItsCurveWhenItsLineCloses()
    {
        VirtualSession all(m_catalog, QStringLiteral("XM430-W350@57600:1"));
        Monitor monitor(all.session);
        monitor.setPaused(true);
        all.open(57600);
        const Device &device = *all.line->devices().front();
        const Watch shown{device.key(), device.table().indexOf(u"Present Position")};
        const Watch hidden{device.key(), device.table().indexOf(u"Present Current")};
        monitor.watch(shown);
        monitor.watch(hidden);
        poll(*all.line, device, shown.field);
        poll(*all.line, device, hidden.field);
        monitor.unwatch(hidden);
        QVERIFY(monitor.history(hidden)); // for as long as it could be watched again

        all.close();
        QVERIFY(!monitor.isWatched(shown));
        QVERIFY(monitor.history(shown));
        QCOMPARE(monitor.history(shown)->last().raw, 7);
        QVERIFY(!monitor.history(hidden));
        monitor.unwatch(shown); // the trace is removed
        QVERIFY(!monitor.history(shown));
    }

    void clearingTakesTheGoneAsWell()
    {
        VirtualSession all(m_catalog, QStringLiteral("XM430-W350@57600:1"));
        Monitor monitor(all.session);
        monitor.setPaused(true);
        all.open(57600);
        const Device &device = *all.line->devices().front();
        const Watch shown{device.key(), device.table().indexOf(u"Present Position")};
        monitor.watch(shown);
        poll(*all.line, device, shown.field);
        all.close();
        QVERIFY(monitor.history(shown));
        monitor.clear();
        QVERIFY(!monitor.history(shown));
    }

private:
    /// As if a poll had brought 7.
    static void poll(LineSession &line, const Device &device, int fieldIndex)
    {
        const Field &field = device.table().fields()[static_cast<std::size_t>(fieldIndex)];
        PollValue value;
        value.device = device.key();
        value.address = field.address;
        value.length = field.size;
        value.data = bytesFromRaw(field, 7);
        value.at = std::chrono::milliseconds(1);
        Batch batch;
        batch.values.push_back(value);
        emit line.batchTaken(batch);
    }

    Catalog m_catalog;
};

DYNASCOPE_CORE_TEST(TestMonitor)
#include "tst_monitor.moc"
