// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/procedures/moveplan.h"
#include "core/session/profile/profilecomparison.h"
#include "core/session/settings/applysettings.h"

#include <set>

/// From what differs to what is written, joint by joint. The plans are pure; a job carries them out.
namespace dynascope {

struct ProfileApplyOptions {
    bool mayTurnTorqueOff = false; ///< where it locks a register that must be written; what the joint carries may fall
    bool putTorqueBack = false;    ///< afterwards, with the goal where the joint then is
    std::set<std::size_t> joints = {}; ///< of the profile; empty: all
};

/// What is written to one joint's device.
struct JointApply {
    std::size_t joint = 0; ///< in the profile
    QString name;
    Found found;
    ControlTablePtr table;
    SettingsPlan settings;       ///< all of its registers: a write may reset one that is right
    bool needsTorqueOff = false; ///< as it was read
    std::size_t differences = 0; ///< registers that are not as wanted
};

/// A joint to which nothing can be written, and why.
struct JointObstacle {
    std::size_t joint = 0;
    QString name, why;
};

struct ProfileApplyPlan {
    std::vector<JointApply> joints; ///< those with a difference, as the profile has them
    std::vector<JointObstacle> obstacles;

    std::size_t differences() const;
    bool needsTorqueOff() const;
};

/// InvalidArgument: a value that a device can't have, or a register that it doesn't have, "file:line:column: why";
/// nothing may be written then.
Result<ProfileApplyPlan> planProfileApply(const Profile &profile, const ProfileComparison &comparison,
                                          const ProfileApplyOptions &options);

/// Brings joints that are at another baud rate to theirs; for checkMoves() and moveDevices(), with line and adapter to
/// be filled in. Over at once where nobody has to move. What was read anew afterwards is what is applied to.
Result<MovePlan> planProfileMoves(const Profile &profile, const ProfileComparison &comparison,
                                  const ProfileApplyOptions &options);

/// Told on the bus thread; each may be empty. posted() (settingsjournal.h) brings the writes to another thread.
struct ProfileApplyHooks {
    std::function<void(const JointApply &joint)> begun;
    std::function<SettingsHooks(const JointApply &joint)> writes; ///< asked for before each joint: noted() for the journal
    std::function<void(const JointApply &joint, const Result<SettingsOutcome> &outcome)> ended;
};

struct JointOutcome {
    std::size_t joint = 0;
    Result<SettingsOutcome> outcome;
};
struct ProfileOutcome {
    std::vector<JointOutcome> joints; ///< as far as it came, as the plan's
    std::optional<Error> ended;       ///< cancelled, STOP, the port gone; the same once more goes on

    bool isDone(const ProfileApplyPlan &plan) const; ///< every register of the plan is as wanted
    std::size_t written() const;                     ///< registers
};

/// Joint after joint; what one refuses doesn't keep the others from theirs. Each looks at its device anew, writes what
/// then differs, and reads it back.
ProfileOutcome applyProfile(JobContext &context, const ProfileApplyPlan &plan, const ProfileApplyHooks &hooks = {});

} // namespace dynascope
