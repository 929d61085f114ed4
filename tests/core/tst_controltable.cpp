// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/table/controltable.h"
#include "tests/support/testmain.h"

#include <map>

using namespace dynascope;

namespace {

Field field(const QString &name, int address, int size, bool isSigned = false)
{
    Field result;
    result.name = name;
    result.address = static_cast<std::uint16_t>(address);
    result.size = static_cast<std::uint8_t>(size);
    result.isSigned = isSigned;
    return result;
}

Bound number(std::int64_t value)
{
    Bound bound;
    bound.number = value;
    return bound;
}

Bound reg(const QString &name, bool negated = false)
{
    Bound bound;
    bound.reg = name;
    bound.negated = negated;
    return bound;
}

RegisterLookup lookup(std::map<QString, std::int64_t> values)
{
    return [values](QStringView name) -> std::optional<std::int64_t> {
        const auto found = values.find(name.toString());
        return found == values.end() ? std::nullopt : std::optional(found->second);
    };
}

const QString Mode = QStringLiteral("Operating Mode");
const QString Drive = QStringLiteral("Drive Mode");
const QString Limit = QStringLiteral("Current Limit");

} // namespace

class TestControlTable : public QObject
{
    Q_OBJECT

private slots:
    void finds()
    {
        ControlTable::Description description;
        description.fields = {field(QStringLiteral("Model Number"), 0, 2), field(QStringLiteral("ID"), 7, 1),
            field(QStringLiteral("Goal Position"), 116, 4, true)};
        description.baudCodes = {{0, 9600}, {1, 57600}};
        description.fastReadsFrom = 45;
        const ControlTable table(description);
        QCOMPARE(table.size(), 120);
        QCOMPARE(table.indexOf(u"goal-position"), 2);
        QCOMPARE(table.indexOf(u"GOAL_POSITION "), 2);
        QCOMPARE(table.indexOf(u"Goal"), -1);
        QCOMPARE(table.indexOf(u""), -1);
        QCOMPARE(table.find(u"id")->address, std::uint16_t(7));
        QVERIFY(!table.find(u"Goal Positions"));
        QCOMPARE(table.at(116)->name, QStringLiteral("Goal Position"));
        QVERIFY(!table.at(117) && !table.at(-1) && !table.at(4000));
        QCOMPARE(table.indexOf(table.at(7)), 1);
        QCOMPARE(table.indexOf(static_cast<const Field *>(nullptr)), -1);
        const Field stranger = *table.at(7);
        QCOMPARE(table.indexOf(&stranger), -1);
        QCOMPARE(table.baudRate(1), std::optional<int>(57600));
        QCOMPARE(table.baudRate(2), std::optional<int>());
        QCOMPARE(table.baudCode(9600), std::optional<int>(0));
        QCOMPARE(table.baudCode(1), std::optional<int>());
        QVERIFY(table.hasFastReads(45) && !table.hasFastReads(44) && !table.hasBackup(255));
    }

    void findsEveryFieldHoweverItsNameIsWritten()
    {
        ControlTable::Description description;
        const QStringList names{QStringLiteral("ID"), QStringLiteral("Id 2"), QStringLiteral("Goal PWM"),
            QStringLiteral("Goal"), QStringLiteral("Velocity I-Gain"), QStringLiteral("Velocity_Limit"),
            QStringLiteral("Torque Enable"), QStringLiteral("LED")};
        for (const QString &name : names)
            description.fields.push_back(field(name, static_cast<int>(description.fields.size()), 1));
        const ControlTable table(description);
        for (int i = 0; i < static_cast<int>(names.size()); ++i) {
            QCOMPARE(table.indexOf(names[i]), i);
            QCOMPARE(table.indexOf(normalizedName(names[i])), i);
            QCOMPARE(table.indexOf(QStringLiteral("_ ") + names[i].toUpper() + u'-'), i);
            QCOMPARE(table.indexOf(QString(names[i]).chopped(1)), names[i] == u"Id 2" ? 0 : -1);
        }
        for (int known = 0; known <= static_cast<int>(Known::PresentPosition); ++known) {
            const auto each = static_cast<Known>(known);
            QCOMPARE(table.indexOf(each), table.indexOf(nameOf(each)));
            QCOMPARE(table.find(each), table.find(nameOf(each)));
        }
        QCOMPARE(table.indexOf(Known::Led), 7);
        QCOMPARE(table.indexOf(Known::BaudRate), -1);
    }

    void anEmptyTableIsHarmless()
    {
        const ControlTable table{ControlTable::Description()};
        QCOMPARE(table.size(), 0);
        QVERIFY(!table.at(0) && !table.find(u"ID") && table.fields().empty());
    }

    void bytesAndRaw_data()
    {
        QTest::addColumn<int>("size");
        QTest::addColumn<bool>("isSigned");
        QTest::addColumn<qint64>("raw");
        QTest::addColumn<QByteArray>("bytes");
        const auto row = [](int size, bool isSigned, qint64 raw, const char *hex) {
            QTest::addRow("%d%s %lld", size, isSigned ? "s" : "u", static_cast<long long>(raw))
                << size << isSigned << raw << QByteArray::fromHex(hex);
        };
        row(1, false, 0, "00");
        row(1, false, 255, "FF");
        row(1, true, -1, "FF");
        row(1, true, -128, "80");
        row(1, true, 127, "7F");
        row(2, false, 65535, "FFFF");
        row(2, false, 0x1234, "3412");
        row(2, true, -1, "FFFF");
        row(2, true, -32768, "0080");
        row(2, true, 32767, "FF7F");
        row(4, false, 4294967295, "FFFFFFFF");
        row(4, false, 2147483648, "00000080");
        row(4, true, -1, "FFFFFFFF");
        row(4, true, -2147483648, "00000080");
        row(4, true, 2147483647, "FFFFFF7F");
        row(4, true, -1048575, "0100F0FF");
    }

    void bytesAndRaw()
    {
        QFETCH(int, size);
        QFETCH(bool, isSigned);
        QFETCH(qint64, raw);
        QFETCH(QByteArray, bytes);
        const Field one = field(QStringLiteral("X"), 0, size, isSigned);
        const Bytes wire(bytes.begin(), bytes.end());
        QCOMPARE(bytesFromRaw(one, raw), wire);
        QCOMPARE(qint64(rawFromBytes(one, wire)), raw);
        QVERIFY(raw >= smallestRaw(one) && raw <= largestRaw(one));
    }

    void bytesThatAreTooFewOrTooMany()
    {
        const Field two = field(QStringLiteral("X"), 0, 2, true);
        QCOMPARE(rawFromBytes(two, {}), std::int64_t(0));
        QCOMPARE(rawFromBytes(two, Bytes{0x34}), std::int64_t(0x34));
        QCOMPARE(rawFromBytes(two, Bytes{0xFF, 0xFF, 0x01, 0x02}), std::int64_t(-1));
    }

    void rangesFollowOtherRegisters()
    {
        Field goal = field(QStringLiteral("Goal Current"), 102, 2, true);
        goal.minimum = reg(Limit, true);
        goal.maximum = reg(Limit);
        const EffectiveField known = effective(goal, lookup({{Limit, 1193}}));
        QCOMPARE(known.minimum, std::optional<std::int64_t>(-1193));
        QCOMPARE(known.maximum, std::optional<std::int64_t>(1193));
        const EffectiveField unknown = effective(goal, lookup({}));
        QVERIFY(!unknown.minimum && !unknown.maximum);
        QVERIFY(!effective(goal, {}).maximum);
    }

    void alternatesHoldWhileTheirRegisterSays()
    {
        Field velocity = field(QStringLiteral("Profile Velocity"), 112, 4);
        velocity.minimum = number(0);
        velocity.maximum = number(32767);
        velocity.unit = Unit::RevPerMin;
        velocity.scale = 0.229;
        Alternate byTime;
        byTime.reg = Drive;
        byTime.mask = 4;
        byTime.values = {4};
        byTime.minimum = number(0);
        byTime.maximum = number(32737);
        byTime.unit = Unit::Millisecond;
        velocity.alternates = {byTime};

        for (const int drive : {0, 1, 8, 9}) {
            const EffectiveField now = effective(velocity, lookup({{Drive, drive}}));
            QVERIFY(now.unit == Unit::RevPerMin && now.scale == 0.229 && now.maximum == 32767);
        }
        for (const int drive : {4, 5, 13}) {
            const EffectiveField now = effective(velocity, lookup({{Drive, drive}}));
            QVERIFY(now.unit == Unit::Millisecond && now.scale == 1.0 && now.maximum == 32737);
        }
        QVERIFY(effective(velocity, lookup({})).unit == Unit::RevPerMin);
        QVERIFY(effective(velocity, {}).unit == Unit::RevPerMin);
    }

    void anAlternateWithoutARangeKeepsTheFields()
    {
        Field goal = field(QStringLiteral("Goal Position"), 116, 4, true);
        goal.minimum = number(0);
        goal.maximum = number(4095);
        goal.unit = Unit::Pulse;
        Alternate far;
        far.reg = Mode;
        far.values = {4, 5};
        far.maximum = number(1048575);
        far.unit = Unit::Pulse;
        goal.alternates = {far};
        const EffectiveField now = effective(goal, lookup({{Mode, 5}}));
        QVERIFY(now.minimum == 0 && now.maximum == 1048575);
        QVERIFY(effective(goal, lookup({{Mode, 3}})).maximum == 4095);
    }
};

DYNASCOPE_CORE_TEST(TestControlTable)
#include "tst_controltable.moc"
