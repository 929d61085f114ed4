// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/table/fieldchanges.h"
#include "core/table/registerindex.h"
#include "tests/support/builtincatalog.h"
#include "tests/support/testmain.h"

using namespace Qt::StringLiterals;
using namespace dynascope;
using namespace dynascope::test;

/// The search over the registers of all models, and what differs between two tables.
class TestRegisterIndex : public QObject
{
    Q_OBJECT

    const Catalog m_catalog = builtInCatalog();
    RegisterIndex m_index;

    /// "Goal Current@102/2".
    static QString text(const RegisterIndex::Entry &entry)
    {
        return u"%1@%2/%3"_s.arg(entry.name).arg(entry.address).arg(entry.size);
    }

    QStringList find(const QString &wanted) const
    {
        QStringList found;
        for (const RegisterIndex::Entry *entry : m_index.find(wanted))
            found << text(*entry);
        return found;
    }

private slots:
    void initTestCase()
    {
        QVERIFY(m_index.isEmpty());
        for (const Catalog::ModelInfo &info : m_catalog.models()) {
            for (const int firmware : m_catalog.firmwareSteps(info.modelNumber))
                m_index.add(*m_catalog.find(info.modelNumber, firmware));
        }
    }

    void findsTheBestFirst_data()
    {
        QTest::addColumn<QString>("wanted");
        QTest::addColumn<QStringList>("first");
        QTest::newRow("name") << u"Goal Current"_s
                              << QStringList{u"Goal Current@102/2"_s, u"Goal Current@202/2"_s, u"Goal Current@526/2"_s};
        QTest::newRow("as in a program") << u"goal_current"_s << QStringList{u"Goal Current@102/2"_s};
        QTest::newRow("the name before what contains it") << u"LED"_s << QStringList{u"LED@25/1"_s, u"LED@65/1"_s};
        QTest::newRow("its beginning") << u"electronic"_s << QStringList{u"Electronic GearRatio Denominator@100/4"_s};
        QTest::newRow("words in any order") << u"gain p position"_s << QStringList{u"Position P Gain@84/2"_s};
        QTest::newRow("word and address") << u"current 102"_s << QStringList{u"Goal Current@102/2"_s};
        QTest::newRow("numbers in order")
            << u"external port data"_s << QStringList{u"External Port Data 1@152/2"_s, u"External Port Data 1@600/2"_s};
    }

    void findsTheBestFirst()
    {
        QFETCH(QString, wanted);
        QFETCH(QStringList, first);
        const QStringList found = find(wanted);
        QVERIFY2(found.first(std::min(found.size(), first.size())) == first, qPrintable(found.mid(0, 6).join(u", "_s)));
    }

    void nothing_data()
    {
        QTest::addColumn<QString>("wanted");
        for (const char *text :
             {"", " ", "-", "Goal Pressure", "65536", "-9876", "0xFFFF", "0x", "99999999999999999999"})
            QTest::newRow(text) << QString::fromLatin1(text);
    }

    void nothing()
    {
        QFETCH(QString, wanted);
        QCOMPARE(find(wanted), QStringList());
    }

    /// By address: what begins there, the most common first, then what it lies in.
    void byAddress()
    {
        const QStringList found = find(u"103"_s);
        QCOMPARE(find(u"0x67"_s), found);
        QCOMPARE(find(u" 0X67 "_s), found);
        const std::vector<const RegisterIndex::Entry *> entries = m_index.find(u"103"_s);
        bool within = false;
        for (const RegisterIndex::Entry *entry : entries) {
            QVERIFY(entry->address <= 103 && 103 < entry->address + entry->size);
            QVERIFY(!within || entry->address != 103);
            within = within || entry->address != 103;
        }
        QVERIFY(found.contains(u"Goal Current@102/2"_s));
        QCOMPARE(find(u"102"_s).front(), u"Goal Current@102/2"_s);
    }

    /// Every register of every table is found at its address, with its model and firmware.
    void holdsEveryRegister()
    {
        for (const Catalog::ModelInfo &info : m_catalog.models()) {
            const ControlTablePtr table = m_catalog.find(info.modelNumber, 255);
            const Field &field = table->fields().back();
            const auto entries = m_index.find(QString::number(field.address));
            const bool found = std::any_of(entries.begin(), entries.end(), [&](const RegisterIndex::Entry *entry) {
                return entry->name == field.name && entry->size == field.size
                       && std::any_of(entry->owners.begin(), entry->owners.end(), [&](const auto &owner) {
                              return owner.modelNumber == info.modelNumber && owner.firmwareTo == 255;
                          });
            });
            QVERIFY2(found, qPrintable(info.model));
        }
    }

    void rangesOfFirmware_data()
    {
        QTest::addColumn<QString>("name");
        QTest::addColumn<int>("model");
        QTest::addColumn<int>("from");
        QTest::addColumn<int>("to");
        QTest::newRow("always") << u"Goal Current"_s << 1020 << 0 << 255;
        QTest::newRow("since") << u"Backup Ready"_s << 1020 << 45 << 255;
        QTest::newRow("until") << u"Acceleration Limit"_s << 1020 << 0 << 37;
        QTest::newRow("moved") << u"Indirect Data 1"_s << 1200 << 53 << 255;
    }

    void rangesOfFirmware()
    {
        QFETCH(QString, name);
        QFETCH(int, model);
        std::optional<RegisterIndex::Owner> last;
        for (const RegisterIndex::Entry *entry : m_index.find(name)) {
            if (entry->name != name)
                continue;
            for (const RegisterIndex::Owner &owner : entry->owners) {
                if (owner.modelNumber == model && (!last || owner.firmwareTo > last->firmwareTo))
                    last = owner;
            }
        }
        QVERIFY(last);
        QTEST(last->firmwareFrom, "from");
        QTEST(last->firmwareTo, "to");
    }

    void changes_data()
    {
        using enum FieldAspect;
        QTest::addColumn<QString>("one");
        QTest::addColumn<QString>("other"); // MODEL/FIRMWARE/REGISTER
        QTest::addColumn<QList<int>>("aspects");
        const auto row = [](const char *name, const QString &one, const QString &other,
                            const std::vector<FieldAspect> &aspects) {
            QList<int> numbers;
            for (const FieldAspect aspect : aspects)
                numbers << int(aspect);
            QTest::newRow(name) << one << other << numbers;
        };
        row("the same", u"1020/45/Goal Current"_s, u"1020/41/Goal Current"_s, {});
        row("bits", u"1020/45/Drive Mode"_s, u"1020/44/Drive Mode"_s, {Range, Bits});
        row("moved", u"1200/53/Indirect Data 1"_s, u"1200/52/Indirect Data 1"_s, {Address});
        row("initial and range", u"1200/53/Indirect Address 1"_s, u"1200/52/Indirect Address 1"_s, {Initial, Range});
        row("limits", u"1020/45/Current Limit"_s, u"1120/45/Current Limit"_s, {Initial, Range});
        row("values", u"1020/45/Operating Mode"_s, u"1060/45/Operating Mode"_s, {Values, Resets});
        row("unit", u"1020/45/Current Limit"_s, u"1190/53/Current Limit"_s, {Initial, Range, Unit});
        row("size", u"1020/45/Min Voltage Limit"_s, u"350/29/Min Voltage Limit"_s, {Address, Size, Initial, Range});
    }

    void changes()
    {
        const auto field = [this](const QString &path) {
            const QStringList parts = path.split(u'/');
            return m_catalog.find(parts[0].toInt(), parts[1].toInt())->find(parts[2]);
        };
        QFETCH(QString, one);
        QFETCH(QString, other);
        QList<int> found;
        for (const FieldAspect aspect : changedAspects(*field(one), *field(other)))
            found << int(aspect);
        QTEST(found, "aspects");
    }
};

DYNASCOPE_CORE_TEST(TestRegisterIndex)
#include "tst_registerindex.moc"
