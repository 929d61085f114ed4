// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/table/catalog.h"
#include "core/table/units.h"
#include "tests/support/testmain.h"

#include <map>
#include <set>
#include <tuple>

using namespace dynascope;

namespace {

constexpr int Resolution = 4096;

const Catalog &builtIn()
{
    static const Result<Catalog> catalog = Catalog::builtIn();
    if (!catalog)
        qFatal("%s", qPrintable(catalog.error().text));
    return *catalog;
}

/// Factory values, but for what the test says.
RegisterLookup values(const ControlTablePtr &table, std::map<QString, std::int64_t> changed = {})
{
    return [table, changed](QStringView name) -> std::optional<std::int64_t> {
        const auto found = changed.find(name.toString());
        if (found != changed.end())
            return found->second;
        const Field *field = table->find(name);
        return field ? field->initial : std::nullopt;
    };
}

/// Every distinct kind of register of all models: size, sign, unit, scale.
std::vector<Field> kinds()
{
    std::vector<Field> fields;
    std::set<std::tuple<int, bool, int, double>> seen;
    for (const Catalog::ModelInfo &info : builtIn().models()) {
        for (const Field &field : builtIn().find(info.modelNumber, info.newestFirmware)->fields()) {
            if (seen.emplace(field.size, field.isSigned, int(field.unit), field.scale).second)
                fields.push_back(field);
        }
    }
    return fields;
}

/// All values of one and two bytes, and of four bytes those at the edges and at powers of two.
std::vector<std::int64_t> rawValues(const Field &field, int step = 1)
{
    std::vector<std::int64_t> raws;
    if (field.size <= 2) {
        for (std::int64_t raw = smallestRaw(field); raw <= largestRaw(field); raw += step)
            raws.push_back(raw);
        return raws;
    }
    for (int shift = 0; shift < 33; ++shift) {
        for (const std::int64_t near : {-1, 0, 1}) {
            for (const std::int64_t sign : {-1, 1}) {
                const std::int64_t raw = sign * ((std::int64_t(1) << shift) + near);
                if (raw >= smallestRaw(field) && raw <= largestRaw(field))
                    raws.push_back(raw);
            }
        }
    }
    for (std::int64_t raw = -5000; raw < 5000; ++raw) {
        if (raw >= smallestRaw(field))
            raws.push_back(raw);
    }
    return raws;
}

EffectiveField unlimited(const Field &field)
{
    EffectiveField result;
    result.unit = field.unit;
    result.scale = field.scale;
    return result;
}

} // namespace

class TestUnits : public QObject
{
    Q_OBJECT

private slots:
    void rawToPhysicalAndBack()
    {
        for (const Field &field : kinds()) {
            const EffectiveField now = unlimited(field);
            for (const AngleUnit angle : {AngleUnit::Degrees, AngleUnit::Radians, AngleUnit::Pulses}) {
                for (const std::int64_t raw : rawValues(field)) {
                    const Physical shown = physical(now, Resolution, raw, angle);
                    if (rawFromPhysical(now, Resolution, shown.value, angle) != raw)
                        QFAIL(qPrintable(QStringLiteral("%1 %2").arg(field.name).arg(raw)));
                }
            }
        }
    }

    /// The decimals shown are enough: neighbours differ, and typing back what is shown gives the same value.
    void shownTextIsEnough()
    {
        for (const Field &field : kinds()) {
            const EffectiveField now = unlimited(field);
            Field bare = field; // the names of values have a test of their own
            bare.values.clear();
            bare.special.clear();
            bare.bits.clear();
            for (const AngleUnit angle : {AngleUnit::Degrees, AngleUnit::Radians, AngleUnit::Pulses}) {
                if (angle != AngleUnit::Degrees && field.unit != Unit::Pulse)
                    continue;
                for (const std::int64_t raw : rawValues(field, 7)) {
                    const QString text = valueText(bare, now, Resolution, raw, angle);
                    const Result<std::int64_t> back = parseValue(bare, now, Resolution, text, angle);
                    if (!back || *back != raw)
                        QFAIL(qPrintable(QStringLiteral("%1 %2: %3").arg(field.name).arg(raw).arg(text)));
                    QVERIFY(text != valueText(bare, now, Resolution, raw + 1, angle));
                }
            }
        }
    }

    /// What a value is called can be typed.
    void meaningsCanBeTyped()
    {
        for (const Catalog::ModelInfo &info : builtIn().models()) {
            for (const Field &field : builtIn().find(info.modelNumber, info.newestFirmware)->fields()) {
                if (field.size > 1)
                    continue;
                for (std::int64_t raw = smallestRaw(field); raw <= largestRaw(field); ++raw) {
                    const QString text = meaning(field, raw);
                    if (text.isEmpty() || (text == u"Disabled" && raw != 255) || text == u"Triggered")
                        continue;
                    const Result<std::int64_t> back = parseValue(field, unlimited(field), Resolution, text);
                    if (!back || *back != raw)
                        QFAIL(qPrintable(QStringLiteral("%1 %2: %3").arg(field.name).arg(raw).arg(text)));
                }
            }
        }
    }

    void shows_data()
    {
        QTest::addColumn<QString>("name");
        QTest::addColumn<qint64>("raw");
        QTest::addColumn<QString>("text");
        const auto row = [](const char *name, qint64 raw, const char *text) {
            QTest::addRow("%s %lld", name, static_cast<long long>(raw))
                << QString::fromUtf8(name) << raw << QString::fromUtf8(text);
        };
        row("Present Position", 2048, "180.00 °");
        row("Present Position", -1, "-0.09 °");
        row("Present Velocity", 100, "22.9 rev/min");
        row("Present Current", -10, "-27 mA");
        row("Present PWM", 885, "100.0 %");
        row("Present Input Voltage", 120, "12.0 V");
        row("Present Temperature", 38, "38 °C");
        row("Profile Acceleration", 1, "215 rev/min²");
        row("Return Delay Time", 250, "500 µs");
        row("Realtime Tick", 77, "77 ms");
        row("Position P Gain", 800, "800");
        row("Operating Mode", 5, "Current-based position control");
        row("Operating Mode", 2, "2");
        row("Baud Rate", 3, "1000000 bps");
        row("Torque Enable", 1, "On");
        row("Secondary ID", 255, "Disabled");
        row("Secondary ID", 12, "12");
        row("Bus Watchdog", 0, "Off");
        row("Bus Watchdog", 5, "100 ms");
        row("Bus Watchdog", -1, "Triggered");
        row("Hardware Error Status", 0, "None");
        row("Hardware Error Status", 0x24, "Overheating, Overload");
        row("Hardware Error Status", 0x41, "Input voltage, bit 6");
        row("Moving Status", 0x31, "In position, Trapezoid");
        row("Drive Mode", 13, "Reverse direction, Time-based profile, Torque on by goal");
        row("ID", 1, "1");
    }

    void shows()
    {
        QFETCH(QString, name);
        QFETCH(qint64, raw);
        const ControlTablePtr table = builtIn().find(1020, 45);
        const Field *field = table->find(name);
        QVERIFY(field);
        QTEST(valueText(*field, effective(*field, values(table)), Resolution, raw), "text");
    }

    void angles()
    {
        const ControlTablePtr table = builtIn().find(1020, 45);
        const Field &goal = *table->find(u"Goal Position");
        const EffectiveField now = effective(goal, values(table));
        QCOMPARE(physical(now, 4096, 2048).value, 180.0);
        QCOMPARE(valueText(goal, now, 4096, 1024, AngleUnit::Radians), QStringLiteral("1.571 rad"));
        QCOMPARE(valueText(goal, now, 4096, 1024, AngleUnit::Pulses), QStringLiteral("1024 pulse"));
        QCOMPARE(valueText(goal, now, 1003846, 1003846), QStringLiteral("360.0000 °"));
        QCOMPARE(rawFromPhysical(now, 4096, 1e300), std::int64_t(1'000'000'000'000'000));
        QCOMPARE(rawFromPhysical(now, 4096, qQNaN()), std::int64_t(0));
    }

    /// Pulses by time are shown with the angle that was chosen, of the joint behind its gears.
    void ratesFollowTheAngle_data()
    {
        QTest::addColumn<QString>("name");
        QTest::addColumn<qint64>("raw");
        QTest::addColumn<int>("angle");
        QTest::addColumn<QString>("text");
        const auto row = [](const char *name, qint64 raw, AngleUnit angle, const char *text) {
            QTest::addRow("%s %s", name, text)
                << QString::fromUtf8(name) << raw << int(angle) << QString::fromUtf8(text);
        };
        row("Moving Threshold", 19, AngleUnit::Degrees, "65 °/s");
        row("Moving Threshold", 19, AngleUnit::Radians, "1.14 rad/s");
        row("Moving Threshold", 19, AngleUnit::Turns, "0.181 turn/s");
        row("Moving Threshold", 19, AngleUnit::Pulses, "95 pulse/ms");
        row("Velocity Trajectory", -524288, AngleUnit::Degrees, "-360.0000 °/s");
        row("Velocity Trajectory", -524288, AngleUnit::Pulses, "-524288 pulse/s");
    }

    void ratesFollowTheAngle()
    {
        QFETCH(QString, name);
        QFETCH(qint64, raw);
        QFETCH(int, angle);
        const ControlTablePtr table = builtIn().find(4020, 11);
        const Field *field = table->find(name);
        QVERIFY(field);
        const EffectiveField now = effective(*field, values(table));
        QTEST(valueText(*field, now, table->resolution(), raw, AngleUnit(angle)), "text");
        UnitPreferences bare;
        bare.raw = true;
        QCOMPARE(valueText(*field, now, table->resolution(), raw, bare), QString::number(raw));
    }

    void unitsAreNamed()
    {
        QCOMPARE(unitId(Unit::Pulse), QStringLiteral("deg"));
        QCOMPARE(unitId(Unit::None), QString());
        QCOMPARE(unitId(Unit::Celsius), QStringLiteral("degC"));
        QCOMPARE(unitId(Unit::RevPerMin2), QStringLiteral("rev/min2"));
        QCOMPARE(unitId(Unit::Microsecond), QStringLiteral("us"));
        QCOMPARE(unitId(Unit::MilliVoltPerMs), QStringLiteral("mV/ms"));
        QCOMPARE(unitId(Unit::PulsePerMs), QStringLiteral("deg/s"));
        QCOMPARE(unitSymbol(Unit::Pulse), QStringLiteral("°"));
        QCOMPARE(unitSymbol(Unit::Pulse, AngleUnit::Radians), QStringLiteral("rad"));
    }
};

DYNASCOPE_CORE_TEST(TestUnits)
#include "tst_units.moc"
