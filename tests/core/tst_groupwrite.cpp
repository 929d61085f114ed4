// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/readplan.h"
#include "core/session/groupwrite.h"
#include "tests/support/builtincatalog.h"
#include "tests/support/settingsworld.h"
#include "tests/support/testmain.h"

using namespace dynascope;
using namespace Qt::StringLiterals;
using test::SettingsWorld;

namespace {

QStringList sent(const std::vector<Request> &requests)
{
    QStringList names;
    for (const Request &request : requests)
        names << (request.packet.instruction == Instruction::SyncWrite ? u"Sync Write"_s
                                                                                                 : u"Bulk Write"_s);
    return names;
}

} // namespace

/// One register of several devices at once, each at its own address.
class TestGroupWrite : public QObject
{
    Q_OBJECT

private slots:
    void eachItsOwnAddress_data()
    {
        QTest::addColumn<QString>("servos");
        QTest::addColumn<QString>("field");
        QTest::addColumn<int>("raw");
        QTest::addColumn<QList<int>>("addresses");
        QTest::addColumn<QStringList>("packets");
        const auto row = [](const char *name, const QString &servos, const QString &field, int raw,
                            const QList<int> &addresses, const QStringList &packets) {
            QTest::newRow(name) << servos << field << raw << addresses << packets;
        };
        row("one model", u"XM430-W350@57600:1,XM430-W350@57600:2"_s, u"LED"_s, 1, {65, 65}, {u"Sync Write"_s});
        row("XL330, firmware 51 and 52", u"XL330-M288/51@57600:1,XL330-M288/52@57600:2"_s, u"Indirect Data 1"_s, 5,
            {208, 208}, {u"Sync Write"_s});
        row("XL330, firmware 52 and 53", u"XL330-M288/52@57600:1,XL330-M288/53@57600:2"_s, u"Indirect Data 1"_s, 5,
            {208, 224}, {u"Bulk Write"_s});
        row("XL330 of three firmwares", u"XL330-M288/51@57600:1,XL330-M288/52@57600:2,XL330-M288/53@57600:3"_s,
            u"Indirect Data 1"_s, 5, {208, 208, 224}, {u"Sync Write"_s, u"Sync Write"_s});
        row("X, PRO and Y", u"XM430-W350@57600:1,H54-100-S500-R@57600:2,YM070-210-M001-RH@57600:3"_s,
            u"Position P Gain"_s, 600, {84, 594, 232}, {u"Bulk Write"_s});
    }
    void eachItsOwnAddress()
    {
        QFETCH(QString, servos);
        QFETCH(QString, field);
        QFETCH(int, raw);
        QFETCH(QList<int>, addresses);
        QFETCH(QStringList, packets);
        SettingsWorld world(m_catalog, servos);
        const auto writes = planGroupWrite(membersOf(world), field, raw);
        QVERIFY2(writes, writes ? "" : qPrintable(writes.error().text));
        for (std::size_t i = 0; i < writes->size(); ++i) {
            QCOMPARE(int((*writes)[i].address), addresses[static_cast<qsizetype>(i)]);
            if (field.startsWith(u"Indirect Data")) // where it can be seen
                QVERIFY(world.all[i]->write(u"Indirect Address 1", world.all[i]->table().find(u"LED")->address)
                        == DeviceError::None);
        }
        const auto shown = [&](sim::Servo &servo) {
            return servo.value(field.startsWith(u"Indirect Data") ? u"LED"_s : field);
        };
        const int value = field.startsWith(u"Indirect Data") ? 1 : raw;
        const auto final = planGroupWrite(membersOf(world), field, value);
        QVERIFY(final);
        QCOMPARE(sent(planWrites(*final, {})), packets);
        test::MortalLine line(world.bus, 57600);
        Bus program(line);
        QVERIFY(writeMany(program, *final));
        world.bus.advanceTo(line.now() + std::chrono::milliseconds(50));
        for (sim::Servo *servo : world.all)
            QCOMPARE(shown(*servo), value);
    }

    void refused_data()
    {
        QTest::addColumn<QString>("servos");
        QTest::addColumn<QString>("field");
        QTest::addColumn<int>("raw");
        QTest::addColumn<QString>("says");
        QTest::newRow("one has no such register")
            << u"XL330-M288/53@57600:1,XL330-M288/52@57600:2"_s << u"Indirect Data 21"_s << 1
            << u"XL330-M288 #2 has no register Indirect Data 21"_s;
        QTest::newRow("one can't have it written") << u"XM430-W350@57600:1"_s << u"Present Position"_s << 1
                                                   << u"can only be read"_s;
        QTest::newRow("too large for one") << u"H54-100-S500-R@57600:1,XM430-W350@57600:2"_s << u"Operating Mode"_s << 5
                                           << u"H54-100-S500-R #1: Operating Mode can't be 5"_s;
    }
    void refused()
    {
        QFETCH(QString, servos);
        QFETCH(QString, field);
        QFETCH(int, raw);
        QFETCH(QString, says);
        SettingsWorld world(m_catalog, servos);
        const auto writes = planGroupWrite(membersOf(world), field, raw);
        QVERIFY(!writes);
        QVERIFY2(writes.error().text.contains(says), qPrintable(writes.error().text));
    }

    void byAddress_data()
    {
        QTest::addColumn<QString>("servos");
        QTest::addColumn<int>("address");
        QTest::addColumn<int>("length");
        QTest::addColumn<QString>("says");
        QTest::newRow("alike") << u"XM430-W350@57600:1,XL430-W250@57600:2"_s << 116 << 4 << QString();
        QTest::newRow("X and PRO") << u"XM430-W350@57600:1,H54-100-S500-R@57600:2"_s << 64 << 1
                                   << u"64:1 is Torque Enable of XM430-W350 #1, and"_s;
        QTest::newRow("two firmwares") << u"XL330-M288/52@57600:1,XL330-M288/53@57600:2"_s << 224 << 1
                                       << u"Indirect Data 17 of XL330-M288 #1, and Indirect Data 1 of"_s;
        QTest::newRow("the same name, another length") << u"XM430-W350@57600:1,XL-320@57600:2"_s << 7 << 1
                                                       << u"7:1 is ID of"_s;
    }
    void byAddress()
    {
        QFETCH(QString, servos);
        QFETCH(int, address);
        QFETCH(int, length);
        QFETCH(QString, says);
        SettingsWorld world(m_catalog, servos);
        const auto same = checkSameMeaning(membersOf(world), address, length);
        QCOMPARE(same.has_value(), says.isEmpty());
        QVERIFY2(same || same.error().text.contains(says), same ? "" : qPrintable(same.error().text));
    }

    void unknownModels()
    {
        SettingsWorld world(m_catalog, u"XM430-W350@57600:1"_s);
        std::vector<GroupMember> members = membersOf(world);
        members.push_back({2, nullptr, u"it"_s});
        QVERIFY(checkSameMeaning(members, 64, 1));
        QVERIFY(!planGroupWrite(members, u"LED", 1));
    }

private:
    static std::vector<GroupMember> membersOf(const SettingsWorld &world)
    {
        std::vector<GroupMember> members;
        for (const sim::Servo *servo : world.all)
            members.push_back({static_cast<std::uint8_t>(servo->id()), &servo->table(),
                               u"%1 #%2"_s.arg(servo->model()).arg(servo->id())});
        return members;
    }
    const Catalog m_catalog = test::builtInCatalog();
};

DYNASCOPE_CORE_TEST(TestGroupWrite)
#include "tst_groupwrite.moc"
