// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/profile/profile.h"
#include "core/session/settings/readimages.h"

/// From a bus to what a profile is compared with. The plan is made where the tables are, the job knows addresses only.
namespace dynascope {

/// What is read of a device from this firmware on.
struct ProfileVariant {
    int fromFirmware = 0;
    std::vector<Span> spans;
    int fastReadsFrom = -1; ///< firmware; −1: never
    int receiveBuffer = 1024;
};

/// One joint to be looked for.
struct ProfileTarget {
    DevicePlace place;
    std::vector<Span> identity;           ///< where its model says who it is
    std::uint16_t firmwareAt = 6;
    std::vector<ProfileVariant> variants; ///< ascending
    std::vector<int> otherRates;          ///< where it is looked for if it is silent, but for those of other joints
};

struct ProfileReadPlan {
    std::vector<ProfileTarget> targets; ///< one per joint
    std::vector<int> scanned;           ///< rates at which devices are looked for that no joint names; takes up to 0.8 s each
};

struct ProfileReadOptions {
    bool looksForOthers = true; ///< devices that no joint names
    bool readsAll = false;      ///< every register that could be in a profile, not only those that are
};
/// Pure.
ProfileReadPlan planProfileReading(const Profile &profile, const Catalog &catalog, const ProfileReadOptions &options = {});

/// What came of one joint.
struct JointReading {
    std::optional<Found> found;     ///< at its own place; may be another model
    RegisterImage image;            ///< where it is its model
    std::optional<Error> error;     ///< why nothing, or not all, was read
    std::optional<Found> elsewhere; ///< where nobody is at its place: its model, by its ID, at another rate
};

struct ProfileReading {
    std::vector<JointReading> joints; ///< as the plan's targets
    std::vector<Found> others;        ///< that no joint names
    QStringList notes;                ///< what was heard and could not be read
};

/// Told on the bus thread, from 0 to 1; an error ends the job.
using ProfileProgress = std::function<void(double done)>;

/// Reads what the plan says, in groups, as fast as the wire lets it. Errors: STOP, cancelled, the port gone, a rate that
/// the port can't do; each joint's own is in its entry. Writes nothing.
Result<ProfileReading> readForProfile(JobContext &context, const ProfileReadPlan &plan,
                                      const ProfileProgress &progress = {});

/// The spans of all that a profile could say of this device.
ReadSpansPlan planSaveReading(const Found &found, const ControlTable &table);
/// How the bus reads such a device fastest.
Traits profileTraits(const Found &found, int fastReadsFrom, int receiveBuffer);
/// A register of what was read; nothing where it wasn't.
RegisterLookup lookupIn(const ControlTable &table, const RegisterImage &image);

} // namespace dynascope
