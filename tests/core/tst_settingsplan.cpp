// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/builtincatalog.h"
#include "tests/support/settingsworld.h"
#include "tests/support/testmain.h"

using namespace dynascope;
using namespace Qt::StringLiterals;
using test::Wanted;

/// What is written in which order, and what no plan writes.
class TestSettingsPlan : public QObject
{
    Q_OBJECT

private slots:
    void order_data()
    {
        QTest::addColumn<int>("model");
        QTest::addColumn<Wanted>("wanted");
        QTest::addColumn<bool>("keepResets");
        QTest::addColumn<QStringList>("steps");
        QTest::newRow("mode before gains, EEPROM before RAM, goals and Status Return Level last")
            << 1020
            << Wanted{{u"Status Return Level"_s, 1},  {u"Goal Position"_s, 2000},  {u"Position P Gain"_s, 700},
                      {u"Bus Watchdog"_s, 50},        {u"LED"_s, 1},               {u"Profile Velocity"_s, 100},
                      {u"Max Position Limit"_s, 3000}, {u"Operating Mode"_s, 3},   {u"Drive Mode"_s, 4},
                      {u"Goal PWM"_s, 500}}
            << false
            << QStringList{u"Drive Mode"_s,      u"Operating Mode"_s, u"Max Position Limit"_s, u"LED"_s,
                           u"Position P Gain"_s, u"Profile Velocity"_s, u"Goal PWM"_s, u"Goal Position"_s,
                           u"Bus Watchdog"_s,    u"Status Return Level"_s};
        QTest::newRow("what a mode resets is put back behind it")
            << 1020 << Wanted{{u"Operating Mode"_s, 4}, {u"Position P Gain"_s, 700}} << true
            << QStringList{u"Operating Mode"_s,    u"Velocity I Gain"_s,  u"Velocity P Gain"_s,
                           u"Position D Gain"_s,   u"Position I Gain"_s,  u"Position P Gain"_s,
                           u"Feedforward 2nd Gain"_s, u"Feedforward 1st Gain"_s, u"Profile Acceleration"_s,
                           u"Profile Velocity"_s,  u"Goal PWM"_s,         u"Goal Current"_s};
        QTest::newRow("PRO: limits before goals")
            << 53768 << Wanted{{u"Goal Velocity"_s, 100}, {u"Velocity Limit"_s, 5000}, {u"Goal Torque"_s, 1},
                               {u"Torque Limit"_s, 100}}
            << false
            << QStringList{u"Torque Limit"_s, u"Velocity Limit"_s, u"Goal Velocity"_s, u"Goal Torque"_s};
        QTest::newRow("Y: a stored limit before the RAM that it bounds")
            << 4030 << Wanted{{u"Profile Velocity"_s, 100}, {u"Velocity Limit"_s, 2000}, {u"Operating Mode"_s, 3}}
            << false << QStringList{u"Operating Mode"_s, u"Velocity Limit"_s, u"Profile Velocity"_s};
    }
    void order()
    {
        QFETCH(int, model);
        QFETCH(Wanted, wanted);
        QFETCH(bool, keepResets);
        QFETCH(QStringList, steps);
        SettingsOptions options;
        options.keepResets = keepResets;
        const auto plan = planned(model, wanted, options);
        QVERIFY2(plan, plan ? "" : qPrintable(plan.error().text));
        QStringList names;
        for (const SettingsStep &step : plan->steps) {
            names << step.name;
            const bool isWanted =
                std::ranges::any_of(wanted, [&](const auto &one) { return one.first == step.name; });
            QCOMPARE(step.isKept, !isWanted);
            QCOMPARE(step.to.empty(), step.isKept);
        }
        QCOMPARE(names, steps);
    }

    void refused_data()
    {
        QTest::addColumn<int>("model");
        QTest::addColumn<Wanted>("wanted");
        QTest::addColumn<QString>("says");
        const auto row = [](const char *name, const Wanted &wanted, const QString &says, int model = 1020) {
            QTest::newRow(name) << model << wanted << says;
        };
        row("ID", {{u"ID"_s, 9}}, u"ID is not changed among other settings"_s);
        row("its own ID", {{u"ID"_s, 1}}, {});
        row("Baud Rate", {{u"Baud Rate"_s, 3}}, u"Baud Rate is not changed among other settings"_s);
        row("its own Baud Rate", {{u"Baud Rate"_s, 1}}, {});
        row("Protocol Type", {{u"Protocol Type"_s, 10}}, u"Protocol Type stays at Protocol 2.0"_s, 4030);
        row("its own Protocol Type", {{u"Protocol Type"_s, 2}}, {});
        row("Ping alone", {{u"Status Return Level"_s, 0}}, u"Status Return Level 0"_s);
        row("torque on", {{u"Torque Enable"_s, 1}}, u"Torque Enable is no setting"_s);
        row("torque off", {{u"Torque Enable"_s, 0}}, u"Torque Enable is no setting"_s);
        row("Hybrid Save", {{u"Hybrid Save"_s, 1}}, u"Hybrid Save is an order"_s, 4030);
        row("Indirect Data", {{u"Indirect Data 1"_s, 1}}, u"Indirect Data 1 leads to another register"_s);
        row("Secondary ID of another", {{u"Secondary ID"_s, 7}}, u"Secondary ID 7 is the ID of a device"_s);
        row("Secondary ID, its own ID", {{u"Secondary ID"_s, 1}}, u"Secondary ID 1 is the ID of a device"_s);
        row("Secondary ID that is free", {{u"Secondary ID"_s, 8}}, {});
        row("Secondary ID off", {{u"Secondary ID"_s, 255}}, {});
        row("read-only", {{u"Present Position"_s, 1}}, u"Present Position can only be read"_s);
        row("twice", {{u"LED"_s, 1}, {u"LED"_s, 0}}, u"LED is wanted twice"_s);
        row("beyond its size", {{u"LED"_s, 256}}, u"256 does not fit into LED"_s);
        row("negative", {{u"LED"_s, -1}}, u"-1 does not fit into LED"_s);
        row("no such value", {{u"Operating Mode"_s, 2}}, u"Operating Mode has no value 2"_s);
        row("beyond its range", {{u"Current Limit"_s, 2000}}, u"Current Limit can be 0 to"_s);
        row("beyond a limit that is wanted, too", {{u"Velocity Limit"_s, 100}, {u"Goal Velocity"_s, -101}},
            u"Goal Velocity can be -100 to 100, not -101"_s);
        row("within a limit that is wanted, too", {{u"Velocity Limit"_s, 100}, {u"Goal Velocity"_s, -100}}, {});
        row("by the profile that is wanted", {{u"Drive Mode"_s, 4}, {u"Profile Velocity"_s, 32767}},
            u"Profile Velocity can be 0 to 32737, not 32767"_s);
        row("by a profile that nobody knows yet", {{u"Profile Velocity"_s, 32767}}, {});
        row("unknown model", {}, u"the registers of this model are not known"_s, 9999);
    }
    void refused()
    {
        QFETCH(int, model);
        QFETCH(Wanted, wanted);
        QFETCH(QString, says);
        SettingsOptions options;
        options.otherIds = {7};
        const auto plan = planned(model, wanted, options);
        QCOMPARE(plan.has_value(), says.isEmpty());
        if (!plan) {
            QVERIFY2(plan.error().text.contains(says), qPrintable(plan.error().text));
            QVERIFY2(plan.error().text.endsWith(u"nothing was written"), qPrintable(plan.error().text));
        }
    }

    void noSuchRegister()
    {
        const ControlTablePtr table = m_catalog.find(1020, 45);
        for (const int field : {-1, static_cast<int>(table->fields().size())})
            QVERIFY(!planSettings(*table, {}, 45, {{field, 0}}, {}));
    }

    /// Everything that a model lets be written can be planned at once, whatever the table.
    void everyModel()
    {
        for (const Catalog::ModelInfo &info : m_catalog.models()) {
            const ControlTablePtr table = m_catalog.find(info.modelNumber, info.newestFirmware);
            DevicePlace place;
            place.id = 1;
            SettingsOptions options;
            options.keepResets = true;
            std::vector<WantedSetting> all;
            for (int i = 0; i < static_cast<int>(table->fields().size()); ++i) {
                const auto initial = table->fields()[static_cast<std::size_t>(i)].initial;
                const WantedSetting one{i, initial.value_or(0)};
                if (initial && settingProblem(*table, place, one, options).isEmpty())
                    all.push_back(one);
            }
            if (info.addressesOnly) {
                QVERIFY(all.empty());
                continue;
            }
            QVERIFY(!all.empty());
            const auto plan = planSettings(*table, place, info.newestFirmware, all, options);
            QVERIFY2(plan, qPrintable(info.model + u": "_s + (plan ? QString() : plan.error().text)));
            std::set<std::uint16_t> seen;
            for (const SettingsStep &step : plan->steps)
                QVERIFY2(seen.insert(step.where.address).second, qPrintable(info.model + step.name));
        }
    }

private:
    Result<SettingsPlan> planned(int model, const Wanted &wanted, const SettingsOptions &options) const
    {
        const int newest = m_catalog.model(model) ? m_catalog.model(model)->newestFirmware : 1;
        const ControlTablePtr table = m_catalog.findOrRaw(model, newest);
        DevicePlace place;
        place.id = 1;
        place.name = u"it"_s;
        return planSettings(*table, place, newest, test::wantedOf(*table, wanted), options);
    }
    const Catalog m_catalog = test::builtInCatalog();
};

DYNASCOPE_CORE_TEST(TestSettingsPlan)
#include "tst_settingsplan.moc"
