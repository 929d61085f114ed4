// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/commands.h"
#include "core/session/settings/applysettings.h"

namespace dynascope {

/// Several registers of a device in one job, by applySettings(): each write is in the journal, and Device shows what the
/// servo said. What went wrong is also said by the signals of Commands. GUI thread; owned by app.
class SettingsCommands : public QObject
{
    Q_OBJECT

public:
    using Done = std::function<void(const Result<SettingsOutcome> &)>;

    /// Both outlive this.
    SettingsCommands(Session &session, Commands &commands, QObject *parent = nullptr);

    /// Refused while STOP holds where it might move anything or turn torque on. A consent that is missing is an outcome,
    /// not an error.
    void apply(Device &device, const std::vector<WantedSetting> &wanted, SettingsOptions options, Done done = {});

signals:
    void torqueTurnedOn(dynascope::DeviceKey device); ///< by an order of a person, or back after it had been turned off

private:
    void finish(DeviceKey key, const std::vector<WantedSetting> &wanted, const SettingsPlan &plan,
                const Result<SettingsOutcome> &outcome);
    void show(Device &device, const std::vector<WantedSetting> &wanted, const SettingsPlan &plan,
              const SettingsOutcome &outcome);
    SettingsHooks hooksFor(const Device &device);

    Session &m_session;
    Commands &m_commands;
};

} // namespace dynascope
