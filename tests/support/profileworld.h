// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/profile/profileapply.h"
#include "tests/support/mortalline.h"
#include "tests/support/sessionfixture.h"

namespace dynascope::test {

constexpr int ProfileRate = 1'000'000;

/// A register of a servo that is not as the profile has it.
struct Deviation {
    int id = 0;
    QString name;
    std::int64_t raw = 0;
};

/// The twelve that were sown, among eight joints.
inline std::vector<Deviation> twelveDeviations()
{
    return {{1, QStringLiteral("Operating Mode"), 4},
            {1, QStringLiteral("Position P Gain"), 640},
            {2, QStringLiteral("Max Position Limit"), 4000},
            {2, QStringLiteral("Return Delay Time"), 250},
            {3, QStringLiteral("Shutdown"), 0},
            {3, QStringLiteral("Profile Velocity"), 50},
            {4, QStringLiteral("Temperature Limit"), 60},
            {5, QStringLiteral("Velocity Limit"), 200},
            {6, QStringLiteral("Drive Mode"), 1},
            {6, QStringLiteral("Position D Gain"), 100},
            {7, QStringLiteral("Current Limit"), 500},
            {8, QStringLiteral("PWM Limit"), 800}};
}

inline QString servosOf(int count)
{
    QStringList servos;
    for (int id = 1; id <= count; ++id)
        servos << QStringLiteral("XM430-W350@1000000:%1").arg(id);
    return servos.join(u',');
}

/// Joints j1, j2... of one model, each with the same dozen of registers, as simulated servos come.
inline QByteArray profileOf(int count)
{
    QByteArray yaml =
        "profile: 1\nname: test\ndefaults:\n  XM430-W350:\n"
        "    Return Delay Time: 0\n    Drive Mode: 0\n    Operating Mode: Position control\n"
        "    Temperature Limit: 80 degC\n    PWM Limit: 885\n    Current Limit: 1193\n    Velocity Limit: 480\n"
        "    Max Position Limit: 4095\n    Min Position Limit: 0\n    Shutdown: 52\n    Position P Gain: 900\n"
        "    Position D Gain: 10\n    Profile Velocity: 100\n    Profile Acceleration: 20\njoints:\n";
    for (int id = 1; id <= count; ++id) {
        const QByteArray number = QByteArray::number(id);
        yaml += "  - { name: j" + number + ", model: XM430-W350, id: " + number + ", baud: 1000000 }\n";
    }
    return yaml;
}

/// All that the profile says, but what order of writes resets; then what deviates.
inline void setUpServos(sim::SimulatedBus &bus, const Profile &profile, const std::vector<Deviation> &deviations)
{
    for (const ProfileJoint &joint : profile.joints) {
        sim::Servo *servo = bus.servo(joint.id, joint.baudRate);
        if (!servo)
            continue;
        for (const WantedValue &each : wantedValues(joint, servo->table(), {})) {
            if (each.field)
                servo->write(each.field->name, *each.raw);
        }
        for (const Deviation &each : deviations) { // the mode first: it resets the others
            if (each.id == joint.id)
                servo->write(each.name, each.raw);
        }
        for (const WantedValue &each : wantedValues(joint, servo->table(), {})) {
            const bool deviates = !each.field || std::ranges::any_of(deviations, [&](const Deviation &other) {
                return other.id == joint.id && other.name == each.field->name;
            });
            if (!deviates)
                servo->write(each.field->name, *each.raw);
        }
    }
}

/// Simulated servos, and a program that reads and compares.
struct ProfileWorld {
    ProfileWorld(const Catalog &theCatalog, const QString &servos, const QByteArray &yaml)
        : catalog(theCatalog), bus(theCatalog)
    {
        populate(bus, catalog, servos);
        auto read = profileFromYaml(yaml, QStringLiteral("f.yaml"), catalog);
        if (!read)
            qFatal("%s", qPrintable(read.error().text));
        profile = std::move(*read);
    }
    void setUp(const std::vector<Deviation> &deviations = {}) { setUpServos(bus, profile, deviations); }
    Result<ProfileComparison> check(const ProfileReadOptions &options = {})
    {
        MortalLine line(bus, profile.joints.front().baudRate);
        return check(line, options);
    }
    Result<ProfileComparison> check(Line &line, const ProfileReadOptions &options = {})
    {
        bus.setLogging(true);
        bus.clearLog();
        Bus program(line);
        DirectContext context(program);
        const LineTime begin = line.now();
        const auto reading = readForProfile(context, planProfileReading(profile, catalog, options));
        took = line.now() - begin;
        statistics = program.statistics();
        if (!reading)
            return tl::unexpected(reading.error());
        return compareProfile(profile, *reading, catalog);
    }
    /// Reads, plans and writes; what was in the way in `why`, if anything.
    ProfileOutcome apply(Line &line, const ProfileApplyOptions &options = {}, const ProfileApplyHooks &hooks = {})
    {
        why.clear();
        ProfileReadOptions quick;
        quick.looksForOthers = false;
        const auto comparison = check(line, quick);
        if (!comparison)
            return {{}, comparison.error()};
        const auto plan = planProfileApply(profile, *comparison, options);
        if (!plan) {
            why = plan.error().text;
            return {{}, plan.error()};
        }
        for (const JointObstacle &obstacle : plan->obstacles)
            why += obstacle.name + QStringLiteral(": ") + obstacle.why;
        Bus program(line, &stop);
        DirectContext context(program);
        context.atCheckpoint = atCheckpoint;
        ProfileOutcome outcome = applyProfile(context, *plan, hooks);
        isDone = plan->obstacles.empty() && outcome.isDone(*plan);
        for (const JointOutcome &joint : outcome.joints) {
            if (joint.outcome)
                why += joint.outcome->why;
            else
                why += joint.outcome.error().text;
        }
        bus.advanceTo(line.now() + std::chrono::milliseconds(20)); // the last EEPROM write
        return outcome;
    }
    ProfileOutcome apply(const ProfileApplyOptions &options = {}, const ProfileApplyHooks &hooks = {})
    {
        MortalLine line(bus, profile.joints.front().baudRate);
        return apply(line, options, hooks);
    }
    /// Every register that the profile names holds what it says.
    QStringList wrong()
    {
        QStringList list;
        for (const ProfileJoint &joint : profile.joints) {
            sim::Servo *servo = bus.servo(joint.id, joint.baudRate);
            for (const WantedValue &each : wantedValues(joint, servo->table(), {})) {
                if (servo->value(each.field->name) != *each.raw)
                    list << joint.name + u' ' + each.field->name;
            }
        }
        return list;
    }
    /// "id:address" of each packet that writes, since the log was cleared.
    QStringList writes() const
    {
        QStringList list;
        for (const sim::WireEntry &entry : bus.log()) {
            if (!entry.fromController || entry.bytes.size() < 12)
                continue; // too short for an address
            const auto instruction = static_cast<Instruction>(entry.bytes[7]);
            if (instruction != Instruction::Ping && instruction != Instruction::Read
                && instruction != Instruction::SyncRead && instruction != Instruction::BulkRead
                && instruction != Instruction::FastSyncRead && instruction != Instruction::FastBulkRead)
                list << QStringLiteral("%1:%2")
                            .arg(entry.bytes[4])
                            .arg(littleEndian(ByteView(entry.bytes).subspan(8), 2));
        }
        return list;
    }

    const Catalog &catalog;
    sim::SimulatedBus bus;
    Profile profile;
    std::atomic<bool> stop = false;
    std::function<Result<void>()> atCheckpoint;
    QString why;
    bool isDone = false;
    LineTime took{};
    BusStatistics statistics;
};

/// "j1 Operating Mode: 4 -> 3" of all that differs.
inline QStringList differences(const ProfileComparison &comparison)
{
    QStringList list;
    for (const JointComparison &joint : comparison.joints) {
        for (const RegisterComparison &row : joint.rows) {
            if (row.state == RegisterComparison::State::Differs)
                list << QStringLiteral("%1 %2: %3 -> %4")
                            .arg(joint.name, row.name)
                            .arg(row.held->raw)
                            .arg(row.wanted->raw);
            else if (row.state != RegisterComparison::State::Same)
                list << QStringLiteral("%1 %2: %3").arg(joint.name, row.name, row.why);
        }
    }
    return list;
}

} // namespace dynascope::test
