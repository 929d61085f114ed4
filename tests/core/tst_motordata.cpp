// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/joint.h"
#include "tests/support/testmain.h"

#include <QFile>
#include <QJsonDocument>

#include <cmath>

using namespace dynascope::sim;

/// resources/motors.json: every motor in it is one that can be played, and says what of it is known.
class TestMotorData : public QObject
{
    Q_OBJECT

private slots:
    void initTestCase()
    {
        QFile file(QStringLiteral(DYNASCOPE_SOURCE_DIR "/resources/motors.json"));
        QVERIFY(file.open(QIODevice::ReadOnly));
        QJsonParseError error;
        m_motors = QJsonDocument::fromJson(file.readAll(), &error).object().value(u"motors").toObject();
        QVERIFY2(error.error == QJsonParseError::NoError, qPrintable(error.errorString()));
        QCOMPARE(m_motors.size(), 73);
    }

    void everyMotorCanBePlayed()
    {
        for (auto entry = m_motors.begin(); entry != m_motors.end(); ++entry) {
            const QByteArray name = entry.key().toUtf8();
            const MotorModel &motor = *findMotor(entry.key());
            QVERIFY2(motor.name == entry.key(), name.constData());
            // A motor gives back no more than it takes, as far as data sheets go, and is as fast as they say.
            QVERIFY2(motor.torqueConstant() > 0 && motor.torqueConstant() < motor.voltage / motor.freeRadians() * 1.25,
                     name.constData());
            QVERIFY2(motor.freeCurrent() < 0.9 * motor.stallCurrent, name.constData());
            const double time = motor.inertia * motor.freeRadians() / motor.stallTorque;
            QVERIFY2(time > 0.004 && time < 0.041, name.constData());
            Plant plant(motor);
            for (int i = 0; i < 2000; ++i)
                plant.step(0.0005, 1, motor.voltage, true);
            QVERIFY2(std::abs(plant.speed() / motor.freeRadians() - 1) < 0.02, name.constData());
            QVERIFY2(motor.overloadCurrent > motor.freeCurrent(), name.constData());
        }
    }

    /// What is in the file is known, with that value; all the rest is said to be chosen.
    void knownIsWhatTheFileSays()
    {
        for (auto entry = m_motors.begin(); entry != m_motors.end(); ++entry) {
            const MotorModel &motor = *findMotor(entry.key());
            const QJsonObject figures = entry->toObject();
            const auto check = [&](MotorModel::Figure figure, const char16_t *key, double value, double scale = 1) {
                const QJsonValue stated = figures.value(QStringView(key));
                QCOMPARE(motor.isKnown(figure), stated.isDouble());
                if (stated.isDouble())
                    QCOMPARE(value, stated.toDouble() / scale);
            };
            check(MotorModel::Voltage, u"voltage", motor.voltage);
            check(MotorModel::StallTorque, u"stallTorque", motor.stallTorque);
            check(MotorModel::StallCurrent, u"stallCurrent", motor.stallCurrent);
            check(MotorModel::FreeSpeed, u"freeSpeed", motor.freeSpeed);
            check(MotorModel::GearRatio, u"gearRatio", motor.gearRatio);
            check(MotorModel::Mass, u"weight", motor.mass, 1000);
            check(MotorModel::StandbyCurrent, u"standbyCurrent", motor.standbyCurrent, 1000);
            for (const auto figure : {MotorModel::Inertia, MotorModel::Friction, MotorModel::Heat})
                QVERIFY(!motor.isKnown(figure));
            QCOMPARE(motor.knownFigures().size() + motor.chosenFigures().size(), int(MotorModel::FigureCount));
        }
        QVERIFY(findMotor(u"XM430-W350")->knownFigures().contains(QStringLiteral("stall torque")));
        QVERIFY(findMotor(u"XM430-W350")->chosenFigures().contains(QStringLiteral("inertia")));
        QVERIFY(genericMotor().knownFigures().isEmpty());
    }

    void nonsenseIsNoFigure()
    {
        const MotorModel motor = motorFromFigures(
            QStringLiteral("odd"), {{QStringLiteral("voltage"), -3}, {QStringLiteral("stallTorque"), QStringLiteral("x")},
                                    {QStringLiteral("freeSpeed"), 0}, {QStringLiteral("weight"), 1e300}});
        QVERIFY(motor.knownFigures().isEmpty());
        QVERIFY(motor.resistance() > 0 && motor.inertia > 0 && std::isfinite(motor.caseToAmbient));
    }

private:
    QJsonObject m_motors;
};

DYNASCOPE_CORE_TEST(TestMotorData)
#include "tst_motordata.moc"
