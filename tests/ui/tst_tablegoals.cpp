// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/uitest.h"
#include "tests/ui/tablefixture.h"
#include "ui/table/goalbar.h"

#include <QDoubleSpinBox>
#include <QLineEdit>
#include <QSlider>

using namespace dynascope;

namespace {

struct Bar {
    explicit Bar(TableFixture &fixture)
        : bar(fixture.actions().write)
        , slider(bar.findChild<QSlider *>(QStringLiteral("goalSlider")))
        , spin(bar.findChild<QDoubleSpinBox *>(QStringLiteral("goalSpin")))
        , second(bar.findChild<QSlider *>(QStringLiteral("secondGoalSlider")))
    {
        bar.resize(600, 80);
    }

    GoalBar bar;
    QSlider *slider;
    QDoubleSpinBox *spin;
    QSlider *second;
};

} // namespace

class TestTableGoals : public QObject
{
    Q_OBJECT

    static Device *moving(TableFixture &fixture, int id, int mode = 3)
    {
        Device *device = fixture.add(id);
        TableFixture::set(device, QStringLiteral("Operating Mode"), mode);
        TableFixture::set(device, QStringLiteral("Torque Enable"), 1);
        TableFixture::set(device, QStringLiteral("Goal Position"), 2048);
        return device;
    }

private slots:
    void choosesTheGoalOfTheMode_data()
    {
        QTest::addColumn<int>("mode");
        QTest::addColumn<QStringList>("names");
        QTest::newRow("current") << 0 << QStringList{QStringLiteral("Goal Current")};
        QTest::newRow("velocity") << 1 << QStringList{QStringLiteral("Goal Velocity")};
        QTest::newRow("position") << 3 << QStringList{QStringLiteral("Goal Position")};
        QTest::newRow("extended") << 4 << QStringList{QStringLiteral("Goal Position")};
        QTest::newRow("current-based")
            << 5 << QStringList{QStringLiteral("Goal Position"), QStringLiteral("Goal Current")};
        QTest::newRow("PWM") << 16 << QStringList{QStringLiteral("Goal PWM")};
        QTest::newRow("unheard of") << 99 << QStringList();
    }

    void choosesTheGoalOfTheMode()
    {
        QFETCH(int, mode);
        QFETCH(QStringList, names);
        TableFixture fixture;
        const Device *device = moving(fixture, 1, mode);
        QStringList found;
        for (const int field : goalFields(*device))
            found << device->table().fields()[static_cast<std::size_t>(field)].name;
        QCOMPARE(found, names);
    }

    /// What was 87.9 degrees must not be taken for 88.9 radians.
    void unitsThatChangeWhileAGoalWaitsMoveNothing()
    {
        TableFixture fixture;
        Bar window(fixture);
        window.bar.setDevices({moving(fixture, 1)});
        window.slider->setValue(1000);
        window.slider->setValue(1001); // waits for its turn
        window.bar.setUnits(AngleUnit::Radians);
        window.spin->stepUp();
        QTRY_COMPARE(fixture.written().size(), 2);
        const int goal = fixture.written().last().section(u'=', 1).toInt();
        QVERIFY2(goal > 990 && goal < 1030, qPrintable(fixture.written().last()));
    }

    void writesAtMostThirtyTimesASecondAndTheLast()
    {
        TableFixture fixture;
        Bar window(fixture);
        window.bar.setDevices({moving(fixture, 1)});
        for (int raw = 1000; raw < 1500; ++raw)
            window.slider->setValue(raw);
        QCOMPARE(fixture.written(), QStringList{QStringLiteral("1 Goal Position=1000")});
        QTRY_COMPARE(fixture.written().size(), 2);
        QCOMPARE(fixture.written().back(), QStringLiteral("1 Goal Position=1499"));
        QTest::qWait(2 * WriteThrottle::IntervalMs);
        QCOMPARE(fixture.written().size(), 2);
    }

    void keysAndNumbersWrite()
    {
        TableFixture fixture;
        Bar window(fixture);
        window.bar.setDevices({moving(fixture, 1)});
        QTest::keyClick(window.slider, Qt::Key_Right);
        QCOMPARE(fixture.written().back(), QStringLiteral("1 Goal Position=2059")); // about a degree
        window.spin->setValue(90.0);
        QTRY_COMPARE(fixture.written().back(), QStringLiteral("1 Goal Position=1024"));
        QCOMPARE(window.slider->value(), 1024);
    }

    void isStillWithoutTorque()
    {
        TableFixture fixture;
        Bar window(fixture);
        Device *device = moving(fixture, 1);
        TableFixture::set(device, QStringLiteral("Torque Enable"), 0);
        window.bar.setDevices({device});
        QVERIFY(!window.slider->isEnabled());
        QVERIFY(!window.spin->isEnabled());
        TableFixture::set(device, QStringLiteral("Torque Enable"), 1);
        QTRY_VERIFY(window.slider->isEnabled());
        // STOP while a value waits: it must not be sent any more.
        window.slider->setValue(100);
        window.slider->setValue(200);
        TableFixture::set(device, QStringLiteral("Torque Enable"), 0);
        QTRY_VERIFY(!window.slider->isEnabled());
        QTest::qWait(2 * WriteThrottle::IntervalMs);
        QCOMPARE(fixture.written(), QStringList{QStringLiteral("1 Goal Position=100")});
    }

    void followsTheServo()
    {
        TableFixture fixture;
        Bar window(fixture);
        Device *device = moving(fixture, 1);
        window.bar.setDevices({device});
        QCOMPARE(window.slider->value(), 2048);
        QCOMPARE(window.spin->text(), QStringLiteral("180.00 °"));
        TableFixture::set(device, QStringLiteral("Goal Position"), 3072);
        QTRY_COMPARE(window.slider->value(), 3072);
        window.slider->setSliderDown(true);
        TableFixture::set(device, QStringLiteral("Goal Position"), 10);
        QTest::qWait(80);
        QCOMPARE(window.slider->value(), 3072); // a hand is on it
        window.slider->setSliderDown(false);
        QTRY_COMPARE(window.slider->value(), 10);
        QCOMPARE(fixture.written(), QStringList());
    }

    void comesBackWhereAWriteIsRefused()
    {
        TableFixture fixture;
        Bar window(fixture);
        window.bar.setDevices({moving(fixture, 1)});
        window.slider->setValue(100); // the fixture writes nothing
        QTRY_COMPARE(window.slider->value(), 2048);
    }

    void rangesFollowTheLimits()
    {
        TableFixture fixture;
        Bar window(fixture);
        Device *device = moving(fixture, 1);
        window.bar.setDevices({device});
        TableFixture::set(device, QStringLiteral("Min Position Limit"), 500);
        TableFixture::set(device, QStringLiteral("Max Position Limit"), 3000);
        QTRY_COMPARE(window.slider->minimum(), 500);
        QTRY_COMPARE(window.slider->maximum(), 3000);
        TableFixture::set(device, QStringLiteral("Operating Mode"), 4);
        QTRY_COMPARE(window.slider->maximum(), 1048575);
    }

    void writesToAllUnderTorque()
    {
        TableFixture fixture;
        Bar window(fixture);
        Device *one = moving(fixture, 1);
        Device *two = moving(fixture, 2);
        Device *off = moving(fixture, 3);
        TableFixture::set(off, QStringLiteral("Torque Enable"), 0);
        window.bar.setDevices({one, two, off});
        window.slider->setValue(700);
        const QStringList expected{QStringLiteral("1 Goal Position=700"), QStringLiteral("2 Goal Position=700")};
        QCOMPARE(fixture.written(), expected);
    }

    void survivesItsDevices()
    {
        TableFixture fixture;
        Bar window(fixture);
        window.bar.setDevices({moving(fixture, 1)});
        window.slider->setValue(100);
        window.slider->setValue(200);
        fixture.devices.clear();
        QTest::qWait(2 * WriteThrottle::IntervalMs);
        QCOMPARE(fixture.written(), QStringList{QStringLiteral("1 Goal Position=100")});
        window.bar.setDevices({});
    }
};

DYNASCOPE_UI_TEST(TestTableGoals)
#include "tst_tablegoals.moc"
