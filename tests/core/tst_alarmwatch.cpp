// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/alarmwatch.h"
#include "tests/support/builtincatalog.h"
#include "tests/support/sessionfixture.h"
#include "tests/support/testmain.h"

#include <QSignalSpy>

using namespace dynascope;
using namespace std::chrono_literals;

namespace {

/// As if a poll had brought it.
void poll(Device &device, QStringView name, std::int64_t raw, LineTime at)
{
    const Field *field = device.table().find(name);
    QVERIFY2(field, qPrintable(name.toString()));
    PollValue value;
    value.device = device.key();
    value.address = field->address;
    value.length = field->size;
    value.data = bytesFromRaw(*field, raw);
    value.at = at;
    device.take(value);
    if (device.line()) {
        Batch batch;
        batch.values.push_back(value);
        emit device.line()->batchTaken(batch);
    }
}

const VitalReading &of(const Vitals &vitals, Vital vital)
{
    return vitals[vital];
}

} // namespace

/// What devices of a session say, and the alarms that come of it.
class TestAlarmWatch : public QObject
{
    Q_OBJECT

private slots:
    /// Which registers say it, and what bounds them as the model leaves the factory.
    void modelsTellByTheirOwnRegisters_data()
    {
        QTest::addColumn<int>("model");
        QTest::addColumn<QString>("load");
        QTest::addColumn<QString>("loadLimit");
        QTest::addColumn<QString>("temperature");
        QTest::addColumn<QString>("voltage");
        QTest::addColumn<QString>("error");
        QTest::newRow("XM430-W350") << 1020 << "Present Current"
                                    << "Current Limit"
                                    << "Present Temperature"
                                    << "Present Input Voltage"
                                    << "Hardware Error Status";
        QTest::newRow("XL430-W250: no current") << 1060 << "Present Load"
                                                << "PWM Limit"
                                                << "Present Temperature"
                                                << "Present Input Voltage"
                                                << "Hardware Error Status";
        QTest::newRow("2XL430-W250: two axes") << 1090 << "Present Load"
                                               << "PWM Limit"
                                               << "Present Temperature"
                                               << "Present Input Voltage"
                                               << "Hardware Error Status";
        QTest::newRow("XL-320") << 350 << "Present Load"
                                << "Torque Limit"
                                << "Present Temperature"
                                << "Present Voltage"
                                << "Hardware Error Status";
        QTest::newRow("YM070-210-M001-RH") << 4000 << "Present Current"
                                           << "Current Limit"
                                           << "Present Inverter Temperature"
                                           << "Present Input Voltage"
                                           << "Error Code";
    }

    void modelsTellByTheirOwnRegisters()
    {
        QFETCH(int, model);
        const ControlTablePtr table = m_catalog.find(static_cast<std::uint16_t>(model), 45);
        QVERIFY(table);
        const auto name = [&](Vital vital, auto which) {
            for (const VitalField &field : vitalFields(*table)) {
                if (field.vital == vital)
                    return which(field) < 0 ? QString() : table->fields()[static_cast<std::size_t>(which(field))].name;
            }
            return QString();
        };
        const auto value = [](const VitalField &field) { return field.field; };
        const auto high = [](const VitalField &field) { return field.high; };
        QTEST(name(Vital::Load, value), "load");
        QTEST(name(Vital::Load, high), "loadLimit");
        QTEST(name(Vital::Temperature, value), "temperature");
        QTEST(name(Vital::Voltage, value), "voltage");
        QTEST(name(Vital::Error, value), "error");
        QCOMPARE(name(Vital::Position, value), QStringLiteral("Present Position"));
    }

    void limitsAreTheDevicesOwnOnceTheyAreRead()
    {
        Device device(1, nullptr, m_catalog.find(1020, 45), {1, 57600, 1020, 45, false, {}});
        const std::vector<VitalField> fields = vitalFields(device.table());
        poll(device, u"Present Temperature", 60, 1s);
        Vitals vitals = vitalsOf(device, fields);
        QCOMPARE(of(vitals, Vital::Temperature).high.value, 80.0);
        QCOMPARE(of(vitals, Vital::Temperature).high.source, LimitSource::Table);
        QCOMPARE(vitals.limits(), LimitSource::Table);
        QCOMPARE(partOf(Vital::Temperature, of(vitals, Vital::Temperature)), 0.75);
        poll(device, u"Temperature Limit", 72, 2s);
        poll(device, u"Max Voltage Limit", 160, 2s);
        poll(device, u"Current Limit", 500, 2s);
        vitals = vitalsOf(device, fields);
        QCOMPARE(of(vitals, Vital::Temperature).high.value, 72.0);
        QCOMPARE(of(vitals, Vital::Load).high.value, 1345.0); // mA
        QCOMPARE(vitals.limits(), LimitSource::Device);
        poll(device, u"Current Limit", 0, 3s); // bounds nothing
        QVERIFY(!of(vitalsOf(device, fields), Vital::Load).high.isKnown());
        QVERIFY(!partOf(Vital::Load, of(vitalsOf(device, fields), Vital::Load)));
        device.setState(Device::State::Silent);
        vitals = vitalsOf(device, fields);
        QVERIFY(vitals.isSilent);
        QVERIFY(!of(vitals, Vital::Temperature).raw);
    }

    /// Of the two temperatures the one nearer to its limit.
    void theWorseOfTwoTemperatures()
    {
        const ControlTablePtr table = m_catalog.find(4000, 45);
        Device device(1, nullptr, table, {1, 57600, 4000, 45, false, {}});
        const std::vector<VitalField> fields = vitalFields(*table);
        poll(device, u"Present Inverter Temperature", 50, 1s);
        poll(device, u"Present Motor Temperature", 40, 1s);
        QCOMPARE(of(vitalsOf(device, fields), Vital::Temperature).value.value, 50.0);
        poll(device, u"Present Motor Temperature", 70, 2s);
        QCOMPARE(of(vitalsOf(device, fields), Vital::Temperature).value.value, 70.0);
        QCOMPARE(of(vitalsOf(device, fields), Vital::Temperature).high.name, QStringLiteral("Motor Temperature Limit"));
    }

    void aFaultKeepsTheTenSecondsBeforeIt()
    {
        World world(m_catalog, QStringLiteral("XM430-W350@57600:1,XL430-W250@57600:2"));
        Device &device = *world.all.line->devices().front();
        const Watch current{device.key(), device.table().indexOf(u"Present Current")};
        world.monitor.watch(current);
        AlarmWatch watch(world.all.session, world.monitor);
        QSignalSpy changes(&watch, &AlarmWatch::alarmsChanged);
        for (int i = 0; i <= 2000; ++i) { // twenty seconds, a hundred a second
            const LineTime at = 100s + i * 10ms;
            poll(device, u"Present Current", i, at);
            if (i % 100 != 0)
                continue;
            poll(device, u"Present Temperature", 30, at); // once a second
            watch.look();
        }
        QCOMPARE(changes.count(), 2); // the load came near its limit of 1193, then over it
        QCOMPARE(watch.alarms().list().size(), std::size_t(1));
        poll(device, u"Hardware Error Status", 0x20, 120s + 1ms);
        watch.look();
        QCOMPARE(changes.count(), 3);
        const Alarm &alarm = watch.alarms().list().back();
        QCOMPARE(alarm.kind, AlarmKind::Error);
        QCOMPARE(alarm.cause, QStringLiteral("Overload"));
        QCOMPARE(alarm.name, device.displayName());
        const FaultRecord *record = watch.records().find(alarm.number);
        QVERIFY(record);
        QCOMPARE(record->at, LineTime(120s + 1ms));
        const FaultTrace &watched = trace(*record, u"Present Current");
        QVERIFY(watched.wasWatched);
        QCOMPARE(watched.samples.size(), std::size_t(1000));
        QCOMPARE(watched.samples.front().raw, 1001);
        QCOMPARE(watched.samples.back().raw, 2000);
        QCOMPARE(watched.unit, QStringLiteral("mA"));
        QCOMPARE(watched.scale, 2.69);
        const FaultTrace &polled = trace(*record, u"Present Temperature");
        QVERIFY(!polled.wasWatched);
        QCOMPARE(polled.samples.size(), std::size_t(10));
        QVERIFY(!record->isWhole);
        // And some after it.
        for (int i = 1; i <= 1000; ++i)
            poll(device, u"Present Current", 3000, 120s + i * 10ms);
        watch.look();
        QCOMPARE(trace(*record, u"Present Current").samples.size(), std::size_t(1500));
        // It outlives its device.
        const std::size_t samples = record->samples();
        world.all.close();
        QVERIFY(watch.records().find(alarm.number)->isWhole);
        QCOMPARE(watch.records().find(alarm.number)->samples(), samples);
        QVERIFY(watch.alarms().list().back().deviceWent);
        QCOMPARE(watch.alarms().active(), std::size_t(0));
    }

    void whatIsOnlyNearItsLimitIsNoFault()
    {
        World world(m_catalog, QStringLiteral("XM430-W350@57600:1"));
        Device &device = *world.all.line->devices().front();
        AlarmWatch watch(world.all.session, world.monitor);
        for (int second = 1; second <= 3; ++second) {
            poll(device, u"Present Temperature", 75, std::chrono::seconds(second));
            watch.look();
        }
        QCOMPARE(watch.alarms().list().size(), std::size_t(1));
        QCOMPARE(watch.records().size(), std::size_t(0));
        for (int second = 4; second <= 6; ++second) {
            poll(device, u"Present Temperature", 85, std::chrono::seconds(second));
            watch.look();
        }
        QCOMPARE(watch.alarms().list().size(), std::size_t(1)); // the same one, worse
        QVERIFY(watch.records().find(1));
        QCOMPARE(trace(*watch.records().find(1), u"Present Temperature").samples.size(),
                 std::size_t(6)); // one after it
    }

    void recordsAreBounded()
    {
        World world(m_catalog, QStringLiteral("XM430-W350@57600:1"));
        Device &device = *world.all.line->devices().front();
        const Watch current{device.key(), device.table().indexOf(u"Present Current")};
        world.monitor.watch(current);
        for (int i = 0; i < 60'000; ++i)
            poll(device, u"Present Current", i % 100, 100s + i * 100us); // 10 kHz
        AlarmWatch watch(world.all.session, world.monitor);
        for (int i = 0; i < 100; ++i) {
            poll(device, u"Hardware Error Status", i % 2 ? 0 : 1, 106s + i * 1us);
            watch.look();
        }
        QCOMPARE(watch.alarms().list().size(), std::size_t(50));
        QVERIFY(watch.records().size() <= FaultRecords::MostSamples / (FaultRecords::MostOfTrace / 2));
        QVERIFY(watch.records().size() > 10);
        QVERIFY(!watch.records().find(1)); // the oldest went
        QCOMPARE(trace(*watch.records().find(50), u"Present Current").samples.size(), FaultRecords::MostOfTrace / 2);
    }

private:
    struct World {
        World(const Catalog &catalog, const QString &servos) : all(catalog, servos), monitor(all.session)
        {
            monitor.setPaused(true);
            all.open(57600);
            if (!VirtualSession::waitFor([this] { return all.line->state() == BusThread::State::Open; }))
                qFatal("not open");
        }
        VirtualSession all;
        Monitor monitor;
    };

    static const FaultTrace &trace(const FaultRecord &record, QStringView name)
    {
        const auto at = std::ranges::find_if(record.traces, [name](const FaultTrace &one) { return one.name == name; });
        if (at == record.traces.end())
            qFatal("no such trace");
        return *at;
    }

    const Catalog m_catalog = test::builtInCatalog();
};

DYNASCOPE_CORE_TEST(TestAlarmWatch)
#include "tst_alarmwatch.moc"
