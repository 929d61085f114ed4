// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/profile/profilereading.h"
#include "core/session/profile/profilevalues.h"

/// A profile beside what the bus holds. Pure.
namespace dynascope {

struct RegisterComparison {
    enum class State {
        Same,
        Differs,
        NotThere, ///< this firmware has no such register
        Wrong,    ///< the device can't have that value as it is set up, `why` says it
        Unread,
    };
    QString name;
    int field = -1; ///< index in the device's table; −1: NotThere
    Area area = Area::Ram;
    State state = State::Unread;
    QString written;          ///< as the file has it
    int line = 0, column = 0; ///< of that
    std::optional<ProfileValue> wanted, held; ///< each in the unit that holds on its side
    QString why;
};

struct JointComparison {
    enum class State {
        AsWanted,
        Differs, ///< it is there; the rows say what differs
        Missing, ///< nobody at its place
        AtOtherBaud,
        OtherModel,
        OldFirmware, ///< older than the profile asks for; the rows are compared all the same
        Unreadable,
        Doubtful, ///< two devices seem to share its ID
    };
    std::size_t joint = 0; ///< in the profile
    QString name;
    State state = State::Missing;
    std::optional<Found> found;   ///< at its place, or where it is at another rate
    ControlTablePtr table;        ///< of what was found, where that is its model
    bool hasTorque = false;       ///< which locks the EEPROM
    QString why;                  ///< what was seen, where it is neither AsWanted nor Differs
    std::vector<RegisterComparison> rows;

    std::size_t count(RegisterComparison::State state) const;
    bool isReadable() const { return state == State::AsWanted || state == State::Differs || state == State::OldFirmware; }
};

struct ProfileComparison {
    std::vector<JointComparison> joints; ///< as the profile has them
    std::vector<Found> others;           ///< that no joint names
    QStringList notes;

    bool isAsWanted() const;
    std::size_t count(JointComparison::State state) const;
    std::size_t count(RegisterComparison::State state) const;
};

ProfileComparison compareProfile(const Profile &profile, const ProfileReading &reading, const Catalog &catalog);

/// @name Words for programs: "differs", "missing"
/// @{
QString wordOf(JointComparison::State state);
QString wordOf(RegisterComparison::State state);
/// @}

} // namespace dynascope
