// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/monitor.h"
#include "tests/support/builtincatalog.h"
#include "tests/support/sessionfixture.h"
#include "tests/support/testmain.h"

using namespace dynascope;

class TestMonitor : public QObject
{
    Q_OBJECT

private slots:
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

    void aDirectionBitIsASign()
    {
        VirtualSession all(m_catalog, QStringLiteral("XL-320@1000000:1"));
        Monitor monitor(all.session);
        monitor.setPaused(true);
        all.open(1000000);
        Device &device = *all.line->devices().front();
        const ControlTable &table = device.table();
        const Watch speed{device.key(), table.indexOf(u"Present Speed")};
        const Watch drive{device.key(), table.indexOf(u"Moving Speed")};
        monitor.watch(speed);
        monitor.watch(drive);
        poll(*all.line, device, speed.field, 1024 + 7);
        QCOMPARE(monitor.history(speed)->last().raw, -7);
        poll(*all.line, device, drive.field, 1024 + 7); // the mode isn't known yet
        QCOMPARE(monitor.history(drive)->last().raw, 1031);
        device.takeReadBack(table.indexOf(u"Control Mode"), 1);
        poll(*all.line, device, drive.field, 1024 + 7, 2);
        QCOMPARE(monitor.history(drive)->last().raw, -7);
    }

    void aGlanceAsksForAllDevicesButPlotsNothing()
    {
        VirtualSession all(m_catalog, QStringLiteral("XM430-W350@57600:1,XL430-W250@57600:2"));
        Monitor monitor(all.session);
        all.open(57600);
        const auto spans = [&] {
            std::set<int> ids;
            for (const PollSpan &span : all.line->pollPlan().spans) {
                if (span.interval == std::chrono::milliseconds(200))
                    ids.insert(span.span.id);
            }
            return ids;
        };
        monitor.setGlancing(true);
        QVERIFY(VirtualSession::waitFor([&] { return spans() == std::set<int>{1, 2}; }));
        QVERIFY(monitor.watches().empty());
        // Limits are read until they are known, and no longer.
        const Device &device = *all.line->devices().front();
        const int limit = device.table().indexOf(u"Temperature Limit");
        const auto isAsked = [&] {
            return std::ranges::any_of(all.line->pollPlan().spans, [](const PollSpan &span) {
                return span.span.id == 1 && span.span.address <= 31 && span.span.address + span.span.length > 31;
            });
        };
        QVERIFY(VirtualSession::waitFor([&] { return device.value(limit).raw.has_value(); }));
        QVERIFY(VirtualSession::waitFor([&] { return !isAsked(); }));
        monitor.setGlancing(false);
        QVERIFY(VirtualSession::waitFor([&] { return spans().empty(); }));
    }

private:
    /// As if a poll had brought it.
    static void poll(LineSession &line, const Device &device, int fieldIndex, std::int64_t raw = 7, int at = 1)
    {
        const Field &field = device.table().fields()[static_cast<std::size_t>(fieldIndex)];
        PollValue value;
        value.device = device.key();
        value.address = field.address;
        value.length = field.size;
        value.data = bytesFromRaw(field, raw);
        value.at = std::chrono::milliseconds(at);
        Batch batch;
        batch.values.push_back(value);
        emit line.batchTaken(batch);
    }

    const Catalog m_catalog = test::builtInCatalog();
};

DYNASCOPE_CORE_TEST(TestMonitor)
#include "tst_monitor.moc"
