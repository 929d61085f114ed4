// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/result.h"

#include <QStringList>

#include <memory>
#include <optional>
#include <vector>

namespace CLI {
class App;
}

namespace dynascope::dxl {

/// One side of `dxl compare`.
struct CompareSide {
    int id = -1; ///< −1: it is a file
    QString file;
};

/// What `dxl backup`, `dxl restore` and `dxl compare` were told.
struct BackupOptions {
    std::vector<std::uint8_t> ids; ///< the devices; of `compare` those among its sides
    bool inServo = false;          ///< the device's own backup, by Control Table Backup
    bool restores = false;         ///< of inServo
    QString file;                  ///< empty: named after the device
    QString folder;                ///< backup: where such files go; empty: here
    bool replace = false;          ///< backup: a file that is there already
    bool yes = false;              ///< was asked and agreed
    // restore
    bool dryRun = false, torqueOff = false, torqueBack = false, withIdAndBaud = false;
    std::optional<bool> calibration;
    QStringList only, except;
    // compare
    std::vector<CompareSide> sides;
    bool all = false;
};

/// The part of the command line that is `dxl backup`, `dxl restore` and `dxl compare`.
class BackupArguments
{
public:
    BackupArguments();
    ~BackupArguments();
    void describe(CLI::App &app);
    Result<BackupOptions> understandBackup() const;
    Result<BackupOptions> understandRestore() const;
    Result<BackupOptions> understandCompare() const;

private:
    struct Typed;
    std::unique_ptr<Typed> m_typed;
};

} // namespace dynascope::dxl
