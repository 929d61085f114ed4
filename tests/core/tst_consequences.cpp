// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/consequences.h"
#include "tests/support/builtincatalog.h"
#include "tests/support/settingsworld.h"
#include "tests/support/testmain.h"

using namespace dynascope;
using namespace Qt::StringLiterals;
using test::Wanted;
using Kind = ConsequenceKind;

/// What is said before a write.
class TestConsequences : public QObject
{
    Q_OBJECT

private slots:
    void rows_data()
    {
        QTest::addColumn<QString>("model");
        QTest::addColumn<Wanted>("now");
        QTest::addColumn<QString>("field");
        QTest::addColumn<int>("raw");
        QTest::addColumn<std::vector<std::pair<Kind, QString>>>("says");
        const auto row = [](const char *name, const QString &model, const Wanted &now, const QString &field, int raw,
                            const std::vector<std::pair<Kind, QString>> &says) {
            QTest::newRow(name) << model << now << field << raw << says;
        };
        const QString x = u"XM430-W350"_s, y = u"YM070-210-M001-RH"_s, xl = u"XL-320"_s, pro = u"H54-100-S500-R"_s;
        const QString torque = u"Torque Enable"_s, goal = u"Goal Position"_s, present = u"Present Position"_s,
                      mode = u"Operating Mode"_s;
        row("the same", x, {{mode, 3}, {torque, 1}}, mode, 3, {});
        row("a lamp", x, {{u"LED"_s, 0}, {torque, 1}}, u"LED"_s, 1, {});
        row("EEPROM, torque off", x, {{torque, 0}}, u"Current Limit"_s, 100, {});
        row("EEPROM, torque on", x, {{torque, 1}}, u"Current Limit"_s, 100,
            {{Kind::NeedsTorqueOff, u"what the motor carries may fall"_s}});
        row("a mode, gains as the factory has them", x, {{mode, 3}, {u"Position P Gain"_s, 800}}, mode, 4, {});
        row("a mode, another gain", x, {{mode, 3}, {u"Position P Gain"_s, 640}, {u"Position I Gain"_s, 0}}, mode, 4,
            {{Kind::Resets, u"puts these registers back"_s}});
        row("offset", x, {{mode, 4}, {u"Homing Offset"_s, 0}, {present, 2048}}, u"Homing Offset"_s, 1024,
            {{Kind::MovesPosition, u"270.00 ° where it says 180.00 °, 90.00 ° more"_s}});
        row("offset beyond a quarter of a turn", x, {{mode, 3}, {u"Homing Offset"_s, 0}, {present, 2048}},
            u"Homing Offset"_s, 3000, {{Kind::MovesPosition, u"180.00 ° where it says 180.00 °, 0.00 ° more"_s}});
        row("offset, nobody knows the position", x, {{u"Homing Offset"_s, 0}}, u"Homing Offset"_s, 1024, {});
        row("the other way round", x, {{mode, 4}, {u"Drive Mode"_s, 0}, {present, 1024}, {u"Homing Offset"_s, 0}},
            u"Drive Mode"_s, 1, {{Kind::MovesPosition, u"about 270.00 ° where it says 90.00 °"_s}});
        row("limit below goal and place", x,
            {{mode, 3}, {u"Min Position Limit"_s, 0}, {u"Max Position Limit"_s, 4095}, {goal, 3000}, {present, 2990}},
            u"Max Position Limit"_s, 2000,
            {{Kind::BeyondLimits, u"Goal Position (263.67 °), Present Position (262.79 °)"_s}});
        row("limit above both", x,
            {{mode, 3}, {u"Min Position Limit"_s, 0}, {u"Max Position Limit"_s, 4095}, {goal, 3000}, {present, 2990}},
            u"Max Position Limit"_s, 3500, {});
        row("limit that doesn't hold in this mode", x,
            {{mode, 4}, {u"Min Position Limit"_s, 0}, {u"Max Position Limit"_s, 4095}, {goal, 3000}, {present, 2990}},
            u"Max Position Limit"_s, 2000, {});
        row("a mode in which the goal is out of range", x,
            {{mode, 4}, {u"Min Position Limit"_s, 0}, {u"Max Position Limit"_s, 4095}, {goal, 9000}, {present, 9000}},
            mode, 3, {{Kind::BeyondLimits, u"Goal Position"_s}});
        row("torque on, at its goal", x, {{mode, 3}, {torque, 0}, {goal, 2048}, {present, 2060}}, torque, 1, {});
        row("torque on, away from its goal", x, {{mode, 3}, {torque, 0}, {goal, 3072}, {present, 2048}}, torque, 1,
            {{Kind::Jumps, u"may jump by 90.00 ° as soon as torque is on: it is at 180.00 °, and its goal is 270.00 °"_s}});
        row("XL-320", xl, {{u"Control Mode"_s, 2}, {torque, 0}, {goal, 512}, {present, 212}}, torque, 1,
            {{Kind::Jumps, u"87.0"_s}});
        row("PRO", pro, {{mode, 3}, {torque, 0}, {goal, 0}, {present, 125480}}, torque, 1, {{Kind::Jumps, u"-89.9995"_s}});
        row("Y", y, {{mode, 3}, {torque, 0}, {goal, 131072}, {present, 0}}, torque, 1, {{Kind::Jumps, u"90.0"_s}});
        row("Y, at its goal", y, {{mode, 3}, {torque, 0}, {goal, 100}, {present, 0}}, torque, 1, {});
        row("torque off", x, {{mode, 3}, {torque, 1}, {goal, 3072}, {present, 2048}}, torque, 0, {});
        row("wheel", x, {{mode, 1}, {torque, 0}, {u"Goal Velocity"_s, 100}}, torque, 1,
            {{Kind::Turns, u"Goal Velocity is 22.9 rev/min"_s}});
        row("wheel at rest", x, {{mode, 1}, {torque, 0}, {u"Goal Velocity"_s, 0}}, torque, 1, {});
        row("PWM", x, {{mode, 16}, {torque, 0}, {u"Goal PWM"_s, 200}}, torque, 1, {{Kind::Turns, u"Goal PWM"_s}});
        row("XL-320, wheel", xl, {{u"Control Mode"_s, 1}, {torque, 0}, {u"Moving Speed"_s, 1024 + 300}}, torque, 1,
            {{Kind::Turns, u"Moving Speed"_s}});
        row("XL-320, wheel, none either way", xl, {{u"Control Mode"_s, 1}, {torque, 0}, {u"Moving Speed"_s, 1024}},
            torque, 1, {});
        row("PRO, torque mode", pro, {{mode, 0}, {torque, 0}, {u"Goal Torque"_s, 5}}, torque, 1,
            {{Kind::Turns, u"Goal Torque"_s}});
        row("a goal that waits", x, {{mode, 3}, {torque, 0}, {u"Drive Mode"_s, 0}, {present, 0}}, goal, 2000, {});
        row("a goal that turns torque on", x, {{mode, 3}, {torque, 0}, {u"Drive Mode"_s, 8}, {present, 1024}}, goal, 2048,
            {{Kind::Jumps, u"by 90.00 °"_s}, {Kind::TorqueByGoal, u"by bit 3 of Drive Mode"_s}});
        row("goals that will", x, {{torque, 0}, {u"Drive Mode"_s, 0}}, u"Drive Mode"_s, 8,
            {{Kind::TorqueByGoal, u"any goal that is written turns torque on"_s}});
        row("ID", x, {{u"ID"_s, 1}}, u"ID"_s, 7, {{Kind::ChangesPlace, u"answers as ID 7"_s}});
        row("Baud Rate", x, {{u"Baud Rate"_s, 1}}, u"Baud Rate"_s, 3, {{Kind::ChangesPlace, u"answers at 1000000 bps"_s}});
        row("Protocol Type", y, {{u"Protocol Type"_s, 2}}, u"Protocol Type"_s, 10,
            {{Kind::ChangesProtocol, u"will not find it again"_s}});
        row("answers Ping alone", x, {{u"Status Return Level"_s, 2}}, u"Status Return Level"_s, 0,
            {{Kind::AnswersLess, u"Ping alone"_s}});
        row("answers no writes", x, {{u"Status Return Level"_s, 2}}, u"Status Return Level"_s, 1,
            {{Kind::AnswersLess, u"no longer answers writes"_s}});
        row("answers again", x, {{u"Status Return Level"_s, 1}}, u"Status Return Level"_s, 2, {});
        row("Shutdown", x, {{u"Shutdown"_s, 52}}, u"Shutdown"_s, 16, {{Kind::LosesProtection, u"Overheating, Overload"_s}});
        row("more Shutdown", x, {{u"Shutdown"_s, 52}}, u"Shutdown"_s, 53, {});
        row("Startup Configuration", u"XL330-M288"_s, {{u"Startup Configuration"_s, 0}}, u"Startup Configuration"_s, 1,
            {{Kind::StartsByItself, u"Torque on at power-up"_s}});
    }
    void rows()
    {
        QFETCH(QString, model);
        QFETCH(Wanted, now);
        QFETCH(QString, field);
        QFETCH(int, raw);
        using Says = std::vector<std::pair<Kind, QString>>;
        QFETCH(Says, says);
        const ControlTablePtr table = tableOf(model);
        const RegisterLookup lookup = [&](QStringView name) -> std::optional<std::int64_t> {
            const auto at = std::ranges::find(now, name.toString(), &std::pair<QString, std::int64_t>::first);
            return at == now.end() ? std::nullopt : std::optional(at->second);
        };
        const Field *of = table->find(field);
        QVERIFY(of);
        const auto all = consequencesOf(*table, lookup, *of, raw);
        QStringList texts;
        for (const Consequence &one : all)
            texts << one.text;
        QVERIFY2(all.size() == says.size(), qPrintable(texts.join(u'\n')));
        for (std::size_t i = 0; i < all.size(); ++i) {
            QCOMPARE(static_cast<int>(all[i].kind), static_cast<int>(says[i].first));
            QVERIFY2(all[i].text.contains(says[i].second), qPrintable(all[i].text));
            QVERIFY2(all[i].text.endsWith(u'.') || all[i].text.endsWith(u")."), qPrintable(all[i].text));
        }
    }

    void whatAModeResets()
    {
        const ControlTablePtr table = tableOf(u"XM430-W350"_s);
        const std::map<QString, std::int64_t> now{{u"Operating Mode"_s, 3},      {u"Position P Gain"_s, 640},
                                                  {u"Velocity P Gain"_s, 100},   {u"Profile Velocity"_s, 200},
                                                  {u"Profile Acceleration"_s, 0}};
        const RegisterLookup lookup = [&](QStringView name) -> std::optional<std::int64_t> {
            const auto at = now.find(name.toString());
            return at == now.end() ? std::nullopt : std::optional(at->second);
        };
        const auto all = consequencesOf(*table, lookup, *table->find(u"Operating Mode"), 4);
        QCOMPARE(all.size(), 1u);
        QVERIFY(areSerious(all));
        const std::vector<ExpectedChange> &changes = all.front().registers;
        const ExpectedChange gain{u"Position P Gain"_s, 640, 800}, profile{u"Profile Velocity"_s, 200, 0};
        QVERIFY(std::ranges::find(changes, gain) != changes.end());
        QVERIFY(std::ranges::find(changes, profile) != changes.end());
        QVERIFY(std::ranges::find(changes, u"Velocity P Gain"_s, &ExpectedChange::name) == changes.end());
        QCOMPARE(changeText(*table, lookup, gain), u"Position P Gain: 640 → 800"_s);
        QCOMPARE(changeText(*table, lookup, profile), u"Profile Velocity: 45.8 rev/min → 0.0 rev/min"_s);
    }

    void inThePersonsUnits()
    {
        const ControlTablePtr table = tableOf(u"XM430-W350"_s);
        const RegisterLookup lookup = [](QStringView name) -> std::optional<std::int64_t> {
            return name == u"Goal Position"      ? std::optional<std::int64_t>(2048)
                   : name == u"Operating Mode"   ? std::optional<std::int64_t>(4)
                   : name == u"Present Position" ? std::optional<std::int64_t>(0)
                                                 : std::nullopt;
        };
        const auto all = consequencesOf(*table, lookup, *table->find(u"Torque Enable"), 1, AngleUnit::Turns);
        QCOMPARE(all.size(), 1u);
        QVERIFY2(all.front().text.contains(u"0.5"), qPrintable(all.front().text));
    }

    /// What is said of Present Position is what a servo then shows.
    void asTheServoDoes_data()
    {
        QTest::addColumn<int>("mode");
        QTest::addColumn<QString>("field");
        QTest::addColumn<int>("raw");
        for (const int mode : {3, 4}) {
            for (const int offset : {-2000, -300, 500, 1500})
                QTest::addRow("mode %d, offset %d", mode, offset) << mode << u"Homing Offset"_s << offset;
            QTest::addRow("mode %d, reverse", mode) << mode << u"Drive Mode"_s << 1;
        }
    }
    void asTheServoDoes()
    {
        QFETCH(int, mode);
        QFETCH(QString, field);
        QFETCH(int, raw);
        test::SettingsWorld world(m_catalog, u"XM430-W350@57600:1"_s);
        sim::Servo &servo = world.servo();
        servo.write(u"Operating Mode", mode);
        servo.write(u"Homing Offset", 100);
        world.bus.advanceTo(std::chrono::seconds(3));
        const RegisterLookup lookup = [&](QStringView name) { return std::optional(servo.value(name)); };
        const auto all = consequencesOf(servo.table(), lookup, *servo.table().find(field), raw);
        const auto moves = std::ranges::find(all, Kind::MovesPosition, &Consequence::kind);
        QVERIFY(moves != all.end());
        const std::int64_t expected = moves->registers.front().after.value_or(-1);
        QVERIFY(servo.write(field, raw) == DeviceError::None);
        world.bus.advanceTo(std::chrono::seconds(4));
        QVERIFY2(std::abs(servo.value(u"Present Position") - expected) <= 4,
                 qPrintable(u"%1, not %2"_s.arg(servo.value(u"Present Position")).arg(expected)));
    }

    /// Of no table and no value may it do anything but answer.
    void everyRegisterOfEveryModel()
    {
        for (const Catalog::ModelInfo &info : m_catalog.models()) {
            const ControlTablePtr table = m_catalog.find(info.modelNumber, info.newestFirmware);
            for (const std::int64_t held : {std::int64_t(0), std::int64_t(-1)}) {
                const RegisterLookup lookup = [held](QStringView) { return std::optional(held); };
                for (const Field &field : table->fields()) {
                    for (const std::int64_t raw : {smallestRaw(field), largestRaw(field)}) {
                        for (const Consequence &one : consequencesOf(*table, lookup, field, raw))
                            QVERIFY(!one.text.isEmpty() && !one.text.contains(u'%' + QString::number(1)));
                    }
                }
            }
        }
    }

private:
    ControlTablePtr tableOf(const QString &model) const
    {
        const Catalog::ModelInfo *info = m_catalog.model(model);
        if (!info)
            qFatal("no %s", qPrintable(model));
        return m_catalog.find(info->modelNumber, info->newestFirmware);
    }
    const Catalog m_catalog = test::builtInCatalog();
};

DYNASCOPE_CORE_TEST(TestConsequences)
#include "tst_consequences.moc"
