// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/profile.h"
#include "tests/support/testmain.h"

#include <algorithm>
#include <cmath>
#include <limits>

using namespace dynascope::sim;

namespace {

bool near(double a, double b, double tolerance = 1e-6)
{
    return std::abs(a - b) <= tolerance * std::max(1.0, std::max(std::abs(a), std::abs(b)));
}

} // namespace

class TestProfile : public QObject
{
    Q_OBJECT

private slots:
    void shapes_data()
    {
        QTest::addColumn<bool>("timeBased");
        QTest::addColumn<double>("velocity");
        QTest::addColumn<double>("acceleration");
        QTest::addColumn<double>("distance");
        QTest::addColumn<int>("shape");
        QTest::addColumn<double>("duration");
        QTest::addColumn<double>("top");

        // d / v + v / a where the top speed is reached; 2 √(d / a) where it isn't.
        QTest::newRow("step") << false << 0.0 << 0.0 << 1000.0 << 0 << 0.0 << 0.0;
        QTest::newRow("rectangle") << false << 2.0 << 0.0 << 1000.0 << 1 << 500.0 << 2.0;
        QTest::newRow("rectangle back") << false << 2.0 << 0.0 << -1000.0 << 1 << 500.0 << 2.0;
        QTest::newRow("trapezoid") << false << 2.0 << 0.01 << 1000.0 << 3 << 700.0 << 2.0;
        QTest::newRow("trapezoid back") << false << 2.0 << 0.01 << -1000.0 << 3 << 700.0 << 2.0;
        QTest::newRow("triangle") << false << 5.0 << 0.01 << 1000.0 << 2 << 632.4555320336759 << 3.1622776601683795;
        QTest::newRow("no top speed") << false << 0.0 << 0.01 << 1000.0 << 2 << 632.4555320336759 << 3.1622776601683795;
        QTest::newRow("time: step") << true << 0.0 << 300.0 << 1000.0 << 0 << 0.0 << 0.0;
        QTest::newRow("time: rectangle") << true << 500.0 << 0.0 << 1000.0 << 1 << 500.0 << 2.0;
        QTest::newRow("time: trapezoid") << true << 500.0 << 100.0 << 1000.0 << 3 << 500.0 << 2.5;
        QTest::newRow("time: triangle") << true << 500.0 << 250.0 << 1000.0 << 2 << 500.0 << 4.0;
        QTest::newRow("time: ramp cut to half") << true << 500.0 << 9999.0 << 1000.0 << 2 << 500.0 << 4.0;
        QTest::newRow("no way to go") << false << 2.0 << 0.01 << 0.0 << 0 << 0.0 << 0.0;
    }

    void shapes()
    {
        QFETCH(bool, timeBased);
        QFETCH(double, velocity);
        QFETCH(double, acceleration);
        QFETCH(double, distance);
        QFETCH(int, shape);
        QFETCH(double, duration);
        QFETCH(double, top);

        const PositionProfile profile({100, 0, 0}, 100 + distance, {timeBased, velocity, acceleration});
        QCOMPARE(int(profile.shape()), shape);
        QVERIFY(near(profile.duration(), duration));
        double fastest = 0;
        for (double t = 0; t < duration; t += 0.25) {
            const TrajectoryPoint point = profile.at(t);
            fastest = std::max(fastest, std::abs(point.velocity));
            QVERIFY(point.velocity * distance >= 0); // never away from the goal
        }
        QVERIFY(near(fastest, top, 0.01));
        QCOMPARE(profile.at(duration), (TrajectoryPoint{100 + distance, 0, 0}));
        QCOMPARE(profile.at(1e12), (TrajectoryPoint{100 + distance, 0, 0}));
    }

    /// Out of any motion: no jump of position or velocity, acceleration and speed within their limits, the goal
    /// reached.
    void continuous_data()
    {
        QTest::addColumn<double>("from");
        QTest::addColumn<double>("goal");
        for (const double from : {-3.0, -1.0, 0.0, 0.5, 2.0, 6.0}) {
            for (const double goal : {-2000.0, -50.0, 0.0, 30.0, 400.0, 5000.0})
                QTest::addRow("%g pulses/ms, %g pulses", from, goal) << from << goal;
        }
    }

    void continuous()
    {
        QFETCH(double, from);
        QFETCH(double, goal);
        const double v = 2, a = 0.01;
        for (const ProfileLimits &limits :
             {ProfileLimits{false, v, a}, {false, 0, a}, {true, 800, 200}, {true, 800, 400}}) {
            const PositionProfile profile({0, from, 0}, goal, limits);
            QCOMPARE(profile.at(0).position, 0.0);
            QCOMPARE(profile.at(0).velocity, from);
            TrajectoryPoint last = profile.at(0);
            const double step = 0.125;
            for (double t = step; t < profile.duration() + 1; t += step) {
                const TrajectoryPoint point = profile.at(t);
                if (!limits.timeBased) {
                    QVERIFY(std::abs(point.velocity - last.velocity) <= a * step * 1.0001);
                    if (limits.velocity > 0)
                        QVERIFY(std::abs(point.velocity) <= std::max(v, std::abs(from)) + 1e-9);
                }
                QVERIFY(std::abs(point.velocity - last.velocity) < 0.2);
                const double mean = (point.velocity + last.velocity) / 2;
                QVERIFY(std::abs(point.position - last.position - mean * step) < 0.01); // velocity is the slope
                last = point;
            }
            QCOMPARE(last, (TrajectoryPoint{goal, 0, 0}));
        }
    }

    void turnsRoundWhereTheGoalLiesBehind()
    {
        const PositionProfile profile({0, 2, 0}, 100, {false, 2, 0.01}); // braking takes 200 pulses
        double farthest = 0;
        for (double t = 0; t < profile.duration(); ++t)
            farthest = std::max(farthest, profile.at(t).position);
        QVERIFY(near(farthest, 200, 0.01));
        QVERIFY(near(profile.duration(), 200 + 2 * 100, 0.01)); // brake, and a triangle of 100 pulses back
    }

    void survivesWildNumbers()
    {
        const double wild[] = {0, 1e-9, 1, 32767, 2147483647.0, -2147483648.0};
        for (const bool timeBased : {false, true}) {
            for (const double velocity : {0.0, 1e-9, 1.0, 2147483647.0}) {
                for (const double acceleration : {0.0, 1e-9, 1.0, 2147483647.0}) {
                    for (const double goal : wild) {
                        for (const double from : {0.0, 1e-3, 500.0, -500.0}) {
                            const PositionProfile profile({7, from, 0}, goal, {timeBased, velocity, acceleration});
                            QVERIFY(std::isfinite(profile.duration()) && profile.duration() >= 0);
                            for (const double share : {0.0, 0.1, 0.5, 0.9, 1.0}) {
                                const TrajectoryPoint point = profile.at(profile.duration() * share);
                                QVERIFY(std::isfinite(point.position) && std::isfinite(point.velocity)
                                        && std::isfinite(point.acceleration));
                            }
                        }
                    }
                }
            }
        }
    }

    void shiftMovesAllOfIt()
    {
        PositionProfile profile({0, 1, 0}, 1000, {false, 2, 0.01});
        const PositionProfile before = profile;
        profile.shift(-4096);
        for (double t = 0; t < 1000; t += 10)
            QVERIFY(near(profile.at(t).position, before.at(t).position - 4096));
        QCOMPARE(profile.goal(), 1000.0 - 4096);
    }

    void velocityRamp()
    {
        const VelocityRamp ramp(1, -3, {false, 999, 0.01});
        QVERIFY(near(ramp.duration(), 400)); // Profile Velocity has no say here
        QVERIFY(near(ramp.at(100), 0));
        QCOMPARE(ramp.at(400), -3.0);
        QCOMPARE(VelocityRamp(1, -3, {false, 5, 0}).at(0), -3.0);
        QVERIFY(near(VelocityRamp(0, 4, {true, 0, 200}).at(50), 1));
        QCOMPARE(VelocityRamp().at(5), 0.0);
    }
};

DYNASCOPE_CORE_TEST(TestProfile)
#include "tst_profile.moc"
