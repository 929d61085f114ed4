// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/motor.h"

#include <QFile>
#include <QJsonDocument>

#include <vector>

namespace dynascope::sim {

namespace {

constexpr qint64 LargestFile = 1 << 20; ///< bytes

/// Made once and never changed: data of the program, like its control tables.
const std::vector<MotorModel> &motors()
{
    static const std::vector<MotorModel> all = [] {
        std::vector<MotorModel> made;
        QFile file(QStringLiteral(":/motors/motors.json"));
        if (!file.open(QIODevice::ReadOnly))
            return made;
        const QJsonObject entries =
            QJsonDocument::fromJson(file.read(LargestFile)).object().value(u"motors").toObject();
        for (auto entry = entries.begin(); entry != entries.end(); ++entry)
            made.push_back(motorFromFigures(entry.key(), entry->toObject()));
        return made;
    }();
    return all;
}

/// "XM430-W350" is also "xm430-w350-t", but not "XM430-W3500".
bool isCalled(const MotorModel &motor, QStringView model)
{
    return model.startsWith(motor.name, Qt::CaseInsensitive)
           && (model.size() == motor.name.size() || model.at(motor.name.size()) == u'-');
}

} // namespace

const MotorModel *findMotor(QStringView model)
{
    const MotorModel *found = &genericMotor();
    for (const MotorModel &motor : motors()) {
        if (isCalled(motor, model) && (found == &genericMotor() || motor.name.size() > found->name.size()))
            found = &motor;
    }
    return found;
}

const MotorModel &genericMotor()
{
    static const MotorModel generic = motorFromFigures(QStringLiteral("generic"), {});
    return generic;
}

} // namespace dynascope::sim
