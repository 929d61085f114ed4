// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/joint.h"
#include "tests/support/testmain.h"

#include <QElapsedTimer>

#include <algorithm>
#include <climits>
#include <cmath>
#include <vector>

using namespace dynascope::sim;

namespace {

constexpr std::int64_t ms = 1000, second = 1000 * ms;

JointSettings defaults(QStringView model, int mode = 3)
{
    JointSettings settings; // those of XM430-W350
    if (model == u"XL430-W250") {
        settings.positionP = 640;
        settings.positionD = 4000;
        settings.velocityI = 1000;
        settings.velocityLimit = 265;
    } else if (model == u"XL330-M288") {
        settings.positionP = 400;
        settings.velocityP = 180;
        settings.velocityI = 1600;
        settings.velocityLimit = 445;
        settings.currentLimit = settings.goalCurrent = 1750;
        settings.currentUnit = 1;
    }
    settings.operatingMode = mode;
    return settings;
}

/// Torque on and at rest at 2048 pulses, clock at 0.1 s.
Joint ready(const JointSettings &settings, QStringView model = u"XM430-W350", std::uint64_t seed = 1)
{
    Joint joint(*findMotor(model), seed);
    joint.configure(settings);
    joint.setTorque(true);
    joint.advanceTo(100 * ms);
    return joint;
}

JointSettings profiled(int velocity, int acceleration, std::uint8_t driveMode = 0)
{
    JointSettings settings;
    settings.profileVelocity = velocity;
    settings.profileAcceleration = acceleration;
    settings.driveMode = driveMode;
    return settings;
}


bool same(const JointState &a, const JointState &b)
{
    return a.position == b.position && a.velocity == b.velocity && a.current == b.current && a.pwm == b.pwm
        && a.load == b.load && a.positionTrajectory == b.positionTrajectory
        && a.velocityTrajectory == b.velocityTrajectory && a.moving == b.moving && a.movingStatus == b.movingStatus
        && a.inputVoltage == b.inputVoltage && a.temperature == b.temperature && a.overload == b.overload;
}

} // namespace

class TestJoint : public QObject
{
    Q_OBJECT

private slots:
    void stepResponse_data()
    {
        QTest::addColumn<QString>("model");
        QTest::addColumn<int>("mode");
        QTest::addColumn<int>("overshoot"); // pulses of 1024
        QTest::addColumn<int>("earliest"); // ms until it stays within 2 %
        QTest::addColumn<int>("latest");
        QTest::newRow("XM430") << "XM430-W350" << 3 << 30 << 300 << 450;
        QTest::newRow("XM430 extended") << "XM430-W350" << 4 << 30 << 300 << 450;
        QTest::newRow("XM430 current-based") << "XM430-W350" << 5 << 80 << 300 << 700;
        QTest::newRow("XL430") << "XL430-W250" << 3 << 5 << 250 << 500;
        QTest::newRow("XL330") << "XL330-M288" << 3 << 50 << 150 << 350;
        QTest::newRow("XL330 current-based") << "XL330-M288" << 5 << 200 << 150 << 700;
    }

    void stepResponse()
    {
        QFETCH(QString, model);
        QFETCH(int, mode);
        QFETCH(int, overshoot);
        QFETCH(int, earliest);
        QFETCH(int, latest);
        Joint joint = ready(defaults(model, mode), model);
        joint.setGoalPosition(2048 + 1024);
        int peak = 0, settled = 0;
        for (int t = 1; t <= 2000; ++t) {
            joint.advanceTo((100 + t) * ms);
            const int moved = joint.state().position - 2048;
            peak = std::max(peak, moved);
            if (std::abs(moved - 1024) > 20)
                settled = t;
        }
        QVERIFY2(peak - 1024 <= overshoot, qPrintable(QString::number(peak)));
        QVERIFY2(settled >= earliest && settled <= latest, qPrintable(QString::number(settled)));
        const JointState state = joint.state();
        QCOMPARE(state.velocity, 0);
        QVERIFY(!state.moving);
        QCOMPARE(int(state.movingStatus), 1); // in position, a step
    }

    void integralGainTakesTheErrorAway()
    {
        JointSettings settings;
        settings.positionI = 2000;
        Joint joint = ready(settings);
        joint.setGravityArm(1.0); // horizontal at 2048
        joint.advanceTo(4 * second);
        QVERIFY(std::abs(joint.state().position - 2048) <= 2);
    }

    void feedforwardShortensTheLag()
    {
        JointSettings settings = profiled(100, 20);
        int lags[2] = {};
        for (int i = 0; i < 2; ++i) {
            settings.feedforward1 = i == 0 ? 0 : 1000;
            Joint joint = ready(settings);
            joint.setGoalPosition(2048 + 2048);
            joint.advanceTo(800 * ms);
            lags[i] = joint.state().positionTrajectory - joint.state().position;
        }
        QVERIFY(lags[0] > 50);
        QVERIFY(std::abs(lags[1]) < lags[0] / 3);
    }

    void profileRegisters()
    {
        // 100 × 0.229 rev/min = 1.563 pulses/ms; 20 × 214.577 rev/min² = 0.004883 pulses/ms²: ramps of 320 ms, 1310 ms
        // for half a turn.
        Joint joint = ready(profiled(100, 20));
        joint.setGoalPosition(2048 + 2048);
        joint.advanceTo(110 * ms);
        QCOMPARE(int(joint.state().movingStatus) & 0x32, 0x32); // trapezoid, going on
        QVERIFY(joint.state().moving);
        joint.advanceTo(260 * ms);
        QCOMPARE(joint.state().velocityTrajectory, 50);
        QVERIFY(std::abs(joint.state().positionTrajectory - (2048 + 62)) <= 1);
        joint.advanceTo(700 * ms);
        JointState state = joint.state();
        QCOMPARE(state.velocityTrajectory, 100);
        QVERIFY(std::abs(state.velocity - 100) <= 3);
        QCOMPARE(state.movingStatus & 9, 0); // following, not there
        joint.advanceTo((100 + 1630) * ms);
        QVERIFY(joint.state().movingStatus & 2);
        joint.advanceTo((100 + 1632) * ms);
        QVERIFY(!(joint.state().movingStatus & 2));
        joint.advanceTo(3 * second);
        state = joint.state();
        QCOMPARE(int(state.movingStatus), 0x31);
        QCOMPARE(state.positionTrajectory, 4096);
        QCOMPARE(state.velocityTrajectory, 0);
        QVERIFY(!state.moving);
    }

    void profileShapes_data()
    {
        QTest::addColumn<int>("velocity");
        QTest::addColumn<int>("acceleration");
        QTest::addColumn<int>("driveMode");
        QTest::addColumn<int>("shape");
        QTest::addColumn<int>("duration"); // ms, 1000 pulses
        QTest::newRow("step") << 0 << 0 << 0 << 0 << 0;
        QTest::newRow("rectangle") << 100 << 0 << 0 << 1 << 640;
        QTest::newRow("triangle") << 300 << 20 << 0 << 2 << 905;
        QTest::newRow("trapezoid") << 100 << 20 << 0 << 3 << 960;
        QTest::newRow("time, rectangle") << 700 << 0 << 4 << 1 << 700;
        QTest::newRow("time, trapezoid") << 700 << 100 << 4 << 3 << 700;
        QTest::newRow("time, triangle") << 700 << 350 << 4 << 2 << 700;
        QTest::newRow("time, ramps too long") << 700 << 600 << 4 << 2 << 700;
        QTest::newRow("time, reverse") << 700 << 100 << 5 << 3 << 700;
    }

    void profileShapes()
    {
        QFETCH(int, velocity);
        QFETCH(int, acceleration);
        QFETCH(int, driveMode);
        QFETCH(int, shape);
        QFETCH(int, duration);
        Joint joint = ready(profiled(velocity, acceleration, static_cast<std::uint8_t>(driveMode)));
        joint.setGoalPosition(joint.state().position + 1000);
        int ongoing = 0;
        while (joint.state().movingStatus & 2)
            joint.advanceTo((100 + ++ongoing) * ms);
        QVERIFY2(std::abs(ongoing - duration) <= 1, qPrintable(QString::number(ongoing)));
        QCOMPARE(joint.state().movingStatus >> 4, shape);
    }

    void newGoalWhileMovingGoesOnSmoothly()
    {
        Joint joint = ready(profiled(150, 20));
        joint.setGoalPosition(2048 + 2000);
        JointState last = joint.state();
        const int goals[] = {2048 - 500, 2048 + 900, 2048 + 100, 2048};
        for (int t = 1; t <= 4000; ++t) {
            joint.advanceTo((100 + t) * ms);
            if (t % 450 == 0 && t / 450 <= 4)
                joint.setGoalPosition(goals[t / 450 - 1]);
            const JointState state = joint.state();
            QVERIFY(std::abs(state.velocityTrajectory - last.velocityTrajectory) <= 1);
            QVERIFY(std::abs(state.positionTrajectory - last.positionTrajectory) <= 4);
            last = state;
        }
        QCOMPARE(last.positionTrajectory, 2048);
    }

    void notFollowingWhenHeld()
    {
        Joint joint = ready(profiled(100, 20));
        joint.setExtraInertia(1000);
        joint.setGoalPosition(2048 + 2048);
        joint.advanceTo(900 * ms);
        QVERIFY(joint.state().movingStatus & 8);
    }

    void velocityMode_data()
    {
        QTest::addColumn<QString>("model");
        QTest::addColumn<int>("goal");
        QTest::newRow("XM430") << "XM430-W350" << 150;
        QTest::newRow("XM430 back") << "XM430-W350" << -150;
        QTest::newRow("XL430") << "XL430-W250" << 200;
        QTest::newRow("XL330") << "XL330-M288" << 400;
    }

    void velocityMode()
    {
        QFETCH(QString, model);
        QFETCH(int, goal);
        Joint joint = ready(defaults(model, 1), model);
        joint.setGoalVelocity(goal);
        QCOMPARE(joint.state().velocityTrajectory, goal);
        joint.advanceTo(1100 * ms);
        QVERIFY(std::abs(joint.state().velocity - goal) <= 0.03 * std::abs(goal) + 1);
        QVERIFY(joint.state().moving);
        joint.setLoadTorque(goal > 0 ? -0.03 : 0.03); // the integral makes up for it
        joint.advanceTo(4 * second);
        QVERIFY(std::abs(joint.state().velocity - goal) <= 0.02 * std::abs(goal) + 1);
        joint.setLoadTorque(0);
        joint.setGoalVelocity(0);
        joint.advanceTo(8 * second);
        QCOMPARE(joint.state().velocity, 0);
        QVERIFY(!joint.state().moving);
    }

    void velocityModeUsesProfileAcceleration()
    {
        JointSettings settings = profiled(1, 20); // Profile Velocity has no say
        settings.operatingMode = 1;
        Joint joint = ready(settings);
        joint.setGoalVelocity(100); // 320 ms
        joint.advanceTo(260 * ms);
        QCOMPARE(joint.state().velocityTrajectory, 50);
        QVERIFY(joint.state().movingStatus & 2);
        joint.setGoalVelocity(0); // from where the ramp is
        joint.advanceTo(340 * ms);
        QCOMPARE(joint.state().velocityTrajectory, 25);
        joint.advanceTo(430 * ms);
        QCOMPARE(joint.state().velocityTrajectory, 0);
        QVERIFY(!(joint.state().movingStatus & 2));
    }

    void velocityGoalAlsoComesWithTheSettings()
    {
        JointSettings settings = defaults(u"XM430-W350", 1);
        Joint joint = ready(settings);
        settings.goalVelocity = 50;
        joint.configure(settings);
        joint.advanceTo(1 * second);
        QVERIFY(std::abs(joint.state().velocity - 50) <= 3);
    }

    void pwmMode()
    {
        JointSettings settings = defaults(u"XM430-W350", 16);
        settings.goalPwm = -400;
        Joint joint = ready(settings);
        joint.advanceTo(1 * second);
        QCOMPARE(joint.state().pwm, -400);
        QVERIFY(joint.state().velocity < -70 && joint.state().velocity > -100);
        settings.pwmLimit = 200;
        joint.configure(settings);
        joint.advanceTo(2 * second);
        QCOMPARE(joint.state().pwm, -200);
    }

    void goalPwmBoundsEveryMode_data()
    {
        QTest::addColumn<int>("mode");
        for (const int mode : {0, 1, 3, 4, 5})
            QTest::addRow("mode %d", mode) << mode;
    }

    void goalPwmBoundsEveryMode()
    {
        QFETCH(int, mode);
        JointSettings settings = defaults(u"XM430-W350", mode);
        settings.goalPwm = 300;
        Joint joint = ready(settings);
        joint.setGoalPosition(4095);
        joint.setGoalVelocity(200);
        int most = 0;
        for (int t = 1; t < 300; ++t) {
            joint.advanceTo((100 + t) * ms);
            most = std::max(most, std::abs(joint.state().pwm));
        }
        QCOMPARE(most, 300);
        QVERIFY(joint.state().velocity < 75);
    }

    void currentMode()
    {
        // 538 mA: 0.98 N·m. A load that takes nearly all of it leaves a slow motion at that current.
        JointSettings settings = defaults(u"XM430-W350", 0);
        settings.goalCurrent = 200;
        Joint joint = ready(settings);
        joint.setLoadTorque(-0.85);
        for (int t = 200; t < 1500; t += 50) {
            joint.advanceTo(t * ms);
            QVERIFY2(std::abs(joint.state().current - 200) <= 10, qPrintable(QString::number(joint.state().current)));
        }
        QVERIFY(joint.state().velocity != 0);
        settings.goalCurrent = -200;
        joint.configure(settings);
        joint.setLoadTorque(0.85);
        joint.advanceTo(1600 * ms);
        QVERIFY(std::abs(joint.state().current + 200) <= 10);
        settings.goalCurrent = 0; // no torque: turned freely from outside
        joint.configure(settings);
        joint.setLoadTorque(0.15);
        joint.advanceTo(4 * second);
        QVERIFY(joint.state().velocity > 20);
        QVERIFY(std::abs(joint.state().current) <= 2);
    }

    void currentLimitIsRespected_data()
    {
        QTest::addColumn<int>("mode");
        QTest::addColumn<int>("goal");
        for (const int mode : {0, 5}) {
            for (const int goal : {50, 150, 400})
                QTest::addRow("mode %d, %d", mode, goal) << mode << goal;
        }
    }

    void currentLimitIsRespected()
    {
        QFETCH(int, mode);
        QFETCH(int, goal);
        JointSettings settings = defaults(u"XM430-W350", mode);
        settings.goalCurrent = goal;
        Joint joint(*findMotor(u"XM430-W350"));
        joint.configure(settings);
        joint.setTorque(true);
        int most = 0;
        for (int t = 1; t < 3000; ++t) {
            if (t % 400 == 1)
                joint.setGoalPosition(t % 800 == 1 ? 4095 : 0);
            if (t == 1500) // turned back by force, for a moment
                joint.setLoadTorque(joint.state().velocity > 0 ? -1.5 : 1.5);
            if (t == 1550)
                joint.setLoadTorque(0);
            joint.advanceTo(t * ms);
            most = std::max(most, std::abs(joint.state().current));
        }
        QVERIFY2(most <= goal * 1.05 + 15, qPrintable(QString::number(most)));
        QVERIFY(most >= goal * 0.9);
        settings.currentLimit = goal / 2; // the limit bounds the goal
        joint.configure(settings);
        joint.advanceTo(4 * second);
        QVERIFY(std::abs(joint.state().current) <= goal / 2 + 15);
    }

    void gravityArmIsHeld()
    {
        const MotorModel &motor = *findMotor(u"XM430-W350");
        Joint joint = ready(JointSettings());
        joint.setGravityArm(1.0); // at 2048, 180°: horizontal, pulls towards larger angles
        joint.advanceTo(2 * second);
        const JointState state = joint.state();
        QCOMPARE(state.velocity, 0);
        QVERIFY(state.position > 2048 && state.position < 2048 + 60); // a proportional controller sags
        const double expected = 1.0 / motor.torqueConstant() * 1000 / 2.69;
        const double friction = motor.coulomb / motor.torqueConstant() * 1000 / 2.69;
        QVERIFY2(std::abs(-state.current - expected) <= friction + 2, qPrintable(QString::number(state.current)));
        QVERIFY(std::abs(state.load + std::lround(1000 / motor.torqueConstant() / motor.stallCurrent)) < 30);
        joint.setTorque(false); // it falls
        joint.advanceTo(4 * second);
        QVERIFY(joint.state().position > 2700);
        QCOMPARE(joint.state().current, 0);
    }

    void reverseIsTheMirror_data()
    {
        QTest::addColumn<int>("mode");
        for (const int mode : {0, 1, 3, 4, 5, 16})
            QTest::addRow("mode %d", mode) << mode;
    }

    void reverseIsTheMirror()
    {
        QFETCH(int, mode);
        JointSettings settings = defaults(u"XM430-W350", mode);
        settings.goalPwm = 500;
        settings.goalCurrent = 300;
        settings.profileVelocity = 100;
        settings.profileAcceleration = 30;
        Joint forward = ready(settings);
        settings.driveMode = 1;
        Joint reverse = ready(settings);
        const int zeroForward = mode == 0 || mode == 16 ? 2048 : forward.state().position;
        const int zeroReverse = mode == 0 || mode == 16 ? -2048 : reverse.state().position;
        forward.setLoadTorque(-0.3);
        reverse.setLoadTorque(0.3);
        forward.setGoalPosition(zeroForward + 700);
        reverse.setGoalPosition(zeroReverse + 700);
        forward.setGoalVelocity(80);
        reverse.setGoalVelocity(80);
        for (int t = 0; t < 2000; t += 10) {
            forward.advanceTo((100 + t) * ms);
            reverse.advanceTo((100 + t) * ms);
            const JointState a = forward.state(), b = reverse.state();
            QVERIFY(std::abs(a.position - zeroForward - (b.position - zeroReverse)) <= 1);
            QVERIFY(std::abs(a.velocity - b.velocity) <= 2);
            QVERIFY(std::abs(a.current - b.current) <= 3);
            QVERIFY(std::abs(a.pwm - b.pwm) <= 7);
        }
        QVERIFY(forward.state().position - zeroForward > 200);
    }

    void sameSeedSameStory()
    {
        std::vector<JointState> stories[3];
        for (int i = 0; i < 3; ++i) {
            Joint joint = ready(JointSettings(), u"XM430-W350", i == 2 ? 7 : 5);
            joint.setGoalPosition(3000);
            for (int t = 100; t < 600; ++t) {
                if (i == 1) { // asked more often: nothing else
                    joint.advanceTo(t * ms + 300);
                    joint.state();
                }
                joint.advanceTo((t + 1) * ms);
                stories[i].push_back(joint.state());
            }
        }
        int differences = 0;
        for (std::size_t k = 0; k < stories[0].size(); ++k) {
            QVERIFY(same(stories[0][k], stories[1][k]));
            QCOMPARE(stories[0][k].position, stories[2][k].position); // noise is of the sensors, not of the motion
            QVERIFY(std::abs(stories[0][k].velocity - stories[2][k].velocity) <= 2);
            QVERIFY(std::abs(stories[0][k].current - stories[2][k].current) <= 2);
            differences += stories[0][k].current != stories[2][k].current;
        }
        QVERIFY(differences > 50);
    }

    void restIsQuiet()
    {
        Joint joint = ready(JointSettings());
        joint.setGoalPosition(2500);
        joint.advanceTo(3 * second);
        const JointState rest = joint.state();
        for (int t = 0; t < 500; ++t) {
            joint.advanceTo(3 * second + t * 7 * ms);
            QCOMPARE(joint.state().position, rest.position);
            QCOMPARE(joint.state().velocity, 0);
            QVERIFY(std::abs(joint.state().current - rest.current) <= 2);
        }
    }

    void torqueOffCoastsTorqueOnHolds()
    {
        Joint joint = ready(defaults(u"XM430-W350", 1));
        joint.setGoalVelocity(150);
        joint.advanceTo(1 * second);
        joint.setTorque(false);
        QVERIFY(!joint.torque());
        joint.advanceTo(1010 * ms);
        QVERIFY(joint.state().velocity > 50);
        QCOMPARE(joint.state().current, 0);
        QCOMPARE(joint.state().pwm, 0);
        joint.setGoalVelocity(150); // ignored
        joint.advanceTo(3 * second);
        QCOMPARE(joint.state().velocity, 0);
        joint.configure(JointSettings());
        const int position = joint.state().position;
        joint.setTorque(true);
        joint.advanceTo(4 * second);
        QCOMPARE(joint.state().position, position);
        QCOMPARE(joint.state().positionTrajectory, position);
    }

    void watchdogStopsEveryMode_data() { goalPwmBoundsEveryMode_data(); QTest::newRow("mode 16") << 16; }

    void watchdogStopsEveryMode()
    {
        QFETCH(int, mode);
        JointSettings settings = defaults(u"XM430-W350", mode);
        settings.goalCurrent = 300;
        settings.goalPwm = 600;
        Joint joint = ready(settings);
        joint.setGoalPosition(9000);
        joint.setGoalVelocity(100);
        joint.advanceTo(500 * ms);
        QVERIFY(joint.state().velocity > 30);
        joint.stopMotion();
        joint.advanceTo(2 * second);
        QCOMPARE(joint.state().velocity, 0);
        const int position = joint.state().position;
        joint.endStop();
        joint.setGoalPosition(position + 500);
        joint.setGoalVelocity(50);
        joint.advanceTo(3 * second);
        QVERIFY(joint.state().position > position + 100);
    }

    void turnsAreForgotten()
    {
        for (const int driveMode : {0, 1}) {
            JointSettings settings = defaults(u"XM430-W350", 4);
            settings.driveMode = static_cast<std::uint8_t>(driveMode);
            Joint joint = ready(settings);
            joint.setGoalPosition(3 * 4096 + 1000);
            joint.advanceTo(10 * second);
            const JointState before = joint.state();
            joint.reduceToOneTurn();
            const JointState after = joint.state();
            QCOMPARE(after.position, before.position - 3 * 4096);
            QCOMPARE(after.positionTrajectory, before.positionTrajectory - 3 * 4096);
            joint.advanceTo(12 * second);
            QCOMPARE(joint.state().position, after.position);
        }
    }

    void warmsUnderLoadAndCools()
    {
        JointSettings settings = defaults(u"XM430-W350", 16);
        Joint joint = ready(settings);
        joint.setLoadTorque(-4.2);
        const int cold = joint.state().temperature;
        QVERIFY(cold >= 25 && cold <= 32);
        QVERIFY(!joint.state().overload);
        joint.advanceTo(3 * second);
        QVERIFY(joint.state().overload);
        QVERIFY(joint.state().inputVoltage <= 11.85);
        joint.advanceTo(30 * second);
        QVERIFY(joint.state().temperature >= cold + 5 && joint.state().temperature <= 70);
        joint.advanceTo(240 * second);
        QVERIFY(joint.state().temperature > 80);
        joint.setLoadTorque(0);
        joint.setTorque(false);
        joint.advanceTo(3600 * second);
        QVERIFY(!joint.state().overload);
        QVERIFY(std::abs(joint.state().temperature - cold) <= 2);
        joint.setAmbientTemperature(40);
        joint.advanceTo(2 * 3600 * second);
        QVERIFY(joint.state().temperature >= 42);
    }

    /// A jump over rest ends in the state that small steps would have come to, and takes no time.
    void longRestIsSkipped()
    {
        Joint jump = ready(JointSettings()), stepped = ready(JointSettings());
        for (Joint *joint : {&jump, &stepped}) {
            joint->setGravityArm(1.5);
            joint->setGoalPosition(2500);
            joint->advanceTo(2 * second);
        }
        for (int t = 0; t < 3600; ++t)
            stepped.advanceTo((2 + t) * second);
        QElapsedTimer timer;
        timer.start();
        jump.advanceTo(3601 * second);
        QVERIFY(same(jump.state(), stepped.state()));
        jump.advanceTo(20LL * 365 * 86400 * second);
        QVERIFY(timer.elapsed() < 2000);
        jump.setGoalPosition(3000);
        jump.advanceTo(20LL * 365 * 86400 * second + second);
        QVERIFY(std::abs(jump.state().position - 3000) < 60);
    }

    void timeNeverGoesBack()
    {
        Joint joint = ready(JointSettings());
        joint.setGoalPosition(3000);
        joint.advanceTo(300 * ms);
        const JointState state = joint.state();
        joint.advanceTo(100 * ms);
        joint.advanceTo(-5);
        QVERIFY(same(joint.state(), state));
    }

    void survivesWildRegisters_data()
    {
        QTest::addColumn<int>("value");
        for (const int value : {0, 1, -1, 32767, -32768, INT_MAX, INT_MIN})
            QTest::addRow("%d", value) << value;
    }

    void survivesWildRegisters()
    {
        QFETCH(int, value);
        for (const int mode : {0, 1, 2, 3, 4, 5, 16, 255, -1}) {
            for (const int driveMode : {0, 1, 4, 5, 255}) {
                for (const double unit : {0.0, 1.0}) {
                    Joint joint(*findMotor(u"XL330-M288"));
                    JointSettings s;
                    s.operatingMode = mode;
                    s.driveMode = static_cast<std::uint8_t>(driveMode);
                    for (int *field : {&s.positionP, &s.positionI, &s.positionD, &s.feedforward1, &s.feedforward2,
                                       &s.velocityP, &s.velocityI, &s.pwmLimit, &s.currentLimit, &s.velocityLimit,
                                       &s.goalPwm, &s.goalCurrent, &s.goalVelocity, &s.profileVelocity,
                                       &s.profileAcceleration, &s.movingThreshold})
                        *field = value;
                    s.currentUnit *= unit;
                    s.velocityUnit *= unit;
                    joint.configure(s);
                    joint.setTorque(true);
                    joint.advanceTo(50 * ms);
                    joint.setGoalPosition(value);
                    joint.setGoalVelocity(value);
                    joint.setSupplyVoltage(value);
                    joint.advanceTo(200 * ms);
                    joint.setShaftAngle(value);
                    joint.reduceToOneTurn();
                    joint.advanceTo(300 * ms);
                    const JointState state = joint.state();
                    QVERIFY(std::abs(state.pwm) <= 885);
                    QVERIFY(std::abs(state.load) <= 1000);
                    QVERIFY(state.temperature > -1000 && state.temperature < 1000);
                }
            }
        }
    }
};

DYNASCOPE_CORE_TEST(TestJoint)
#include "tst_joint.moc"
