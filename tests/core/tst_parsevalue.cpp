// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/table/catalog.h"
#include "core/table/units.h"
#include "tests/support/testmain.h"

#include <map>

using namespace dynascope;

/// What people type, and what comes of it: a table. Registers not set in a row have their factory values.
class TestParseValue : public QObject
{
    Q_OBJECT

private:
    const Catalog m_catalog = Catalog::builtIn().value_or(Catalog());

    Result<std::int64_t> parse(int model, const QString &name, const QString &text, int drive = 0, int mode = 3) const
    {
        const ControlTablePtr table = m_catalog.find(model, 255);
        const RegisterLookup lookup = [&](QStringView reg) -> std::optional<std::int64_t> {
            if (reg == u"Drive Mode")
                return drive;
            if (reg == u"Operating Mode" || reg == u"Control Mode")
                return mode;
            const Field *field = table->find(reg);
            return field ? field->initial : std::nullopt;
        };
        const Field *field = table->find(name);
        if (!field)
            qFatal("no %s", qPrintable(name));
        return parseValue(*field, effective(*field, lookup), table->resolution(), text);
    }

private slots:
    void accepts_data()
    {
        QTest::addColumn<QString>("name");
        QTest::addColumn<QString>("text");
        QTest::addColumn<qint64>("raw");
        const auto row = [](const char *name, const char *text, qint64 raw) {
            QTest::addRow("%s=%s", name, text) << QString::fromUtf8(name) << QString::fromUtf8(text) << raw;
        };
        row("Goal Position", "2048", 2048);
        row("Goal Position", " 2048 ", 2048);
        row("Goal Position", "+2048", 2048);
        row("Goal Position", "0x800", 2048);
        row("Goal Position", "0X0800", 2048);
        row("Goal Position", "180deg", 2048);
        row("Goal Position", "180 °", 2048);
        row("Goal Position", "180.02 DEG", 2048);
        row("Goal Position", "1.8e2 degrees", 2048);
        row("Goal Position", "0.5turn", 2048);
        row("Goal Position", ".5 turns", 2048);
        row("Goal Position", "3.14159rad", 2048);
        row("Goal Position", "100pulse", 100);
        row("Goal Velocity", "-100", -100);
        row("Goal Velocity", "−100", -100);
        row("Goal Velocity", "-0x64", -100);
        row("Goal Velocity", "30rpm", 131);
        row("Goal Velocity", "-22.9 rev/min", -100);
        row("Goal Velocity", "180 deg/s", 131);
        row("Goal Velocity", "1 rad/s", 42);
        row("Goal Current", "200mA", 74);
        row("Goal Current", "-0.2A", -74);
        row("Goal PWM", "50%", 442);
        row("Goal PWM", "-50 percent", -442);
        row("Max Voltage Limit", "12.1V", 121);
        row("Max Voltage Limit", "12100 mV", 121);
        row("Temperature Limit", "75C", 75);
        row("Temperature Limit", "75 °C", 75);
        row("Return Delay Time", "100us", 50);
        row("Return Delay Time", "100 µs", 50);
        row("Return Delay Time", "0.1ms", 50);
        row("Return Delay Time", "0.0005s", 250);
        row("Profile Acceleration", "1000 rev/min2", 5);
        row("Profile Acceleration", "1000 rev/min²", 5);
        row("Profile Acceleration", "360 deg/s²", 17);
        row("Operating Mode", "3", 3);
        row("Operating Mode", "Position control", 3);
        row("Operating Mode", "position", 3);
        row("Operating Mode", "current-based position control", 5);
        row("Operating Mode", "pwm", 16);
        row("Operating Mode", "EXTENDED_POSITION", 4);
        row("Baud Rate", "57600 bps", 1);
        row("Baud Rate", "1000000bps", 3);
        row("Baud Rate", "3", 3);
        row("Torque Enable", "on", 1);
        row("Torque Enable", "Off", 0);
        row("Torque Enable", "true", 1);
        row("LED", "1", 1);
        row("Secondary ID", "disabled", 255);
        row("Secondary ID", "7", 7);
        row("Bus Watchdog", "off", 0);
        row("Bus Watchdog", "100ms", 5);
        row("Bus Watchdog", "1 s", 50);
        row("Drive Mode", "reverse direction", 1);
        row("Drive Mode", "Reverse direction + Time-based profile", 5);
        row("Drive Mode", "timebasedprofile,torqueonbygoal", 12);
        row("Drive Mode", "none", 0);
        row("Drive Mode", "5", 5);
        row("Drive Mode", "bit 2", 4);
        row("Shutdown", "overheating+overload", 36);
        row("Shutdown", "0xFF", 255);
        row("ID", "252", 252);
    }

    void accepts()
    {
        QFETCH(QString, name);
        QFETCH(QString, text);
        const Result<std::int64_t> raw = parse(1020, name, text);
        QVERIFY2(raw, raw ? "" : qPrintable(raw.error().text));
        QTEST(qint64(*raw), "raw");
    }

    void refuses_data()
    {
        QTest::addColumn<QString>("name");
        QTest::addColumn<QString>("text");
        QTest::addColumn<QString>("message");
        const auto row = [](const char *name, const char *text, const char *message) {
            QTest::addRow("%s=%s", name, text)
                << QString::fromUtf8(name) << QString::fromUtf8(text) << QString::fromUtf8(message);
        };
        row("ID", "", "ID needs a value");
        row("ID", "  ", "ID needs a value");
        row("ID", "253", "ID can't be 253; its range is 0 to 252");
        row("ID", "-1", "ID can't be -1; its range is 0 to 252");
        row("ID", "1.5", "ID takes a whole number, not 1.5");
        row("ID", "5mA", "ID has no unit; give a bare number");
        row("ID", "five", "\"five\" is no value of ID; it takes a number");
        row("ID", "0x", "ID has no unit; give a bare number");
        row("ID", "99999999999999999999", "ID takes a whole number, not 99999999999999999999");
        row("Goal Position", "4096",
            "Goal Position can't be 4096 (360.00 °); its range is 0 to 4095 (0.00 to 359.91 °)");
        row("Goal Position", "-1deg",
            "Goal Position can't be -11 (-0.97 °); its range is 0 to 4095 (0.00 to 359.91 °)");
        row("Goal Position", "30rpm",
            "\"rpm\" does not fit Goal Position; it takes deg, rad, turn, pulse, or a bare number for the register's "
            "own "
            "value");
        row("Goal Position", "90.5",
            "Goal Position takes a whole number, or any with a unit (deg, rad, turn, pulse), not 90.5");
        row("Goal Position", "nan",
            "\"nan\" is no value of Goal Position; it takes a number by itself or with a unit (deg, rad, turn, pulse)");
        row("Goal Position", "1e999deg",
            "\"1e999deg\" is no value of Goal Position; it takes a number by itself or with a unit "
            "(deg, rad, turn, pulse)");
        row("Goal Velocity", "100rpm",
            "Goal Velocity can't be 437 (100.1 rev/min); its range is -200 to 200 (-45.8 to "
            "45.8 rev/min)");
        row("Goal Current", "200V",
            "\"V\" does not fit Goal Current; it takes mA, A, or a bare number for the register's "
            "own value");
        row("Operating Mode", "2",
            "Operating Mode can't be 2; it is one of 0 (Current control), 1 (Velocity control), 3 "
            "(Position control), 4 (Extended position control), 5 (Current-based position control), "
            "16 (PWM control)");
        row("Operating Mode", "current",
            "\"current\" is no value of Operating Mode; it is one of Current control, Velocity "
            "control, Position control, Extended position control, Current-based position "
            "control, PWM control");
        row("Operating Mode", "p",
            "\"p\" is no value of Operating Mode; it is one of Current control, Velocity control, "
            "Position control, Extended position control, Current-based position control, PWM control");
        row("Torque Enable", "maybe", "\"maybe\" is no value of Torque Enable; it is one of Off, On");
        row("Baud Rate", "57600",
            "Baud Rate can't be 57600; it is one of 0 (9600 bps), 1 (57600 bps), 2 (115200 bps), 3 (1000000 bps), "
            "4 (2000000 bps), 5 (3000000 bps), 6 (4000000 bps), 7 (4500000 bps); write 57600bps or 1");
        row("Torque Enable", "2", "Torque Enable can't be 2; it is one of 0 (Off), 1 (On)");
        row("Bus Watchdog", "-1", "Bus Watchdog can't be -1 (-20 ms); its range is 0 to 127 (0 to 2540 ms)");
        row("Bus Watchdog", "soon",
            "\"soon\" is no value of Bus Watchdog; it takes a number by itself or with a unit (ms, s, us), or Off");
        row("Drive Mode", "16", "Drive Mode can't be 16; its range is 0 to 13");
        row("Drive Mode", "backwards",
            "\"backwards\" is no bit of Drive Mode; it has Reverse direction, Time-based profile, "
            "Torque on by goal, None, joined by + or ,");
        row("Drive Mode", "reverse direction+",
            "\"\" is no bit of Drive Mode; it has Reverse direction, Time-based profile, "
            "Torque on by goal, None, joined by + or ,");
        row("Shutdown", "256", "Shutdown can't be 256; its range is 0 to 255");
    }

    void refuses()
    {
        QFETCH(QString, name);
        QFETCH(QString, text);
        const Result<std::int64_t> raw = parse(1020, name, text);
        QVERIFY2(!raw, qPrintable(QString::number(raw.value_or(0))));
        QCOMPARE(raw.error().kind, ErrorKind::InvalidArgument);
        QTEST(raw.error().text, "message");
    }

    /// Pulses by time are typed as the turning of the joint, or as they are.
    void takesRates_data()
    {
        QTest::addColumn<QString>("text");
        QTest::addColumn<qint64>("raw");
        for (const char *text :
             {"19", "95 pulse/ms", "95000 pulse/s", "65 °/s", "65deg/s", "1.14 rad/s", "0.181 turn/s"})
            QTest::addRow("%s", text) << QString::fromUtf8(text) << qint64(19);
        QTest::addRow("rpm") << QStringLiteral("10rpm") << qint64(17);
    }

    void takesRates()
    {
        QFETCH(QString, text);
        const Result<std::int64_t> raw = parse(4020, QStringLiteral("Moving Threshold"), text);
        QVERIFY2(raw, raw ? "" : qPrintable(raw.error().text));
        QTEST(qint64(*raw), "raw");
    }

    /// What was typed is refused, not what it would have become.
    void refusesAsTyped_data()
    {
        QTest::addColumn<int>("model");
        QTest::addColumn<QString>("name");
        QTest::addColumn<QString>("text");
        QTest::addColumn<QString>("message");
        const auto row = [](int model, const char *name, const char *text, const char *message) {
            QTest::addRow("%s %s", name, text)
                << model << QString::fromUtf8(name) << QString::fromUtf8(text) << QString::fromUtf8(message);
        };
        row(350, "Moving Speed", "3072",
            "Moving Speed can't be 3072; its range is 0 to 2047 (-102.3 to 102.3 %)");
        row(350, "Moving Speed", "120percent",
            "Moving Speed can't be 120 percent; its range is -102.3 to 102.3 %");
        row(4020, "Moving Threshold", "5mA",
            "\"mA\" does not fit Moving Threshold; it takes deg/s, rad/s, rpm, pulse/ms, or a bare number for the "
            "register's own value");
        row(4020, "Hybrid Save", "2", "Hybrid Save can't be 2; its range is 0 to 1");
    }

    void refusesAsTyped()
    {
        QFETCH(int, model);
        QFETCH(QString, name);
        QFETCH(QString, text);
        const Result<std::int64_t> raw = parse(model, name, text, 0, model == 350 ? 1 : 3);
        QVERIFY2(!raw, qPrintable(QString::number(raw.value_or(0))));
        QTEST(raw.error().text, "message");
    }

    void followsOtherRegisters()
    {
        const QString velocity = QStringLiteral("Profile Velocity"), goal = QStringLiteral("Goal Position");
        QCOMPARE(parse(1020, velocity, QStringLiteral("100rpm")).value_or(-1), std::int64_t(437));
        QVERIFY(!parse(1020, velocity, QStringLiteral("100ms")));
        QCOMPARE(parse(1020, velocity, QStringLiteral("1.5s"), 4).value_or(-1), std::int64_t(1500));
        QVERIFY(!parse(1020, velocity, QStringLiteral("100rpm"), 4));
        QVERIFY(!parse(1020, velocity, QStringLiteral("32767"), 4));
        QVERIFY(!parse(1020, goal, QStringLiteral("-2turn")));
        QCOMPARE(parse(1020, goal, QStringLiteral("-2turn"), 0, 4).value_or(-1), std::int64_t(-8192));
        QCOMPARE(parse(1020, goal, QStringLiteral("-2turn"), 0, 5).value_or(-1), std::int64_t(-8192));
        QVERIFY(!parse(1060, goal, QStringLiteral("-2turn"), 0, 5));
        QVERIFY(!parse(1020, goal, QStringLiteral("1e6turn"), 0, 4));
    }
};

DYNASCOPE_CORE_TEST(TestParseValue)
#include "tst_parsevalue.moc"
