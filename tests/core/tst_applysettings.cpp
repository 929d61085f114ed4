// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/settings/readimages.h"
#include "core/session/settings/settingsjournal.h"
#include "tests/support/builtincatalog.h"
#include "tests/support/settingsworld.h"
#include "tests/support/testmain.h"

using namespace dynascope;
using namespace Qt::StringLiterals;
using test::SettingsWorld, test::Wanted;

namespace {

const auto XM430 = u"XM430-W350@57600:1"_s, XL320 = u"XL-320@1000000:1"_s, Pro = u"H54-100-S500-R@57600:1"_s,
           Y = u"YM070-210-M001-RH@57600:1"_s;

} // namespace

/// Settings brought to simulated servos, in virtual time, with every packet counted.
class TestApplySettings : public QObject
{
    Q_OBJECT

private slots:
    void writesWhatDiffers_data()
    {
        QTest::addColumn<QString>("servo");
        QTest::addColumn<Wanted>("wanted");
        QTest::addColumn<bool>("keepResets");
        QTest::addColumn<QStringList>("writes");
        QTest::newRow("all the same") << XM430 << Wanted{{u"Operating Mode"_s, 3}, {u"Position P Gain"_s, 800}} << false
                                      << QStringList();
        QTest::newRow("one of three") << XM430
                                      << Wanted{{u"Operating Mode"_s, 3}, {u"Position P Gain"_s, 700}, {u"LED"_s, 0}}
                                      << false << QStringList{u"84=700"_s};
        QTest::newRow("EEPROM, then RAM") << XM430 << Wanted{{u"LED"_s, 1}, {u"Homing Offset"_s, -5}} << false
                                          << QStringList{u"20=4294967291"_s, u"65=1"_s};
        QTest::newRow("a gain that its mode resets and that is right already")
            << XM430 << Wanted{{u"Position P Gain"_s, 777}, {u"Operating Mode"_s, 4}} << false
            << QStringList{u"11=4"_s, u"84=777"_s};
        QTest::newRow("a gain that nobody wants is reset")
            << XM430 << Wanted{{u"Operating Mode"_s, 4}} << false << QStringList{u"11=4"_s};
        QTest::newRow("and kept where that is asked for")
            << XM430 << Wanted{{u"Operating Mode"_s, 4}} << true << QStringList{u"11=4"_s, u"84=777"_s};
        QTest::newRow("nothing to be kept") << XM430 << Wanted{{u"Operating Mode"_s, 3}} << true << QStringList();
        QTest::newRow("a limit, then what was beyond it")
            << XM430 << Wanted{{u"Goal Velocity"_s, 300}, {u"Velocity Limit"_s, 310}} << false
            << QStringList{u"44=310"_s, u"104=300"_s};
        QTest::newRow("XL-320") << XL320 << Wanted{{u"P Gain"_s, 40}, {u"Control Mode"_s, 1}, {u"Max Torque"_s, 1000}}
                                << false << QStringList{u"11=1"_s, u"15=1000"_s, u"29=40"_s};
        QTest::newRow("PRO") << Pro << Wanted{{u"Position P Gain"_s, 33}, {u"Velocity Limit"_s, 9000}} << false
                             << QStringList{u"32=9000"_s, u"594=33"_s};
        QTest::newRow("Y") << Y << Wanted{{u"Position P Gain"_s, 33}, {u"Velocity Limit"_s, 500}} << false
                           << QStringList{u"72=500"_s, u"232=33"_s};
        QTest::newRow("no answers to writes from then on")
            << XM430 << Wanted{{u"Status Return Level"_s, 1}, {u"Return Delay Time"_s, 254}, {u"LED"_s, 1}} << false
            << QStringList{u"9=254"_s, u"65=1"_s, u"68=1"_s};
    }
    void writesWhatDiffers()
    {
        QFETCH(QString, servo);
        QFETCH(Wanted, wanted);
        QFETCH(bool, keepResets);
        QFETCH(QStringList, writes);
        SettingsWorld world(m_catalog, servo);
        if (servo == XM430) {
            for (const auto &[name, raw] : Wanted{{u"Velocity Limit"_s, 200}, {u"Return Delay Time"_s, 0}})
                QVERIFY(world.servo().write(name, raw) == DeviceError::None);
            if (wanted.size() < 3 && !wanted.empty() && writes != QStringList())
                QVERIFY(world.servo().write(u"Position P Gain", 777) == DeviceError::None);
        }
        SettingsOptions options;
        options.keepResets = keepResets;
        const auto plan = test::planFor(world.servo(), wanted, options);
        QVERIFY2(plan, plan ? "" : qPrintable(plan.error().text));
        const auto first = world.apply(*plan);
        QVERIFY2(first, first ? "" : qPrintable(first.error().text));
        QVERIFY(first->isDone());
        QCOMPARE(world.writes(), writes);
        QCOMPARE(first->count(SettingState::Written), static_cast<std::size_t>(writes.size()));
        for (const auto &[name, raw] : wanted)
            QCOMPARE(world.servo().value(name), raw);
        QVERIFY(!first->torqueTurnedOff);
        const auto second = world.apply(*plan);
        QVERIFY2(second, second ? "" : qPrintable(second.error().text));
        QVERIFY(second->isDone());
        QCOMPARE(world.writes(), QStringList());
        QCOMPARE(second->count(SettingState::Same), plan->steps.size());
    }

    void aDryRunWritesNothing()
    {
        SettingsWorld world(m_catalog, XM430);
        SettingsOptions options;
        options.compareOnly = true;
        QVERIFY(world.servo().write(u"Torque Enable", 1) == DeviceError::None);
        const auto plan = test::planFor(
            world.servo(), {{u"LED"_s, 1}, {u"Position P Gain"_s, 800}, {u"Current Limit"_s, 100}}, options);
        QVERIFY(plan);
        const auto outcome = world.apply(*plan);
        QVERIFY(outcome);
        QCOMPARE(world.writes(), QStringList());
        QCOMPARE(outcome->count(SettingState::Differs), 2u);
        QCOMPARE(outcome->count(SettingState::Same), 1u);
        QVERIFY(outcome->hadTorque && outcome->needsTorqueOff && !outcome->moves);
        QVERIFY(outcome->missing == Consent::TorqueOff);
        QVERIFY(!outcome->isDone());
    }

    void torque_data()
    {
        QTest::addColumn<QString>("servo");
        QTest::addColumn<QString>("locked");
        QTest::addColumn<int>("value");
        QTest::addColumn<QString>("torqueOff"); ///< as on the wire
        QTest::newRow("XM430") << XM430 << u"Current Limit"_s << 500 << u"64=0"_s;
        QTest::newRow("XL-320") << XL320 << u"Max Torque"_s << 1000 << u"24=0"_s;
        QTest::newRow("PRO") << Pro << u"Velocity Limit"_s << 9000 << u"562=0"_s;
        QTest::newRow("Y") << Y << u"Velocity Limit"_s << 500 << u"512=0"_s;
    }
    void torque()
    {
        QFETCH(QString, servo);
        QFETCH(QString, locked);
        QFETCH(int, value);
        QFETCH(QString, torqueOff);
        const QString on = QString(torqueOff).replace(u"=0"_s, u"=1"_s);
        for (const bool mayTurnOff : {false, true}) {
            for (const bool putBack : {false, true}) {
                SettingsWorld world(m_catalog, servo);
                world.servo().write(u"Torque Enable", 1);
                SettingsOptions options;
                options.mayTurnTorqueOff = mayTurnOff;
                options.putTorqueBack = putBack;
                const std::int64_t former = world.servo().value(locked);
                QVERIFY(former != value);
                const auto plan = test::planFor(world.servo(), {{locked, value}}, options);
                QVERIFY2(plan, plan ? "" : qPrintable(plan.error().text));
                const auto outcome = world.apply(*plan);
                QVERIFY2(outcome, outcome ? "" : qPrintable(outcome.error().text));
                QCOMPARE(world.servo().value(locked), mayTurnOff ? value : former);
                QCOMPARE(outcome->isDone(), mayTurnOff);
                QCOMPARE(outcome->torqueTurnedOff, mayTurnOff);
                QCOMPARE(world.servo().value(u"Torque Enable"), !mayTurnOff || putBack ? 1 : 0);
                QCOMPARE(outcome->torqueStaysOff(), mayTurnOff && !putBack);
                if (!mayTurnOff) {
                    QVERIFY(outcome->missing == Consent::TorqueOff);
                    QCOMPARE(world.writes(), QStringList());
                    continue;
                }
                QCOMPARE(world.writes().first(), torqueOff);
                QCOMPARE(world.writes().last() == on, putBack);
                if (putBack) {
                    const auto away =
                        world.servo().value(u"Goal Position") - world.servo().value(u"Present Position");
                    QVERIFY2(std::abs(away) <= std::abs(world.servo().value(u"Present Position")) / 20 + 20,
                             qPrintable(QString::number(away)));
                }
            }
        }
    }

    /// The goal that would make it run is 0 before torque comes on, whatever it was.
    void theGoalOfAWheelRests_data()
    {
        QTest::addColumn<QString>("servo");
        QTest::addColumn<QString>("mode");
        QTest::addColumn<int>("number");
        QTest::addColumn<QString>("goal");
        QTest::newRow("velocity") << XM430 << u"Operating Mode"_s << 1 << u"Goal Velocity"_s;
        QTest::newRow("current") << XM430 << u"Operating Mode"_s << 0 << u"Goal Current"_s;
        QTest::newRow("PWM") << XM430 << u"Operating Mode"_s << 16 << u"Goal PWM"_s;
        QTest::newRow("XL-320, wheel") << XL320 << u"Control Mode"_s << 1 << u"Moving Speed"_s;
        QTest::newRow("PRO, torque") << Pro << u"Operating Mode"_s << 0 << u"Goal Torque"_s;
        QTest::newRow("Y, velocity") << Y << u"Operating Mode"_s << 1 << u"Goal Velocity"_s;
    }
    void theGoalOfAWheelRests()
    {
        QFETCH(QString, servo);
        QFETCH(QString, mode);
        QFETCH(int, number);
        QFETCH(QString, goal);
        SettingsWorld world(m_catalog, servo);
        QVERIFY(world.servo().write(mode, number) == DeviceError::None);
        world.servo().write(u"Torque Enable", 1);
        QVERIFY(world.servo().write(goal, 20) == DeviceError::None);
        SettingsOptions options;
        options.mayTurnTorqueOff = options.putTorqueBack = true;
        const auto plan = test::planFor(world.servo(), {{u"Return Delay Time"_s, 10}}, options);
        const auto outcome = world.apply(*plan);
        QVERIFY2(outcome, outcome ? "" : qPrintable(outcome.error().text));
        QVERIFY2(outcome->torqueIsBack, qPrintable(outcome->torqueNote));
        QCOMPARE(world.servo().value(goal), 0);
        QCOMPARE(world.servo().value(u"Torque Enable"), 1);
    }

    /// Torque does not come back to a device that was not left as it was wanted, nor to one that had none.
    void torqueStaysOff()
    {
        SettingsWorld world(m_catalog, XM430);
        SettingsOptions options;
        options.mayTurnTorqueOff = options.putTorqueBack = true;
        const auto plan = test::planFor(world.servo(), {{u"Return Delay Time"_s, 10}, {u"LED"_s, 1}}, options);
        QVERIFY(world.apply(*plan));
        QCOMPARE(world.servo().value(u"Torque Enable"), 0);
        QCOMPARE(world.servo().value(u"LED"), 1);

        world.servo().write(u"Torque Enable", 1);
        const auto beyond = test::planFor(world.servo(), {{u"Return Delay Time"_s, 20}, {u"Goal PWM"_s, 600}}, options);
        test::MortalLine line(world.bus, 57600, 2);
        line.setBefore([&] { world.servo().write(u"PWM Limit", 100); }); // somebody else's
        const auto outcome = world.apply(line, *beyond);
        QVERIFY2(outcome, outcome ? "" : qPrintable(outcome.error().text));
        QCOMPARE(outcome->count(SettingState::Failed), 1u);
        QVERIFY(outcome->torqueStaysOff());
        QVERIFY2(outcome->torqueNote.contains(u"not everything could be written"), qPrintable(outcome->torqueNote));
        QCOMPARE(world.servo().value(u"Torque Enable"), 0);
    }

    /// A person's order, with or without anything else to be set.
    void torqueOnAtRest()
    {
        for (const Wanted &wanted : {Wanted(), Wanted{{u"LED"_s, 1}}}) {
            SettingsWorld world(m_catalog, XM430);
            world.servo().settings().goalOnTorqueOn = sim::ServoSettings::GoalOnTorqueOn::Stays;
            world.servo().write(u"Goal Position", 1000);
            const std::int64_t present = world.servo().value(u"Present Position");
            SettingsOptions options;
            options.turnTorqueOn = true;
            const auto plan = test::planFor(world.servo(), wanted, options);
            const auto outcome = world.apply(*plan);
            QVERIFY2(outcome && outcome->isDone() && outcome->torqueIsBack, outcome ? "" : qPrintable(outcome.error().text));
            QCOMPARE(world.servo().value(u"Torque Enable"), 1);
            QVERIFY(std::abs(world.servo().value(u"Goal Position") - present) < 20);
            QVERIFY(world.apply(*plan));
            QCOMPARE(world.writes(), QStringList()); // it is on
        }
    }

    /// Drive Mode bit 3: a goal that is written turns torque on.
    void aGoalThatTurnsTorqueOn()
    {
        for (const bool had : {false, true}) {
            SettingsWorld world(m_catalog, XM430);
            QVERIFY(world.servo().write(u"Drive Mode", 8) == DeviceError::None);
            if (had)
                world.servo().write(u"Torque Enable", 1);
            SettingsOptions options;
            options.mayTurnTorqueOff = true;
            const auto plan =
                test::planFor(world.servo(), {{u"Homing Offset"_s, 100}, {u"Goal Position"_s, 1000}}, options);
            const auto outcome = world.apply(*plan);
            QVERIFY2(outcome, outcome ? "" : qPrintable(outcome.error().text));
            QCOMPARE(outcome->count(SettingState::Left), 1u);
            QVERIFY(outcome->results.back().why.contains(u"would turn torque on"));
            QCOMPARE(world.servo().value(u"Torque Enable"), 0);
            QCOMPARE(world.servo().value(u"Homing Offset"), 100);
        }
    }

    /// The bit itself comes before the goal.
    void theBitIsWrittenFirst()
    {
        SettingsWorld world(m_catalog, XM430);
        const auto plan = test::planFor(world.servo(), {{u"Drive Mode"_s, 8}, {u"Goal Position"_s, 1000}});
        const auto outcome = world.apply(*plan);
        QVERIFY(outcome && outcome->count(SettingState::Left) == 1);
        QCOMPARE(world.servo().value(u"Drive Mode"), 8);
        QCOMPARE(world.servo().value(u"Torque Enable"), 0);
    }

    void goalsUnderTorque()
    {
        for (const bool mayMove : {false, true}) {
            SettingsWorld world(m_catalog, XM430);
            world.servo().write(u"Torque Enable", 1);
            SettingsOptions options;
            options.mayMove = mayMove;
            const auto plan = test::planFor(world.servo(), {{u"Goal Position"_s, 1000}, {u"LED"_s, 1}}, options);
            const auto outcome = world.apply(*plan);
            QVERIFY(outcome);
            QVERIFY(outcome->missing == (mayMove ? Consent::None : Consent::Motion));
            QCOMPARE(world.servo().value(u"LED"), mayMove ? 1 : 0);
            QCOMPARE(world.servo().value(u"Goal Position") == 1000, mayMove);
        }
    }

    /// A wanted goal gives way to one that lets it rest.
    void aWantedGoalAndTorqueThatComesBack()
    {
        SettingsWorld world(m_catalog, XM430);
        world.servo().write(u"Torque Enable", 1);
        const std::int64_t present = world.servo().value(u"Present Position");
        SettingsOptions options;
        options.mayTurnTorqueOff = options.putTorqueBack = options.mayMove = true;
        const auto plan =
            test::planFor(world.servo(), {{u"Goal Position"_s, 1000}, {u"Return Delay Time"_s, 20}}, options);
        const auto outcome = world.apply(*plan);
        QVERIFY(outcome && outcome->torqueIsBack);
        QCOMPARE(outcome->count(SettingState::Left), 1u);
        QVERIFY(std::abs(world.servo().value(u"Goal Position") - present) < 20);
    }

    void refusedBeforeTheFirstWrite_data()
    {
        QTest::addColumn<QString>("obstacle");
        QTest::addColumn<QString>("says");
        QTest::newRow("another model") << u"model"_s << u"Another model answers as ID 1 at 57600 bps"_s;
        QTest::newRow("another firmware") << u"firmware"_s << u"has firmware"_s;
        QTest::newRow("gone") << u"gone"_s << u"1"_s;
        QTest::newRow("beyond a limit that it has") << u"limit"_s << u"Goal Velocity can be -200 to 200, not 300"_s;
        QTest::newRow("beyond the range of its mode") << u"mode"_s << u"Goal Position can be 0 to 4095, not 5000"_s;
    }
    void refusedBeforeTheFirstWrite()
    {
        QFETCH(QString, obstacle);
        QFETCH(QString, says);
        SettingsWorld world(m_catalog, obstacle == u"model" ? u"XL430-W250@57600:1"_s : XM430);
        world.servo().write(u"Velocity Limit", 200);
        SettingsWorld other(m_catalog, XM430);
        Wanted wanted{{u"LED"_s, 1}};
        if (obstacle == u"limit")
            wanted.emplace_back(u"Goal Velocity"_s, 300);
        if (obstacle == u"mode")
            wanted.emplace_back(u"Goal Position"_s, 5000);
        auto plan = test::planFor(other.servo(), wanted);
        QVERIFY2(plan, plan ? "" : qPrintable(plan.error().text));
        if (obstacle == u"firmware")
            --plan->firmware;
        if (obstacle == u"gone")
            world.servo().setPlugged(false);
        const auto outcome = world.apply(*plan);
        QVERIFY(!outcome);
        QVERIFY2(outcome.error().text.contains(says), qPrintable(outcome.error().text));
        QCOMPARE(world.writes(), QStringList());
    }

    /// A mode that is wanted decides what its goal may be.
    void theRangeOfTheModeToCome()
    {
        SettingsWorld world(m_catalog, XM430);
        const auto plan = test::planFor(world.servo(), {{u"Goal Position"_s, 5000}, {u"Operating Mode"_s, 4}});
        QVERIFY(plan);
        const auto outcome = world.apply(*plan);
        QVERIFY2(outcome && outcome->isDone(), outcome ? "" : qPrintable(outcome.error().text));
        QCOMPARE(world.servo().value(u"Goal Position"), 5000);
    }

    /// Each write is told before and after, with what it changed besides.
    void hooks()
    {
        SettingsWorld world(m_catalog, XM430);
        world.servo().write(u"Torque Enable", 1);
        SettingsOptions options;
        options.mayTurnTorqueOff = options.putTorqueBack = options.keepResets = true;
        QVERIFY(world.servo().write(u"Position P Gain", 777) == DeviceError::None);
        const auto plan = test::planFor(world.servo(), {{u"Operating Mode"_s, 4}}, options);
        QStringList told;
        SettingsHooks hooks;
        hooks.begun = [&](const SettingsWrite &write) {
            told << u"%1 %2->%3"_s.arg(write.name)
                        .arg(RegisterImage::numberOf(write.where, write.before))
                        .arg(RegisterImage::numberOf(write.where, write.to));
        };
        hooks.ended = [&](const SettingsWrite &write, std::span<const PollValue> before,
                          const Result<std::vector<PollValue>> &after) {
            QVERIFY(after);
            QCOMPARE(before.front().address, write.where.address);
            QCOMPARE(before.front().data, write.before);
            QCOMPARE(after->front().data, write.to);
            if (write.name == u"Operating Mode") {
                RegisterImage old, now;
                old.take(before);
                now.take(*after);
                const RegisterPlace gain{84, 2};
                QCOMPARE(old.number(gain).value_or(-1), 777);
                QCOMPARE(now.number(gain).value_or(-1), 800);
            }
        };
        const auto outcome = world.apply(*plan, hooks);
        QVERIFY(outcome && outcome->torqueIsBack);
        QCOMPARE(told.first(), u"Torque Enable 1->0"_s);
        QCOMPARE(told.last(), u"Torque Enable 0->1"_s);
        QVERIFY(told.contains(u"Operating Mode 3->4"_s));
        QVERIFY(told.contains(u"Position P Gain 800->777"_s));
        QCOMPARE(told.size(), world.writes().size());
    }

    /// As the journal has it, the mode's entry with what it reset.
    void inTheJournal()
    {
        SettingsWorld world(m_catalog, XM430);
        world.servo().write(u"Torque Enable", 1);
        QVERIFY(world.servo().write(u"Position P Gain", 777) == DeviceError::None);
        SettingsOptions options;
        options.mayTurnTorqueOff = true;
        const auto plan = test::planFor(world.servo(), {{u"Operating Mode"_s, 4}, {u"LED"_s, 1}}, options);
        Journal journal;
        JournalEntry as;
        as.by = JournalAuthor::Profile;
        const auto table = std::make_shared<const ControlTable>(world.servo().table());
        QVERIFY(world.apply(*plan, noted(&journal, as, table)));
        QCOMPARE(journal.entries().size(), 3u);
        for (const JournalEntry &entry : journal.entries()) {
            QCOMPARE(entry.state, JournalState::Done);
            QCOMPARE(entry.by, JournalAuthor::Profile);
        }
        const JournalEntry &mode = journal.entries()[1];
        QCOMPARE(mode.changes.front().name, u"Operating Mode"_s);
        QCOMPARE(mode.changes.front().before, Bytes{3});
        const auto gain = std::ranges::find(mode.changes, u"Position P Gain"_s, &RegisterChange::name);
        QVERIFY(gain != mode.changes.end());
        QCOMPARE(gain->before, (Bytes{9, 3}));
        QCOMPARE(gain->after, (Bytes{32, 3}));
    }

    /// Twenty servos are compared in a few exchanges, near what the wire allows.
    void imagesOfMany()
    {
        QStringList servos;
        for (int id = 1; id <= 20; ++id)
            servos << u"XM430-W350@1000000:%1"_s.arg(id);
        SettingsWorld world(m_catalog, servos.join(u','));
        std::vector<ReadSpansPlan> reads;
        std::vector<SettingsPlan> plans;
        std::vector<Traits> traits;
        for (sim::Servo *servo : world.all) {
            servo->write(u"Return Delay Time", 0);
            if (servo->id() == 7)
                servo->write(u"Current Limit", 300);
            plans.push_back(*test::planFor(
                *servo, {{u"Return Delay Time"_s, 0}, {u"Current Limit"_s, 1193}, {u"Position P Gain"_s, 800}}));
            reads.push_back({plans.back().place, plans.back().reads});
            Traits one{};
            one.id = plans.back().place.id;
            one.baudRate = 1'000'000;
            one.returnDelay = std::chrono::microseconds(8);
            one.fastReads = servo->table().hasFastReads(servo->firmware());
            traits.push_back(one);
        }
        world.all[11]->setPlugged(false);
        test::MortalLine line(world.bus, 1'000'000);
        Bus program(line);
        program.setTraits(traits);
        DirectContext context(program);
        auto images = readImages(context, reads);
        QVERIFY(images);
        QCOMPARE(images->size(), 20u);
        for (std::size_t i = 0; i < 20; ++i) {
            QCOMPARE((*images)[i].has_value(), i != 11);
            if (i == 11)
                continue;
            QVERIFY(checkIdentity(plans[i], *(*images)[i]));
            QCOMPARE(compareSettings(plans[i], *(*images)[i]).count(SettingState::Differs), i == 6 ? 1u : 0u);
        }
        world.all[11]->setPlugged(true);
        line.advance(std::chrono::seconds(1));
        world.bus.advanceTo(line.now());
        world.bus.setLogging(true);
        const LineTime begin = line.now();
        images = readImages(context, reads);
        QVERIFY(images);
        QVERIFY(std::ranges::all_of(*images, [](const auto &one) { return one.has_value(); }));
        LineTime wire{};
        for (const sim::WireEntry &entry : world.bus.log())
            wire += entry.end - entry.begin;
        const double ratio = std::chrono::duration<double>(wire) / std::chrono::duration<double>(line.now() - begin);
        qInfo("20 servos at 1 Mbps: %.2f ms, of which packets %.2f ms, ratio %.3f, %zu packets",
              std::chrono::duration<double, std::milli>(line.now() - begin).count(),
              std::chrono::duration<double, std::milli>(wire).count(), ratio, world.bus.log().size());
        QVERIFY2(ratio > 0.8, qPrintable(QString::number(ratio)));
    }

    void imagesOfSeveralModelsAndRates()
    {
        SettingsWorld world(m_catalog, u"XM430-W350@57600:1,XL-320@1000000:2,H54-100-S500-R@57600:3"_s);
        std::vector<ReadSpansPlan> reads;
        std::vector<SettingsPlan> plans;
        for (sim::Servo *servo : world.all) {
            plans.push_back(*test::planFor(*servo, {{u"Return Delay Time"_s, 250}}));
            reads.push_back({plans.back().place, plans.back().reads});
        }
        test::MortalLine line(world.bus, 57600);
        Bus program(line);
        DirectContext context(program);
        const auto images = readImages(context, reads);
        QVERIFY(images);
        for (std::size_t i = 0; i < 3; ++i) {
            QVERIFY2((*images)[i], (*images)[i] ? "" : qPrintable((*images)[i].error().text));
            QVERIFY(checkIdentity(plans[i], *(*images)[i]));
            QCOMPARE(compareSettings(plans[i], *(*images)[i]).count(SettingState::Same), 1u);
        }
        QCOMPARE(line.baudRate(), 57600);
    }

private:
    const Catalog m_catalog = test::builtInCatalog();
};

DYNASCOPE_CORE_TEST(TestApplySettings)
#include "tst_applysettings.moc"
