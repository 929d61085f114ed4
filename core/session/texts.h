// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QCoreApplication>

namespace dynascope {

// The contexts under which translators find what this folder's functions say, where no class of their own says it.

struct BackupText {
    Q_DECLARE_TR_FUNCTIONS(Backup)
};

struct CommandText {
    Q_DECLARE_TR_FUNCTIONS(Commands)
};

struct CommissioningText {
    Q_DECLARE_TR_FUNCTIONS(Commissioning)
};

struct ConsequenceText {
    Q_DECLARE_TR_FUNCTIONS(Consequences)
};

struct JournalText {
    Q_DECLARE_TR_FUNCTIONS(Journal)
};

struct MoveText {
    Q_DECLARE_TR_FUNCTIONS(Moves)
};

struct ProcedureText {
    Q_DECLARE_TR_FUNCTIONS(Procedures)
};

struct ProfileText {
    Q_DECLARE_TR_FUNCTIONS(Profile)
};

struct SettingsText {
    Q_DECLARE_TR_FUNCTIONS(Settings)
};

} // namespace dynascope
