// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/backup/restore.h"
#include "core/session/settingscommands.h"

namespace dynascope {

/// Backups of the session's devices, and what is restored to them. GUI thread.
class BackupCommands : public QObject
{
    Q_OBJECT

public:
    /// Both outlive this.
    BackupCommands(Session &session, Commands &commands, QObject *parent = nullptr);

    using Done = std::function<void(const Result<Backup> &)>;
    /// Reads all registers in one job; the device shows what was read, too.
    void read(Device &device, Done done);

    using Planned = std::function<void(const Result<RestorePlan> &)>;
    /// Reads the device, then plans. Nothing is written. IDs of the line's other devices are added to the options.
    void plan(Device &device, const Backup &backup, RestoreOptions options, Planned done);

    /// Writes what the plan says; the device is looked at anew.
    void restore(Device &device, const RestorePlan &plan, SettingsCommands::Done done = {});

private:
    Session &m_session;
    SettingsCommands m_settings;
};

} // namespace dynascope
