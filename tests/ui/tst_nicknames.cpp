// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/uitest.h"
#include "tests/support/workbenchfixture.h"
#include "ui/devices/nicknames.h"

#include <QSettings>

using namespace dynascope;

class TestNicknames : public QObject
{
    Q_OBJECT

private slots:
    void init() { QSettings().clear(); }

    void areThereAgainAtTheNextStart()
    {
        nameOne(QStringLiteral("/dev/ttyUSB0"), 4, QStringLiteral("shoulder"));
        QCOMPARE(nameOf(QStringLiteral("/dev/ttyUSB0"), 4), QStringLiteral("shoulder"));
        QCOMPARE(nameOf(QStringLiteral("/dev/ttyUSB0"), 5), QString());
        QCOMPARE(nameOf(QStringLiteral("sim"), 4), QString()); // another bus
        nameOne(QStringLiteral("/dev/ttyUSB0"), 4, QString());
        QCOMPARE(nameOf(QStringLiteral("/dev/ttyUSB0"), 4), QString());
    }

    void areShortAndOneLineWhateverTheSettingsHold_data()
    {
        QTest::addColumn<QString>("kept");
        QTest::addColumn<QString>("shown");
        const QString longest(40, u'x');
        QTest::newRow("a tag") << QStringLiteral("<img src=x>") << QStringLiteral("<img src=x>");
        QTest::newRow("the longest") << longest << longest;
        QTest::newRow("too long") << QString(100'000, u'x') << longest;
        QTest::newRow("lines") << QStringLiteral(" left\n arm\t") << QStringLiteral("left arm");
        QTest::newRow("nothing") << QStringLiteral(" \n ") << QString();
    }
    void areShortAndOneLineWhateverTheSettingsHold()
    {
        QFETCH(QString, kept);
        nameOne(QStringLiteral("/dev/ttyUSB0"), 4, QStringLiteral("shoulder"));
        QSettings settings;
        settings.beginGroup(QStringLiteral("nicknames"));
        QCOMPARE(settings.allKeys().size(), 1);
        settings.setValue(settings.allKeys().front(), kept);
        QTEST(nameOf(QStringLiteral("/dev/ttyUSB0"), 4), "shown");
    }

    void followTheirDeviceToAnotherId()
    {
        {
            Bench bench;
            Device &device = bench.heard(QStringLiteral("sim"), 1);
            device.setNickname(QStringLiteral("gripper"));
            device.line()->moveDevice(device, found(9));
        }
        QCOMPARE(nameOf(QStringLiteral("sim"), 9), QStringLiteral("gripper"));
        QCOMPARE(nameOf(QStringLiteral("sim"), 1), QString()); // the next new servo is no gripper
    }

    void anotherAdapterUnderTheSameNameInheritsNothing()
    {
        const QString port = QStringLiteral("/dev/ttyUSB0");
        const auto plug = [&port](Bench &bench, const QString &identity) {
            bench.fixture.lines.plug({{port, QStringLiteral("U2D2"), {}, identity}});
        };
        Bench bench;
        plug(bench, QStringLiteral("A"));
        bench.heard(port, 4).setNickname(QStringLiteral("shoulder"));
        bench.fixture.session.close(*bench.fixture.session.lines().front());
        plug(bench, QStringLiteral("B")); // in the same run
        QCOMPARE(bench.heard(port, 4).nickname(), QString());
        bench.fixture.session.close(*bench.fixture.session.lines().front());
        bench.fixture.lines.plug({{QStringLiteral("/dev/ttyUSB1"), QStringLiteral("U2D2"), {}, QStringLiteral("A")}});
        QCOMPARE(bench.heard(QStringLiteral("/dev/ttyUSB1"), 4).nickname(), QStringLiteral("shoulder"));
    }

private:
    static Found found(int id) { return {static_cast<std::uint8_t>(id), 1'000'000, 1020, 45, false, {}}; }

    /// One run of the program.
    struct Bench {
        test::WorkbenchFixture fixture;
        Nicknames nicknames{fixture.workbench()};

        Device &heard(const QString &port, int id) { return fixture.session.open(port, 1'000'000).heard(found(id)); }
    };

    static void nameOne(const QString &port, int id, const QString &name)
    {
        Bench bench;
        bench.heard(port, id).setNickname(name);
    }
    static QString nameOf(const QString &port, int id)
    {
        Bench bench;
        return bench.heard(port, id).nickname();
    }
};

DYNASCOPE_UI_TEST(TestNicknames)
#include "tst_nicknames.moc"
