// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/demo.h"

#include "core/sim/demoscript.h"

#include <array>

namespace dynascope::sim {
namespace {

constexpr int ArmBaudRate = 1000000;
constexpr int FreshBaudRate = 57600;

/// One joint of the arm, from the base to the gripper.
struct ArmJoint {
    const char16_t *model;
    int id;
    double startDegrees;
    double gravityArm; ///< N·m with the arm stretched out
    double inertia;    ///< kg·m² of what it carries
    DemoScript::Part part;
};

// Shoulder and elbow stand upright at 90° (1024), where gravity turns neither way.
constexpr std::array Arm{
    ArmJoint{u"XM430-W350", 1, 180, 0.0, 0.010, {2048, 700, 12.0, 0.00, 0, 0}},
    ArmJoint{u"XM430-W350", 2, 110, 0.9, 0.015, {1300, 260, 9.0, 0.25, 0, 0}},
    ArmJoint{u"XM430-W350", 3, 150, 0.45, 0.006, {1750, 340, 7.0, 0.50, 0, 0}},
    ArmJoint{u"XL430-W250", 4, 180, 0.12, 0.002, {2048, 400, 6.0, 0.10, 0, 0}},
    ArmJoint{u"XL430-W250", 5, 180, 0.0, 0.001, {2048, 600, 8.0, 0.00, 60, 8}},
    ArmJoint{u"XL330-M288", 6, 160, 0.0, 0.0002, {1950, 250, 5.0, 0.30, 120, 20}},
};

} // namespace

Result<std::unique_ptr<Demo>> Demo::start(const Catalog &catalog)
{
    auto bus = std::make_unique<SimulatedBus>(catalog);
    auto script = std::make_shared<DemoScript>();
    for (const ArmJoint &joint : Arm) {
        auto servo = bus->add({QString::fromUtf16(joint.model), -1, ArmBaudRate, joint.id});
        if (!servo)
            return tl::unexpected(servo.error());
        (*servo)->write(u"Return Delay Time", 0); // as everyone sets it who wants fast cycles
        (*servo)->joint().setShaftAngle(joint.startDegrees);
        (*servo)->joint().setGravityArm(joint.gravityArm);
        (*servo)->joint().setExtraInertia(joint.inertia);
        script->add(**servo, joint.part);
    }
    if (auto fresh = bus->add({QStringLiteral("XL330-M288"), -1, FreshBaudRate, 1}); !fresh)
        return tl::unexpected(fresh.error());
    auto server = PtyServer::start(std::move(bus), {}, [script](SimulatedBus &, LineTime now) { script->tick(now); });
    if (!server)
        return tl::unexpected(server.error());
    std::unique_ptr<Demo> demo(new Demo);
    demo->m_script = std::move(script);
    demo->m_server = std::move(*server);
    demo->resume();
    return demo;
}

Demo::~Demo() = default;

QString Demo::path() const
{
    return m_server->path();
}

void Demo::resume()
{
    m_server->post([script = m_script](SimulatedBus &, LineTime now) { script->resume(now); });
}

} // namespace dynascope::sim
