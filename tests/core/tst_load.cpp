// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/joint.h"
#include "tests/support/testmain.h"

#include <cmath>
#include <numbers>

using namespace dynascope::sim;

namespace {

constexpr std::int64_t ms = 1000, second = 1000 * ms;

double degrees(const Joint &joint)
{
    return joint.plant().angle() * 180 / std::numbers::pi;
}

Joint driven(int pwm, QStringView model = u"XM430-W350")
{
    Joint joint(*findMotor(model));
    JointSettings settings;
    settings.operatingMode = 16;
    settings.goalPwm = pwm;
    joint.configure(settings);
    joint.setTorque(true);
    return joint;
}

} // namespace

/// What the shaft meets outside: stops, hands, gravity.
class TestLoad : public QObject
{
    Q_OBJECT

private slots:
    void stopsHold_data()
    {
        QTest::addColumn<QString>("model");
        QTest::addColumn<int>("pwm");
        QTest::addColumn<double>("stop");
        for (const char *model : {"XM430-W350", "XL330-M288", "XM540-W270", "XL330-M077"}) {
            QTest::addRow("%s up", model) << model << 885 << 240.0;
            QTest::addRow("%s down", model) << model << -885 << 100.0;
        }
    }

    /// Stiff: the whole stall torque dents a stop by about a degree, and what hits it at full speed comes to rest.
    void stopsHold()
    {
        QFETCH(QString, model);
        QFETCH(int, pwm);
        QFETCH(double, stop);
        Joint joint = driven(pwm, model);
        joint.setStops(100, 240);
        double farthest = 0;
        for (int t = 1; t < 2000; ++t) {
            joint.advanceTo(t * ms);
            farthest = std::max(farthest, (degrees(joint) - stop) * (pwm > 0 ? 1 : -1));
        }
        QVERIFY2(farthest > 0.5 && farthest < 15, qPrintable(QString::number(farthest)));
        QVERIFY(std::abs(degrees(joint) - stop) < 1.3);
        QCOMPARE(joint.plant().speed(), 0.0);
        QVERIFY(std::abs(joint.plant().current()) > 0.93 * joint.plant().motor().stallCurrent); // the supply sags
        JointSettings settings = joint.settings();
        settings.goalPwm = -pwm;
        joint.configure(settings); // free the other way
        joint.advanceTo(2200 * ms);
        QVERIFY(std::abs(degrees(joint) - stop) > 5);
    }

    void stallOnAStopIsAnOverload()
    {
        Joint joint = driven(885);
        joint.setStops(std::nullopt, 200);
        joint.advanceTo(900 * ms);
        QVERIFY(!joint.state().overload);
        joint.advanceTo(2 * second);
        QVERIFY(joint.state().overload);
    }

    void stopsMayBeTakenAway()
    {
        Joint joint = driven(885);
        joint.setStops(100, 200);
        joint.advanceTo(second);
        joint.setStops(std::nullopt, std::nullopt);
        joint.advanceTo(2 * second);
        QVERIFY(degrees(joint) > 300);
    }

    void aPushEndsByItself()
    {
        Joint joint(*findMotor(u"XM430-W350")); // no torque: turns freely
        joint.advanceTo(second);
        joint.push(1, 0.1);
        joint.advanceTo(1050 * ms);
        QVERIFY(joint.plant().speed() > 0);
        QVERIFY(joint.plant().load().handTorque() > 0.99);
        joint.advanceTo(1101 * ms);
        QCOMPARE(joint.plant().load().handTorque(), 0.0);
        joint.advanceTo(5 * second);
        QCOMPARE(joint.plant().speed(), 0.0);
        QVERIFY(degrees(joint) > 185);
    }

    /// Torque × time is momentum: friction and back-EMF out of the way.
    void aPushIsMomentum()
    {
        MotorModel motor = *findMotor(u"XM430-W350");
        motor.coulomb = motor.viscous = 0;
        Joint joint(motor);
        joint.push(0.5, 0.2);
        joint.advanceTo(second);
        QVERIFY(std::abs(joint.plant().speed() - 0.5 * 0.2 / motor.inertia) < 1e-3 * joint.plant().speed());
    }

    void aServoHoldsAgainstAPush()
    {
        Joint joint(*findMotor(u"XM430-W350"));
        joint.configure({});
        joint.setTorque(true);
        joint.push(1.5, 0.5);
        joint.advanceTo(400 * ms);
        QVERIFY(joint.state().position > 2048 + 10);
        QVERIFY(joint.state().current < -100);
        joint.advanceTo(3 * second);
        QVERIFY(std::abs(joint.state().position - 2048) <= 12);
    }

    void aHandHoldsAndLetsGo()
    {
        Joint joint(*findMotor(u"XM430-W350"));
        joint.configure({});
        joint.setTorque(true);
        joint.hold(180.0);
        joint.setGoalPosition(3072);
        joint.advanceTo(second);
        QVERIFY(std::abs(degrees(joint) - 180) < 1.3);
        QVERIFY(joint.state().movingStatus & 8); // not following
        QVERIFY(std::abs(joint.state().pwm) == 885);
        joint.hold(std::nullopt);
        joint.advanceTo(3 * second);
        QVERIFY(std::abs(joint.state().position - 3072) <= 12);
    }

    void aHandMovesAFreeJoint()
    {
        Joint joint(*findMotor(u"XL330-M288"));
        joint.hold(90.0);
        joint.advanceTo(3 * second);
        QVERIFY(std::abs(degrees(joint) - 90) < 0.2);
    }

    /// A pendulum without friction keeps its energy: the steps are small enough.
    void gravityKeepsEnergy()
    {
        MotorModel motor = *findMotor(u"XM430-W350");
        motor.coulomb = motor.viscous = 0;
        Joint joint(motor);
        joint.setGravityArm(1);
        joint.setShaftAngle(0);
        const double inertia = joint.plant().inertia();
        const auto energy = [&] {
            const double w = joint.plant().speed();
            return inertia * w * w / 2 + std::sin(joint.plant().angle());
        };
        double most = 0;
        for (int t = 1; t < 20000; ++t) {
            joint.advanceTo(t * ms);
            most = std::max(most, std::abs(energy()));
        }
        QVERIFY2(most < 0.02, qPrintable(QString::number(most))); // of 1 J
    }
};

DYNASCOPE_CORE_TEST(TestLoad)
#include "tst_load.moc"
