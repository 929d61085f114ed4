// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/commissioning/fromprofile.h"
#include "tests/support/builtincatalog.h"
#include "tests/support/testmain.h"

using namespace dynascope;
using namespace Qt::StringLiterals;

/// What a list of joints may hold, and what becomes of it on paper.
class TestCommissionList : public QObject
{
    Q_OBJECT

private slots:
    void lists_data()
    {
        QTest::addColumn<std::vector<CommissionJoint>>("joints");
        QTest::addColumn<QString>("says");
        const auto joint = [](const char *name, int id, int rate = 1'000'000, int model = 1020) {
            return CommissionJoint{QString::fromLatin1(name), model, 0, {rate, id}, {}};
        };
        const auto with = [&](const QString &name, std::int64_t raw) {
            CommissionJoint one = joint("shoulder", 11);
            one.settings = {{name, raw}};
            return std::vector{one};
        };
        using Joints = std::vector<CommissionJoint>;
        QTest::newRow("fine") << Joints{joint("shoulder", 11), joint("elbow", 12)} << QString();
        QTest::newRow("none") << Joints{} << u"1 to 253"_s;
        QTest::newRow("a place twice") << Joints{joint("a", 11), joint("b", 11)} << u"ID 11 at 1000000 bps is wanted"_s;
        QTest::newRow("a name twice") << Joints{joint("a", 11), joint("a", 12)} << u"Two joints have the name a"_s;
        QTest::newRow("no such ID") << Joints{joint("a", 253)} << u"an ID is 0 to 252"_s;
        QTest::newRow("no such model") << Joints{joint("a", 1, 57600, 60000)} << u"model 60000 is not known"_s;
        QTest::newRow("no such rate") << Joints{joint("a", 1, 10'500'000)} << u"does not offer 10500000 bps"_s;
        QTest::newRow("no such register") << with(u"Goal Sunshine"_s, 1) << u"no register Goal Sunshine"_s;
        QTest::newRow("no such value") << with(u"Operating Mode"_s, 99) << u"Operating Mode"_s;
        QTest::newRow("read only") << with(u"Present Position"_s, 1) << u"can only be read"_s;
        QTest::newRow("its own matter") << with(u"ID"_s, 5) << u"ID is not changed among other settings"_s;
        QTest::newRow("a name of two lines") << Joints{joint("a\nb", 11)} << u"one line"_s;
    }
    void lists()
    {
        QFETCH(std::vector<CommissionJoint>, joints);
        QFETCH(QString, says);
        const auto list = CommissionList::make(m_catalog, joints);
        QCOMPARE(list.has_value(), says.isEmpty());
        QVERIFY2(list || list.error().text.contains(says), list ? "" : qPrintable(list.error().text));
    }

    void ofAProfile()
    {
        const auto profile = profileFromYaml(R"(profile: 1
defaults:
  all:
    Return Delay Time: 0
joints:
  - name: shoulder
    model: XM430-W350
    id: 11
    baud: 1000000
    firmware: 44
    registers:
      Max Position Limit: 180 deg
      Drive Mode: Time-based profile
      Profile Velocity: 200 ms
  - name: wrist
    model: XL430-W250
    id: 12
    baud: 1000000
)",
                                             u"arm.yaml"_s, m_catalog);
        QVERIFY2(profile, profile ? "" : qPrintable(profile.error().text));
        const auto list = commissionList(*profile, m_catalog);
        QVERIFY2(list, list ? "" : qPrintable(list.error().text));
        QCOMPARE(list->size(), std::size_t(2));
        const CommissionJoint &shoulder = list->joint(0);
        QCOMPARE(jointText(shoulder), u"shoulder (ID 11)"_s);
        QCOMPARE(shoulder.minimumFirmware, 44);
        QCOMPARE(shoulder.place, (MovePlace{1'000'000, 11}));
        std::map<QString, std::int64_t> raws;
        for (const CommissionSetting &setting : shoulder.settings)
            raws[setting.name] = setting.raw;
        QCOMPARE(raws, (std::map<QString, std::int64_t>{{u"Max Position Limit"_s, 2048},
                                                        {u"Drive Mode"_s, 4},
                                                        {u"Profile Velocity"_s, 200},
                                                        {u"Return Delay Time"_s, 0}}));
        QCOMPARE(list->joint(1).settings.size(), std::size_t(1));
        QVERIFY(unfitText(shoulder, 1020, 44, m_catalog).isEmpty());
        QVERIFY(unfitText(shoulder, 1020, 43, m_catalog).contains(u"needs 44 at least"));
        QVERIFY(unfitText(shoulder, 1060, 44, m_catalog).contains(u"this is model XL430-W250"));
    }

    void labels()
    {
        auto list = CommissionList::make(m_catalog, {{u"=SUM(\"a\",b)"_s, 1020, 0, {57600, 2}, {}},
                                                     {u"skipped"_s, 1020, 0, {57600, 3}, {}}});
        QVERIFY(list);
        list->skip(1);
        list->tick(0, {1020, 46, {57600, 1}, {57600, 2}, false, QDateTime(QDate(2026, 11, 28), QTime(12, 0))});
        QCOMPARE(QString::fromUtf8(labelsCsv(*list, m_catalog)),
                 u"Joint,ID,Baud rate,Model,Model number,Firmware,Checked\n"
                 "\"'=SUM(\"\"a\"\",b)\",2,57600,XM430-W350,1020,46,2026-11-28 12:00:00\n"_s);
        QVERIFY(list->isOver());
        list->reopen(1);
        QCOMPARE(list->next(), std::size_t(1));
    }

private:
    const Catalog m_catalog = test::builtInCatalog();
};

DYNASCOPE_CORE_TEST(TestCommissionList)
#include "tst_commissionlist.moc"
