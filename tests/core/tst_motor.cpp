// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/motor.h"
#include "core/sim/plant.h"
#include "core/sim/supply.h"
#include "tests/support/testmain.h"

#include <cmath>

using namespace dynascope::sim;

namespace {

constexpr double toRpm = 60 / (2 * 3.14159265358979);

bool within5Percent(double value, double expected)
{
    return std::abs(value - expected) <= 0.05 * std::abs(expected);
}

void run(Plant &plant, double seconds, double duty, double volts, bool driven = true)
{
    for (int i = 0; i < int(seconds * 2000); ++i)
        plant.step(0.0005, duty, volts, driven);
}

} // namespace

class TestMotor : public QObject
{
    Q_OBJECT

private slots:
    void findsModels()
    {
        QCOMPARE(findMotor(u"XM430-W350")->name, u"XM430-W350");
        QCOMPARE(findMotor(u"xl330-m288-t")->name, u"XL330-M288");
        QCOMPARE(findMotor(u"XL430-W250")->name, u"XL430-W250");
        QCOMPARE(findMotor(u"MX-28(2.0)")->name, u"MX-28(2.0)");
        QCOMPARE(findMotor(u"M54-60-S250-R(A)")->name, u"M54-60-S250-R(A)");
        QCOMPARE(findMotor(u"M54-60-S250-R")->name, u"M54-60-S250-R");
        QCOMPARE(findMotor(u"XL430-W2500"), &genericMotor());
        QCOMPARE(findMotor(u""), &genericMotor());
    }

    /// Data sheets: recommended voltage first, then the others they give.
    void dataSheet_data()
    {
        QTest::addColumn<QString>("model");
        QTest::addColumn<double>("volts");
        QTest::addColumn<double>("torque");
        QTest::addColumn<double>("current");
        QTest::addColumn<double>("rpm");
        QTest::newRow("XM430 12 V") << "XM430-W350" << 12.0 << 4.1 << 2.3 << 46.0;
        QTest::newRow("XM430 11.1 V") << "XM430-W350" << 11.1 << 3.8 << 2.1 << 43.0;
        QTest::newRow("XM430 14.8 V") << "XM430-W350" << 14.8 << 4.8 << 2.7 << 57.0;
        QTest::newRow("XL430 11.1 V") << "XL430-W250" << 11.1 << 1.4 << 1.3 << 57.0;
        QTest::newRow("XL430 12 V") << "XL430-W250" << 12.0 << 1.5 << 1.4 << 61.0;
        QTest::newRow("XL330 5 V") << "XL330-M288" << 5.0 << 0.52 << 1.47 << 103.0;
        QTest::newRow("XL330 6 V") << "XL330-M288" << 6.0 << 0.60 << 1.74 << 123.0;
    }

    void dataSheet()
    {
        QFETCH(QString, model);
        QFETCH(double, volts);
        QFETCH(double, torque);
        QFETCH(double, current);
        QFETCH(double, rpm);
        const MotorModel &motor = *findMotor(model);

        Plant free(motor);
        run(free, 1, 1, volts);
        QVERIFY2(within5Percent(free.speed() * toRpm, rpm), qPrintable(QString::number(free.speed() * toRpm)));
        QVERIFY(free.current() < 0.15 * current);

        const double sagged = volts - Supply::UsualResistance * current;
        // Stall: it carries 5 % less than the stated torque round; 5 % more, and friction both ways, turns it back.
        Plant held(motor);
        held.load().setTorque(-torque * 0.95);
        run(held, 1, 1, sagged);
        QVERIFY(held.speed() > 0);
        Plant stalled(motor);
        stalled.load().setTorque(-torque);
        run(stalled, 0.0005, 1, sagged);
        QVERIFY2(within5Percent(stalled.current(), current), qPrintable(QString::number(stalled.current())));
        Plant overcome(motor);
        overcome.load().setTorque(-torque * 1.05 - 2 * motor.coulomb);
        run(overcome, 1, 1, sagged);
        QVERIFY(overcome.speed() < 0);
    }

    void backEmfLessensTheCurrent()
    {
        const MotorModel &motor = *findMotor(u"XM430-W350");
        Plant plant(motor);
        run(plant, 1, 0.5, 12);
        // Half the voltage, nearly half the speed; the rest of it is the current that friction needs.
        const double emf = plant.speed() * motor.backEmf();
        QVERIFY(emf > 0.4 * motor.voltage && emf < 0.5 * motor.voltage);
        QVERIFY(std::abs(plant.current() - (0.5 * motor.voltage - emf) / motor.resistance()) < 1e-6);
        // Short-circuited by a bridge at zero it brakes, open it coasts.
        Plant coasting = plant;
        run(plant, 0.02, 0, 12);
        QVERIFY(plant.current() < 0);
        run(coasting, 0.02, 0, 12, false);
        QCOMPARE(coasting.current(), 0.0);
        QVERIFY(coasting.speed() > 1.5 * plant.speed());
    }

    void frictionHoldsSmallTorques()
    {
        const MotorModel &motor = *findMotor(u"XL430-W250");
        Plant plant(motor);
        const double before = plant.angle();
        plant.load().setTorque(motor.coulomb * 0.99);
        run(plant, 1, 0, 12, false);
        QCOMPARE(plant.angle(), before);
        plant.load().setTorque(motor.coulomb * 1.5);
        run(plant, 1, 0, 12, false);
        QVERIFY(plant.angle() > before);
    }

    void gravityPullsDown()
    {
        Plant plant(*findMotor(u"XM430-W350"));
        plant.setAngle(0);
        plant.load().setGravityArm(1);
        run(plant, 20, 0, 12, false);
        QVERIFY(std::abs(plant.angle() + 3.14159265 / 2) < 0.12); // friction lets it rest near straight down
        QCOMPARE(plant.speed(), 0.0);
    }

    void warmsOverMinutes()
    {
        const MotorModel &motor = *findMotor(u"XM430-W350");
        Warmth warmth(motor, 25);
        QVERIFY(warmth.body() > 27 && warmth.body() < 32); // the electronics alone
        const double start = warmth.body();
        for (int i = 0; i < 600; ++i)
            warmth.step(0.1, 10, 0.5);
        QVERIFY(warmth.winding() > warmth.body() + 10);
        QVERIFY(warmth.body() > start + 3 && warmth.body() < start + 15); // 10 W for a minute
        for (int i = 0; i < 100; ++i)
            warmth.step(100, 10, 0.5);
        QVERIFY(std::abs(warmth.body() - (25 + 10.5 * motor.caseToAmbient)) < 0.1);
        QVERIFY(std::abs(warmth.winding() - warmth.body() - 10 * motor.windingToCase) < 0.1);
    }

    void survivesWildNumbers()
    {
        for (const double wild : {0.0, -1.0, 1e300, -1e300, std::nan(""), HUGE_VAL}) {
            Plant plant(genericMotor());
            plant.setAngle(wild);
            plant.load().setTorque(wild);
            plant.load().setGravityArm(wild);
            plant.load().setInertia(wild);
            plant.load().setStops(wild, -wild);
            plant.load().push(wild, wild);
            plant.load().hold(wild);
            run(plant, 1, 1, 100);
            run(plant, 1, -1, 100);
            run(plant, 1, 0, 0, false);
            QVERIFY(std::isfinite(plant.angle()) && std::isfinite(plant.speed()) && std::isfinite(plant.current()));
        }
    }
};

DYNASCOPE_CORE_TEST(TestMotor)
#include "tst_motor.moc"
