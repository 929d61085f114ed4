// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/controller.h"
#include "core/sim/joint.h"
#include "core/sim/motor.h"
#include "tests/support/testmain.h"

using namespace dynascope::sim;

namespace {

constexpr double PulsesPerTurn = 4096;

JointSettings mode(int operatingMode)
{
    JointSettings settings;
    settings.operatingMode = operatingMode;
    settings.positionI = settings.velocityI = 0;
    return settings;
}

} // namespace

class TestController : public QObject
{
    Q_OBJECT

    static Controller made() { return Controller(genericMotor()); }

private slots:
    void positionIsProportional_data()
    {
        QTest::addColumn<double>("error"); // pulses
        QTest::addColumn<int>("gain");
        QTest::addColumn<double>("pwm");
        QTest::newRow("none") << 0.0 << 800 << 0.0;
        QTest::newRow("small") << 16.0 << 800 << 100.0; // gain / 128
        QTest::newRow("back") << -16.0 << 800 << -100.0;
        QTest::newRow("half the gain") << 16.0 << 400 << 50.0;
        QTest::newRow("bounded") << 4000.0 << 800 << 885.0;
        QTest::newRow("bounded, back") << -4000.0 << 800 << -885.0;
    }

    void positionIsProportional()
    {
        QFETCH(double, error);
        QFETCH(int, gain);
        JointSettings settings = mode(3);
        settings.positionP = gain;
        Feedback feedback;
        feedback.position = 1000;
        feedback.wanted.position = 1000 + error;
        Controller controller = made();
        QTEST(controller.pwm(settings, {}, feedback), "pwm");
    }

    void theSumGrowsAndIsForgotten()
    {
        JointSettings settings = mode(3);
        settings.positionP = 0;
        settings.positionI = 65536; // one PWM a pulse and millisecond
        Feedback feedback;
        feedback.wanted.position = 2;
        Controller controller = made();
        QCOMPARE(controller.pwm(settings, {}, feedback), 2.0);
        QCOMPARE(controller.pwm(settings, {}, feedback), 4.0);
        QVERIFY(!(controller == made()));
        controller.reset();
        QVERIFY(controller == made());
        for (int i = 0; i < 10'000; ++i)
            QVERIFY(controller.pwm(settings, {}, feedback) <= settings.fullPwm);
        feedback.wanted.position = -2; // it did not wind up beyond its bound
        QVERIFY(controller.pwm(settings, {}, feedback) < settings.fullPwm);
    }

    void speedDampsAndFeedForwardHelps()
    {
        JointSettings settings = mode(3);
        settings.positionP = 0;
        settings.positionD = 160; // ten PWM a pulse/ms
        Feedback feedback;
        feedback.velocity = 3;
        QCOMPARE(made().pwm(settings, {}, feedback), -30.0);
        feedback.wanted.velocity = 3;
        QCOMPARE(made().pwm(settings, {}, feedback), 0.0);
        settings.feedforward1 = 40; // ten again
        QCOMPARE(made().pwm(settings, {}, feedback), 30.0);
    }

    void velocityByItsError()
    {
        const JointSettings settings = mode(1); // P 100 / 128 a register unit of 0.229 rev/min
        Feedback feedback;
        feedback.wanted.velocity = 128 * settings.velocityUnit * PulsesPerTurn / 60'000;
        QVERIFY(std::abs(made().pwm(settings, {}, feedback) - 100) < 1e-6);
        feedback.velocity = feedback.wanted.velocity;
        QVERIFY(std::abs(made().pwm(settings, {}, feedback)) < 1e-6);
    }

    void pwmModeIsTheOrderItself_data()
    {
        QTest::addColumn<int>("goal");
        QTest::addColumn<int>("limit");
        QTest::addColumn<double>("pwm");
        QTest::newRow("forward") << 300 << 885 << 300.0;
        QTest::newRow("back") << -300 << 885 << -300.0;
        QTest::newRow("limited") << 700 << 500 << 500.0;
        QTest::newRow("limited, back") << -700 << 500 << -500.0;
    }

    void pwmModeIsTheOrderItself()
    {
        QFETCH(int, goal);
        QFETCH(int, limit);
        JointSettings settings = mode(16);
        settings.goalPwm = goal;
        settings.pwmLimit = limit;
        QTEST(made().pwm(settings, {}, {}), "pwm");
    }

    /// In every mode; no more than the limit, whatever the goal.
    void goalPwmBounds()
    {
        for (const int operatingMode : {0, 1, 3, 4, 5}) {
            JointSettings settings = mode(operatingMode);
            settings.goalPwm = 50;
            Feedback feedback;
            feedback.wanted.position = feedback.wanted.velocity = 1e6;
            const double pwm = made().pwm(settings, {}, feedback);
            QVERIFY2(pwm > 0 && pwm <= 50, qPrintable(QStringLiteral("mode %1: %2").arg(operatingMode).arg(pwm)));
            settings.goalPwm = 5000;
            settings.pwmLimit = 80;
            QVERIFY(made().pwm(settings, {}, feedback) <= 80);
        }
    }

    /// A stalled motor: more goal current is more PWM, none is none, and in the other direction the same.
    void currentFollowsItsGoal()
    {
        const auto pwm = [](int goalCurrent) {
            JointSettings settings = mode(0);
            settings.goalCurrent = goalCurrent;
            return made().pwm(settings, {}, {});
        };
        QCOMPARE(pwm(0), 0.0);
        QVERIFY(pwm(100) > 0 && pwm(200) > pwm(100));
        QCOMPARE(pwm(-200), -pwm(200));
        JointSettings limited = mode(0);
        limited.currentLimit = 100;
        limited.goalCurrent = 1000;
        QCOMPARE(made().pwm(limited, {}, {}), pwm(100));
    }
};

DYNASCOPE_CORE_TEST(TestController)
#include "tst_controller.moc"
