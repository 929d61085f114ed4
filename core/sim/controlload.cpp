// SPDX-License-Identifier: GPL-3.0-or-later
// What a control channel does to single devices and what surrounds them.
#include "core/sim/control.h"
#include "core/sim/controlnumbers.h"
#include "core/sim/controlverbs.h"
#include "core/sim/power.h"

namespace dynascope::sim {
namespace {

constexpr double MostTorque = 1000;     ///< N·m
constexpr double MostInertia = 1000;    ///< kg·m²
constexpr double MostVolts = 100;
constexpr double MostDegrees = 1e6;
constexpr double LongestPush = 3600;    ///< s
constexpr double ColdestAmbient = -100, HottestAmbient = 300; ///< °C

} // namespace

Control::Answer Control::eachWithNumber(const Call &call, QStringView unit, double low, double high,
                                        const std::function<void(Servo &, double)> &set)
{
    const auto number = numberOf(call.words[1], unit, low, high);
    if (!number)
        return noNumber(call.words[1], unit, low, high);
    const auto found = who(call.words[0], call.bus);
    if (!found)
        return tl::unexpected(found.error());
    for (Servo *servo : *found)
        set(*servo, *number);
    return {};
}

Control::Answer Control::supply(const Call &call)
{
    const auto one = [](Servo &servo, double volts) { verbs::setSupply(servo, volts); };
    if (call.words.size() == 2)
        return eachWithNumber(call, u"V", 0, MostVolts, one);
    const auto volts = numberOf(call.words[0], u"V", 0, MostVolts);
    if (!volts)
        return noNumber(call.words[0], u"V", 0, MostVolts);
    call.bus.power().setVoltage(*volts);
    return {};
}

Control::Answer Control::temperature(const Call &call)
{
    return eachWithNumber(call, u"C", ColdestAmbient, HottestAmbient, [](Servo &servo, double celsius) {
        servo.joint().setAmbientTemperature(celsius);
    });
}

Control::Answer Control::push(const Call &call)
{
    std::optional<double> seconds;
    if (call.words.size() == 3) {
        seconds = numberOf(call.words[2], u"s", 0, LongestPush);
        if (!seconds)
            return noNumber(call.words[2], u"s", 0, LongestPush);
    }
    return eachWithNumber(call, u"Nm", -MostTorque, MostTorque, [&](Servo &servo, double torque) {
        if (seconds)
            servo.joint().push(torque, *seconds);
        else
            servo.joint().setLoadTorque(torque);
    });
}

Control::Answer Control::hold(const Call &call)
{
    if (call.words.size() == 2)
        return eachWithNumber(call, u"deg", -MostDegrees, MostDegrees,
                              [](Servo &servo, double degrees) { servo.joint().hold(degrees); });
    const auto found = who(call.words[0], call.bus);
    if (!found)
        return tl::unexpected(found.error());
    for (Servo *servo : *found)
        servo->joint().hold(verbs::shaftAngle(*servo));
    return {};
}

Control::Answer Control::release(const Call &call)
{
    const auto found = who(call.words[0], call.bus);
    if (!found)
        return tl::unexpected(found.error());
    for (Servo *servo : *found)
        servo->joint().hold(std::nullopt);
    return {};
}

Control::Answer Control::stops(const Call &call)
{
    std::optional<double> lowest, highest;
    if (call.words[1] != u"none") {
        lowest = numberOf(call.words[1], u"deg", -MostDegrees, MostDegrees);
        highest = call.words.size() < 3 ? std::nullopt : numberOf(call.words[2], u"deg", -MostDegrees, MostDegrees);
        if (!lowest || !highest || *lowest >= *highest)
            return wrong(QStringLiteral("stops WHO LOWEST HIGHEST, in degrees, or stops WHO none"));
    }
    const auto found = who(call.words[0], call.bus);
    if (!found)
        return tl::unexpected(found.error());
    for (Servo *servo : *found)
        servo->joint().setStops(lowest, highest);
    return {};
}

Control::Answer Control::gravity(const Call &call)
{
    return eachWithNumber(call, u"Nm", -MostTorque, MostTorque, [](Servo &servo, double torque) {
        servo.joint().setGravityArm(torque);
    });
}

Control::Answer Control::inertia(const Call &call)
{
    return eachWithNumber(call, u"kgm2", 0, MostInertia, [](Servo &servo, double inertia) {
        servo.joint().setExtraInertia(inertia);
    });
}

Control::Answer Control::angle(const Call &call)
{
    return eachWithNumber(call, u"deg", -MostDegrees, MostDegrees, [](Servo &servo, double degrees) {
        servo.joint().setShaftAngle(degrees);
    });
}

Control::Answer Control::hardwareError(const Call &call)
{
    return eachWithNumber(call, {}, 0, 255, [](Servo &servo, double bits) {
        servo.setHardwareError(static_cast<std::uint8_t>(bits));
    });
}

Control::Answer Control::write(const Call &call)
{
    const QString assignment = call.rest.sliced(call.words[0].size()).trimmed().toString();
    const QString name = assignment.section(u'=', 0, 0).trimmed();
    bool ok = false;
    const qint64 value = assignment.section(u'=', 1).trimmed().toLongLong(&ok, 0);
    if (!ok)
        return wrong(QStringLiteral("write WHO REGISTER=VALUE, a raw number"));
    const auto found = who(call.words[0], call.bus);
    if (!found)
        return tl::unexpected(found.error());
    for (Servo *servo : *found) {
        const Field *field = servo->table().find(name);
        if (!field)
            return failure(ErrorKind::NotFound, QStringLiteral("%1 has no register %2").arg(servo->model(), name));
        if (value < smallestRaw(*field) || value > largestRaw(*field))
            return wrong(QStringLiteral("%1 does not hold %2").arg(field->name).arg(value));
        if (const DeviceError error = servo->write(field->name, value); error != DeviceError::None)
            return failure(ErrorKind::Refused, QStringLiteral("ID %1 refused with error %2")
                                                   .arg(servo->id()).arg(static_cast<int>(error)));
    }
    return {};
}

} // namespace dynascope::sim
