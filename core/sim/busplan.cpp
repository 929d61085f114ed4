// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/busplan.h"

#include "core/sim/controlverbs.h"
#include "core/sim/power.h"

namespace dynascope::sim {
namespace {

Result<void> prepare(Servo &servo, const BusPlan::Device &device, const BusPlan::Axis &axis)
{
    for (const BusPlan::Register &initial : device.registers) {
        if (const DeviceError error = servo.write(initial.name, initial.value); error != DeviceError::None)
            return failure(ErrorKind::InvalidArgument,
                           QStringLiteral("%1: %2 refuses %3 = %4 with error %5")
                               .arg(initial.where, servo.model(), initial.name)
                               .arg(initial.value)
                               .arg(static_cast<int>(error)));
    }
    Joint &joint = servo.joint();
    if (axis.inertia)
        joint.setExtraInertia(*axis.inertia);
    if (axis.gravity)
        joint.setGravityArm(*axis.gravity);
    if (axis.torque)
        joint.setLoadTorque(*axis.torque);
    if (axis.angle)
        joint.setShaftAngle(*axis.angle);
    if (device.supply)
        verbs::setSupply(servo, *device.supply);
    if (axis.stops)
        joint.setStops(axis.stops->first, axis.stops->second);
    return {};
}

} // namespace

BusPlan planOf(const std::vector<ServoSpec> &specs)
{
    BusPlan plan;
    for (const ServoSpec &spec : specs) {
        BusPlan::Device device;
        device.spec = spec;
        plan.devices.push_back(std::move(device));
    }
    return plan;
}

Result<std::unique_ptr<SimulatedBus>> makeBus(const BusPlan &plan, const Catalog &catalog)
{
    const std::uint64_t seed = plan.seed.value_or(1);
    auto bus = std::make_unique<SimulatedBus>(catalog, seed);
    if (plan.supply)
        bus->power().setVoltage(*plan.supply);
    for (const BusPlan::Device &device : plan.devices) {
        const std::size_t first = bus->servos().size();
        if (const auto added = bus->add(device.spec); !added)
            return tl::unexpected(added.error());
        for (std::size_t i = first; i < bus->servos().size(); ++i) {
            const std::size_t axis = std::min(i - first, device.axes.size() - 1);
            if (const auto prepared = prepare(*bus->servos()[i], device, device.axes[axis]); !prepared)
                return tl::unexpected(prepared.error());
        }
    }
    for (const auto &servo : bus->servos()) {
        if (plan.temperature)
            servo->joint().setAmbientTemperature(*plan.temperature);
    }
    LineFaults faults = plan.faults;
    faults.seed = seed;
    bus->setFaults(std::move(faults));
    return bus;
}

QStringList namesOf(const BusPlan &plan)
{
    QStringList names;
    for (const BusPlan::Device &device : plan.devices) {
        const int axes = device.spec.secondId < 0 ? 1 : 2;
        for (int i = 0; i < axes; ++i)
            names.append(i < static_cast<int>(device.axes.size()) ? device.axes[static_cast<std::size_t>(i)].name
                                                                  : QString());
    }
    return names;
}

} // namespace dynascope::sim
