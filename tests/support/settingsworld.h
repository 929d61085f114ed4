// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/deviceplace.h"
#include "core/session/settings/applysettings.h"
#include "tests/support/mortalline.h"
#include "tests/support/sessionfixture.h"

namespace dynascope::test {

using Wanted = std::vector<std::pair<QString, std::int64_t>>;

inline std::vector<WantedSetting> wantedOf(const ControlTable &table, const Wanted &wanted)
{
    std::vector<WantedSetting> settings;
    for (const auto &[name, raw] : wanted) {
        const int field = table.indexOf(name);
        if (field < 0)
            qFatal("%s has no %s", qPrintable(table.model()), qPrintable(name));
        settings.push_back({field, raw});
    }
    return settings;
}

/// Where a servo is that was never found: for plans.
inline DevicePlace placeOf(const sim::Servo &servo)
{
    const Found found{static_cast<std::uint8_t>(servo.id()),
                      servo.baudRate(),
                      static_cast<std::uint16_t>(servo.table().modelNumber()),
                      static_cast<std::uint8_t>(servo.firmware()),
                      false,
                      {}};
    return dynascope::placeOf(found, servo.table(), QStringLiteral("%1 #%2").arg(servo.model()).arg(servo.id()));
}

inline Result<SettingsPlan> planFor(const sim::Servo &servo, const Wanted &wanted, const SettingsOptions &options = {})
{
    return planSettings(servo.table(), placeOf(servo), servo.firmware(), wantedOf(servo.table(), wanted), options);
}

/// Servos on a simulated bus, settings that are applied to them, and what that took on the wire.
struct SettingsWorld {
    SettingsWorld(const Catalog &catalog, const QString &servos) : bus(catalog)
    {
        populate(bus, catalog, servos);
        for (const auto &servo : bus.servos())
            all.push_back(servo.get());
    }
    sim::Servo &servo(std::size_t index = 0) { return *all.at(index); }
    Result<SettingsOutcome> apply(const SettingsPlan &plan, const SettingsHooks &hooks = {})
    {
        MortalLine line(bus, plan.place.baudRate);
        return apply(line, plan, hooks);
    }
    Result<SettingsOutcome> apply(MortalLine &line, const SettingsPlan &plan, const SettingsHooks &hooks = {})
    {
        bus.setLogging(true);
        bus.clearLog();
        Bus program(line, &stop);
        DirectContext context(program);
        context.atCheckpoint = atCheckpoint;
        auto outcome = applySettings(context, plan, hooks);
        bus.advanceTo(line.now() + std::chrono::milliseconds(20)); // the last EEPROM write
        return outcome;
    }
    /// "address=value" of each Write packet since the last apply().
    QStringList writes() const
    {
        QStringList list;
        for (const sim::WireEntry &entry : bus.log()) {
            if (!entry.fromController || entry.bytes[7] != static_cast<std::uint8_t>(Instruction::Write))
                continue;
            const auto size = static_cast<int>(entry.bytes.size()) - 12;
            const auto address = littleEndian(ByteView(entry.bytes).subspan(8), 2);
            const auto value = littleEndian(ByteView(entry.bytes).subspan(10), size);
            list << QStringLiteral("%1=%2").arg(address).arg(value);
        }
        return list;
    }

    sim::SimulatedBus bus;
    std::vector<sim::Servo *> all;
    std::atomic<bool> stop = false;
    std::function<Result<void>()> atCheckpoint;
};

} // namespace dynascope::test
