// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/plant.h"
#include "tests/support/testmain.h"

#include <cmath>
#include <limits>

using namespace dynascope::sim;

namespace {

constexpr double Step = 0.001;

void run(Plant &plant, double seconds, double duty, bool driven = true)
{
    for (double at = 0; at < seconds; at += Step)
        plant.step(Step, duty, plant.motor().voltage, driven);
}

bool isNear(double value, double wanted, double part)
{
    return std::abs(value - wanted) <= std::abs(wanted) * part;
}

} // namespace

/// The motor does what its data sheet says.
class TestPlant : public QObject
{
    Q_OBJECT

    const MotorModel &m_motor = *findMotor(u"XM430-W350");

private slots:
    void runsFreeAtItsFreeSpeed()
    {
        for (const double duty : {1.0, -1.0}) {
            Plant plant(m_motor);
            run(plant, 2, duty);
            QVERIFY(isNear(plant.speed(), duty * m_motor.freeRadians(), 0.02));
            QVERIFY(isNear(std::abs(plant.current()), m_motor.freeCurrent(), 0.1));
            QVERIFY(plant.speed() * duty > 0 && plant.angle() * duty > 0);
        }
    }

    void halfTheDutyIsAboutHalfTheSpeed()
    {
        Plant plant(m_motor);
        run(plant, 2, 0.5);
        QVERIFY(plant.speed() > 0.35 * m_motor.freeRadians() && plant.speed() < 0.55 * m_motor.freeRadians());
    }

    void stallsUnderItsStallTorque()
    {
        Plant plant(m_motor);
        plant.load().setTorque(-m_motor.stallTorque);
        run(plant, 1, 1);
        QVERIFY(std::abs(plant.speed()) < 0.1);
        QVERIFY(isNear(plant.current(), m_motor.stallCurrent, 0.05));
        QVERIFY(isNear(plant.copperPower(), m_motor.stallCurrent * m_motor.voltage, 0.1));
    }

    void frictionHoldsWhatIsSmall()
    {
        Plant plant(m_motor);
        plant.load().setTorque(0.9 * m_motor.coulomb);
        run(plant, 1, 0, false);
        QCOMPARE(plant.speed(), 0.0);
        QCOMPARE(plant.angle(), 0.0);
        plant.load().setTorque(1.5 * m_motor.coulomb);
        run(plant, 1, 0, false);
        QVERIFY(plant.speed() > 0);
        QCOMPARE(plant.current(), 0.0); // the bridge is open
    }

    void anArmFalls()
    {
        Plant plant(m_motor);
        plant.load().setGravityArm(2);
        run(plant, 10, 0, false);
        const double below = -std::acos(-1.0) / 2;
        QVERIFY2(std::abs(plant.angle() - below) < 0.2, qPrintable(QString::number(plant.angle())));
    }

    void inertiaMakesItSlower()
    {
        Plant light(m_motor), heavy(m_motor);
        heavy.load().setInertia(10 * m_motor.inertia);
        run(light, 0.05, 1);
        run(heavy, 0.05, 1);
        QVERIFY(heavy.speed() > 0 && heavy.speed() < light.speed() / 2);
    }

    /// No step is too long, and no number from outside too wild.
    void staysFinite()
    {
        Plant plant(m_motor);
        const double wild = std::numeric_limits<double>::infinity();
        plant.load().setTorque(std::nan(""));
        plant.load().setGravityArm(-wild);
        plant.load().setInertia(-1);
        plant.setAngle(wild);
        for (const double seconds : {1e-6, 1.0, 1e6}) {
            plant.step(seconds, 1, plant.motor().voltage, true);
            QVERIFY(std::isfinite(plant.angle()) && std::isfinite(plant.speed()) && std::isfinite(plant.current()));
        }
    }

    void warmsTowardsWhatItsResistancesSay()
    {
        Warmth warmth(m_motor, 25);
        constexpr double Copper = 3, Body = 1;
        for (int i = 0; i < 100'000; ++i)
            warmth.step(0.1, Copper, Body);
        const double body = 25 + (Copper + Body) * m_motor.caseToAmbient;
        QVERIFY(isNear(warmth.body(), body, 0.01));
        QVERIFY(isNear(warmth.winding(), body + Copper * m_motor.windingToCase, 0.01));
        Warmth once(m_motor, 25);
        once.step(1e9, Copper, Body); // in one step
        QVERIFY(isNear(once.body(), body, 0.01));
        warmth.setAmbient(0);
        warmth.step(1e9, 0, 0);
        QVERIFY(std::abs(warmth.body()) < 0.1);
    }
};

DYNASCOPE_CORE_TEST(TestPlant)
#include "tst_plant.moc"
