// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/result.h"

#include <QStringList>

#include <memory>
#include <vector>

namespace CLI {
class App;
}

namespace dynascope::dxl {

enum class ProfileAction { Save, Check, Diff, Apply };

/// What `dxl profile` was told.
struct ProfileOptions {
    ProfileAction action = ProfileAction::Check;
    QString file;
    QStringList joints; ///< by name; empty: all
    bool quick = false; ///< nobody looks for devices that no joint names
    // save
    std::vector<int> bauds;        ///< where devices are looked for; empty: those of the file, else that of the line
    std::vector<std::uint8_t> ids; ///< empty: everybody
    QString name;
    bool calibration = false, all = false;
    // apply
    bool dryRun = false, move = false, torqueOff = false, torqueBack = false;
};

/// The part of the command line that is `dxl profile`.
class ProfileArguments
{
public:
    ProfileArguments();
    ~ProfileArguments();
    void describe(CLI::App &app, bool &yes);
    Result<ProfileOptions> understand() const; ///< what was parsed

private:
    struct Typed;
    std::unique_ptr<Typed> m_typed;
};

} // namespace dynascope::dxl
