// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/joint.h"
#include "tests/support/testmain.h"

#include <cmath>
#include <numbers>

using namespace dynascope::sim;

namespace {

constexpr double PulsesPerRadian = 4096 / (2 * std::numbers::pi);
constexpr double Band = 0.02; ///< of the step, around the goal: settled

struct Response {
    double overshoot = 0; ///< of the step
    double settling = 0;  ///< ms until it stays in the band
    double peakTime = 0;  ///< ms
};

/// A free joint without friction on a stiff supply, by linear theory:
/// J θ'' + (Kt Ke / R + D) θ' + P (θ − goal) = 0, P and D in N·m/rad and N·m·s/rad.
Response theory(const MotorModel &motor, const JointSettings &gains, double inertia)
{
    const double perDuty = motor.torqueConstant() * motor.voltage / motor.resistance();      // N·m
    const double stiffness = perDuty * gains.positionP / 128.0 / 885 * PulsesPerRadian;      // P: /128
    const double derivative = perDuty * gains.positionD / 16.0 / 885 * PulsesPerRadian / 1000; // D: /16, pulses/ms
    const double damping = motor.torqueConstant() * motor.backEmf() / motor.resistance() + derivative;
    const double natural = std::sqrt(stiffness / inertia);
    const double ratio = damping / (2 * std::sqrt(stiffness * inertia));
    const double swing = natural * std::sqrt(1 - ratio * ratio);
    Response response;
    response.overshoot = std::exp(-std::numbers::pi * ratio / std::sqrt(1 - ratio * ratio));
    response.peakTime = std::numbers::pi / swing * 1000;
    for (double t = 0; t < 30; t += 0.0001) {
        const double turn = std::cos(swing * t) + ratio * natural / swing * std::sin(swing * t);
        const double away = std::exp(-ratio * natural * t) * turn;
        if (std::abs(away) > Band)
            response.settling = t * 1000;
    }
    return response;
}

Response simulated(const MotorModel &motor, const JointSettings &gains, double extraInertia, int step)
{
    Joint joint(motor);
    joint.supply().setResistance(0);
    joint.setExtraInertia(extraInertia);
    joint.configure(gains);
    joint.setTorque(true);
    joint.setGoalPosition(2048 + step);
    Response response;
    for (int t = 1; t < 30000; ++t) {
        joint.advanceTo(t * 1000LL);
        const double at = (joint.plant().angle() * PulsesPerRadian - 2048) / step;
        if (at - 1 > response.overshoot) {
            response.overshoot = at - 1;
            response.peakTime = t;
        }
        if (std::abs(at - 1) > Band)
            response.settling = t;
    }
    return response;
}

bool within(double value, double expected, double share)
{
    return std::abs(value - expected) <= share * std::abs(expected);
}

} // namespace

/// The second-order check: a step in Goal Position shows the overshoot that the gains, the motor and the load deserve.
class TestStepResponse : public QObject
{
    Q_OBJECT

private slots:
    void agreesWithLinearTheory_data()
    {
        QTest::addColumn<QString>("model");
        QTest::addColumn<int>("p");
        QTest::addColumn<int>("d");
        QTest::addColumn<double>("inertia"); // kg·m², of the load
        QTest::addColumn<int>("step");       // pulses; never enough to saturate PWM
        QTest::newRow("XM430, soft, P alone") << "XM430-W350" << 100 << 0 << 0.4 << 1000;
        QTest::newRow("XM430, soft, heavy load") << "XM430-W350" << 100 << 0 << 1.5 << 1000;
        QTest::newRow("XM430, D damps") << "XM430-W350" << 100 << 1500 << 0.4 << 900;
        QTest::newRow("XM430, factory P") << "XM430-W350" << 800 << 0 << 0.4 << 130;
        QTest::newRow("XM430, factory P, more D") << "XM430-W350" << 800 << 4000 << 0.4 << 100;
        QTest::newRow("XL430, P alone") << "XL430-W250" << 80 << 0 << 0.2 << 1000;
        QTest::newRow("XL330, P alone") << "XL330-M288" << 50 << 0 << 0.03 << 1500;
        QTest::newRow("XM540, P and D") << "XM540-W270" << 100 << 1000 << 1.5 << 1000;
    }

    void agreesWithLinearTheory()
    {
        QFETCH(QString, model);
        QFETCH(int, p);
        QFETCH(int, d);
        QFETCH(double, inertia);
        QFETCH(int, step);
        MotorModel motor = *findMotor(model);
        motor.coulomb = motor.viscous = 0;
        JointSettings gains;
        gains.positionP = p;
        gains.positionD = d;
        const Response expected = theory(motor, gains, motor.inertia + inertia);
        QVERIFY2(expected.overshoot > 0.03, qPrintable(QString::number(expected.overshoot))); // else it shows nothing
        const Response found = simulated(motor, gains, inertia, step);
        const auto said = QStringLiteral("overshoot %1 % for %2 %, settling %3 ms for %4 ms, peak at %5 ms for %6 ms")
                              .arg(found.overshoot * 100).arg(expected.overshoot * 100)
                              .arg(found.settling).arg(expected.settling).arg(found.peakTime).arg(expected.peakTime);
        qInfo().noquote() << said;
        QVERIFY2(within(found.overshoot, expected.overshoot, 0.02), qPrintable(said));
        QVERIFY2(within(found.settling, expected.settling, 0.02), qPrintable(said));
        QVERIFY2(within(found.peakTime, expected.peakTime, 0.02), qPrintable(said));
    }
};

DYNASCOPE_CORE_TEST(TestStepResponse)
#include "tst_stepresponse.moc"
