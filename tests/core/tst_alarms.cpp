// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/alarms.h"
#include "tests/support/testmain.h"

using namespace dynascope;
using namespace std::chrono_literals;

namespace {

const VitalLimit NoLimit;

VitalLimit own(double value, const char *name = "Limit")
{
    return {value, LimitSource::Device, QString::fromLatin1(name)};
}

VitalReading reading(double value, const VitalLimit &low, const VitalLimit &high, LineTime at, const QString &unit)
{
    VitalReading one;
    one.field = 1;
    one.raw = static_cast<std::int64_t>(value);
    one.at = at;
    one.value = {value, unit, 1};
    one.low = low;
    one.high = high;
    return one;
}

/// What one value says of a device of which nothing else is known.
Vitals vitals(AlarmKind kind, double value, LineTime at, std::optional<VitalLimit> limit = {})
{
    Vitals all;
    all.isThere = true;
    switch (kind) {
    case AlarmKind::Temperature:
        all[Vital::Temperature] = reading(value, NoLimit, limit.value_or(own(80)), at, QStringLiteral("°C"));
        break;
    case AlarmKind::OverVoltage:
        all[Vital::Voltage] = reading(value, own(9), limit.value_or(own(16)), at, QStringLiteral("V"));
        break;
    case AlarmKind::UnderVoltage:
        all[Vital::Voltage] = reading(value, limit.value_or(own(9.5)), own(40), at, QStringLiteral("V"));
        break;
    case AlarmKind::Load:
        all[Vital::Load] = reading(value, NoLimit, limit.value_or(own(1000)), at, QStringLiteral("mA"));
        break;
    case AlarmKind::Error: all.errors = value != 0 ? QStringLiteral("Overload") : QString(); break;
    case AlarmKind::Silent:
        all.isThere = value == 0;
        all.isSilent = value != 0;
        break;
    }
    return all;
}

const Alarms::Subject Elbow{3, QStringLiteral("Elbow")};

} // namespace

/// Alarms of values as a device might say them, each with its time.
class TestAlarms : public QObject
{
    Q_OBJECT

private slots:
    /// Once a second a value; the levels that follow, a letter for each: none, near, over.
    void followsWithHysteresis_data()
    {
        QTest::addColumn<AlarmKind>("kind");
        QTest::addColumn<QList<double>>("values");
        QTest::addColumn<QString>("levels");
        QTest::addColumn<int>("alarms");
        using enum AlarmKind;
        using Values = QList<double>;
        QTest::newRow("cool") << Temperature << Values{20, 60, 70, 70, 70} << "....." << 0;
        QTest::newRow("warm: at the second reading") << Temperature << Values{71, 71, 71} << ".nn" << 1;
        QTest::newRow("a reading alone is none") << Temperature << Values{71, 50, 90, 50, 90, 50} << "......" << 0;
        QTest::newRow("always warm, by turns more") << Temperature << Values{71, 90, 71, 90} << ".nnn" << 1;
        QTest::newRow("hot") << Temperature << Values{81, 82, 83} << ".oo" << 1;
        QTest::newRow("warm, then hot: one alarm") << Temperature << Values{71, 71, 81, 81, 81} << ".nnoo" << 1;
        QTest::newRow("stays till well below") << Temperature << Values{81, 81, 78, 78, 78, 78} << ".ooooo" << 1;
        QTest::newRow("falls a level") << Temperature << Values{81, 81, 77, 77, 77, 77} << ".ooonn" << 1;
        QTest::newRow("and to none") << Temperature << Values{81, 81, 60, 60, 60, 60} << ".ooo.." << 1;
        QTest::newRow("near stays, too") << Temperature << Values{71, 71, 68, 68, 68, 68} << ".nnnnn" << 1;
        QTest::newRow("near ends") << Temperature << Values{71, 71, 67, 67, 67} << ".nnn." << 1;
        QTest::newRow("about the limit it doesn't flap")
            << Temperature << Values{71, 71, 69, 71, 68, 71, 69, 71, 68, 70} << ".nnnnnnnnn" << 1;
        QTest::newRow("well below and back is one") << Temperature << Values{71, 71, 60, 71, 60, 71} << ".nnnnn" << 1;
        QTest::newRow("twice") << Temperature << Values{71, 71, 60, 60, 60, 71, 71} << ".nnn..n" << 2;

        QTest::newRow("at the upper limit is within") << OverVoltage << Values{16, 16, 16} << ".nn" << 1;
        QTest::newRow("overvoltage") << OverVoltage << Values{16.1, 16.1, 15.9, 15.9, 15.9, 15.9} << ".ooooo" << 1;
        QTest::newRow("overvoltage ends") << OverVoltage << Values{16.1, 16.1, 12, 12, 12} << ".ooo." << 1;
        QTest::newRow("at the lower limit is within") << UnderVoltage << Values{9.5, 9.5, 9.5} << ".nn" << 1;
        QTest::newRow("undervoltage") << UnderVoltage << Values{9.4, 9.4, 9.5, 9.5, 9.5, 9.5} << ".ooooo" << 1;
        QTest::newRow("undervoltage ends") << UnderVoltage << Values{9.4, 9.4, 12, 12, 12} << ".ooo." << 1;
        QTest::newRow("good voltage") << UnderVoltage << Values{12, 12, 12} << "..." << 0;

        QTest::newRow("load") << Load << Values{800, 801, 801, 951, 951} << "..nno" << 1;
        QTest::newRow("load the other way") << Load << Values{-801, -801, -951, -951} << ".nno" << 1;
        QTest::newRow("a peak of load") << Load << Values{100, 999, 100, 100} << "...." << 0;
        QTest::newRow("load stays") << Load << Values{951, 951, 860, 860, 860, 860} << ".ooooo" << 1;
        QTest::newRow("load goes") << Load << Values{951, 951, 100, 100, 100} << ".ooo." << 1;

        QTest::newRow("an error counts at once, and ends at once") << Error << Values{0, 1, 1, 0} << ".oo." << 1;
        QTest::newRow("silent at once, back after a while") << Silent << Values{0, 1, 1, 0, 0, 0} << ".oooo." << 1;
        QTest::newRow("silent by turns is one") << Silent << Values{1, 0, 1, 0, 1, 0, 1} << "ooooooo" << 1;
    }

    void followsWithHysteresis()
    {
        QFETCH(AlarmKind, kind);
        QFETCH(QList<double>, values);
        QFETCH(QString, levels);
        QFETCH(int, alarms);
        Alarms all;
        QString seen;
        for (int second = 0; second < values.size(); ++second) {
            feed(all, vitals(kind, values[second], std::chrono::seconds(second)), second);
            seen += letter(all.level(Elbow.device, kind));
        }
        QCOMPARE(seen, levels);
        QCOMPARE(static_cast<int>(all.list().size()), alarms);
        QCOMPARE(all.active(), static_cast<std::size_t>(levels.back() == u'.' ? 0 : 1));
        for (const Alarm &alarm : all.list()) {
            QCOMPARE(alarm.kind, kind);
            QCOMPARE(alarm.name, QStringLiteral("Elbow"));
        }
    }

    void theSameReadingAgainSaysNothingNew()
    {
        Alarms all;
        for (int second = 0; second < 10; ++second)
            feed(all, vitals(AlarmKind::Temperature, 90, 0s), second); // polled once
        QVERIFY(all.list().empty());
    }

    void anotherClockBeginsAnew()
    {
        Alarms all;
        feed(all, vitals(AlarmKind::Temperature, 90, 1000s), 0);
        feed(all, vitals(AlarmKind::Temperature, 90, 2s), 1);
        QVERIFY(all.list().empty());
        feed(all, vitals(AlarmKind::Temperature, 90, 3s), 2);
        QCOMPARE(all.list().size(), std::size_t(1));
    }

    void withoutALimitThereIsNoAlarm_data()
    {
        QTest::addColumn<AlarmKind>("kind");
        QTest::addColumn<double>("value");
        QTest::newRow("temperature") << AlarmKind::Temperature << 200.0;
        QTest::newRow("overvoltage") << AlarmKind::OverVoltage << 90.0;
        QTest::newRow("undervoltage") << AlarmKind::UnderVoltage << 1.0;
        QTest::newRow("load") << AlarmKind::Load << 9000.0;
    }

    void withoutALimitThereIsNoAlarm()
    {
        QFETCH(AlarmKind, kind);
        QFETCH(double, value);
        Alarms all;
        for (int second = 0; second < 5; ++second)
            feed(all, vitals(kind, value, std::chrono::seconds(second), NoLimit), second);
        QVERIFY(all.list().empty());
        for (int second = 5; second < 10; ++second) // it is read, and now it counts
            feed(all, vitals(kind, value, std::chrono::seconds(second)), second);
        QCOMPARE(all.list().size(), std::size_t(1));
        Vitals unknown = vitals(kind, value, 11s);
        for (VitalReading &each : unknown.readings)
            each.raw.reset();
        for (int second = 11; second < 20; ++second) // nobody knows: it lasts
            feed(all, unknown, second);
        QCOMPARE(all.active(), std::size_t(1));
    }

    void saysTheCause()
    {
        Alarms all;
        feed(all, vitals(AlarmKind::Temperature, 71, 0s, own(80, "Temperature Limit")), 0);
        feed(all, vitals(AlarmKind::Temperature, 72, 1s, own(80, "Temperature Limit")), 1);
        QCOMPARE(all.list().back().cause, QStringLiteral("72.0 °C, its Temperature Limit is 80.0 °C"));
        QCOMPARE(all.list().back().level, AlarmLevel::Near);
        feed(all, vitals(AlarmKind::Temperature, 81, 2s, own(80, "Temperature Limit")), 2);
        feed(all, vitals(AlarmKind::Temperature, 82, 3s, own(80, "Temperature Limit")), 3);
        QCOMPARE(all.list().back().cause, QStringLiteral("82.0 °C, its Temperature Limit is 80.0 °C"));
        QCOMPARE(all.list().back().level, AlarmLevel::Over);
        QCOMPARE(all.list().back().raised, wall(1));
        VitalLimit factory = own(1000, "Current Limit");
        factory.source = LimitSource::Table;
        feed(all, vitals(AlarmKind::Load, -960, 0s, factory), 4);
        feed(all, vitals(AlarmKind::Load, -960, 1s, factory), 5);
        QCOMPARE(all.list().back().cause,
                 QStringLiteral("-960.0 mA, 96 % of the factory's Current Limit of 1000.0 mA"));
        feed(all, vitals(AlarmKind::Error, 1, 0s), 6);
        QCOMPARE(all.list().back().cause, QStringLiteral("Overload"));
        Vitals more = vitals(AlarmKind::Error, 1, 0s);
        more.errors = QStringLiteral("Overload, Overheating");
        QVERIFY(feed(all, more, 7));
        QCOMPARE(all.list().back().cause, more.errors); // the same alarm
        QVERIFY(!feed(all, more, 8));
        QCOMPARE(all.list().size(), std::size_t(3));
    }

    void whoIsParkedOrUnreachableKeepsItsAlarms()
    {
        Alarms all;
        feed(all, vitals(AlarmKind::Error, 1, 0s), 0);
        feed(all, Vitals(), 1); // neither there nor silent
        QCOMPARE(all.active(), std::size_t(1));
        feed(all, vitals(AlarmKind::Error, 0, 2s), 2);
        QCOMPARE(all.active(), std::size_t(0));
        QCOMPARE(all.list().back().cleared, wall(2));
    }

    void goneAndBack()
    {
        Alarms all;
        feed(all, vitals(AlarmKind::Error, 1, 0s), 0);
        QVERIFY(all.remove(Elbow.device, wall(1)));
        QVERIFY(!all.remove(Elbow.device, wall(1)));
        QVERIFY(!all.list().back().isActive());
        QVERIFY(all.list().back().deviceWent);
        QCOMPARE(all.level(Elbow.device), AlarmLevel::None);
        feed(all, vitals(AlarmKind::Error, 1, 0s), 2);
        QCOMPARE(all.list().size(), std::size_t(2));
        QVERIFY(all.list().back().isActive());
        all.clearEnded();
        QCOMPARE(all.list().size(), std::size_t(1));
        QVERIFY(all.find(2));
        QVERIFY(!all.find(1));
    }

    /// The two axes of one housing are two devices.
    void twoAxesHaveAlarmsOfTheirOwn()
    {
        Alarms all;
        (void)all.take({1, QStringLiteral("Pan")}, vitals(AlarmKind::Error, 1, 0s), {0s, wall(0)});
        (void)all.take({2, QStringLiteral("Tilt")}, vitals(AlarmKind::Error, 0, 0s), {0s, wall(0)});
        QCOMPARE(all.list().size(), std::size_t(1));
        QCOMPARE(all.level(1), AlarmLevel::Over);
        QCOMPARE(all.level(2), AlarmLevel::None);
    }

    void tenThousandAreBounded()
    {
        Alarms all;
        feed(all, vitals(AlarmKind::Temperature, 90, 0s), 0);
        feed(all, vitals(AlarmKind::Temperature, 90, 1s), 1); // lasts all the time
        for (int i = 0; i < 10'000; ++i) {
            feed(all, vitals(AlarmKind::Error, 1, 0s), 2 * i);
            feed(all, vitals(AlarmKind::Error, 0, 0s), 2 * i + 1);
        }
        QCOMPARE(all.list().size(), Alarms::Most);
        QCOMPARE(all.list().back().number, quint64(10'001));
        QCOMPARE(all.list().front().kind, AlarmKind::Temperature); // what lasts stays in the list
        // Even where all last.
        Alarms many;
        for (DeviceKey device = 1; device <= 10'000; ++device)
            (void)many.take({device, {}}, vitals(AlarmKind::Error, 1, 0s), {0s, wall(0)});
        QCOMPARE(many.list().size(), Alarms::Most);
        QVERIFY(!many.remove(1, wall(1))); // its entry went before
        QVERIFY(many.remove(10'000, wall(1)));
    }

private:
    static QDateTime wall(int second) { return QDateTime(QDate(2026, 5, 4), QTime(12, 0)).addSecs(second); }
    static QChar letter(AlarmLevel level)
    {
        return level == AlarmLevel::Over ? u'o' : level == AlarmLevel::Near ? u'n' : u'.';
    }
    static bool feed(Alarms &alarms, const Vitals &vitals, int second)
    {
        return alarms.take(Elbow, vitals, {std::chrono::seconds(second), wall(second)});
    }
};

DYNASCOPE_CORE_TEST(TestAlarms)
#include "tst_alarms.moc"
