// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/profile/profilereading.h"

/// From what devices hold to the text of a profile. Pure, but for the last one.
namespace dynascope {

/// A device and what was read of it (planSaveReading).
struct SavedDevice {
    Found found;
    RegisterImage image;
    QString name; ///< of a joint that the file doesn't have yet; empty: one is made
};

struct ProfileSaveOptions {
    bool calibration = false; ///< Homing Offset, too, which belongs to one single device
    bool all = false;         ///< also what is as the factory had it, and what comes and goes (LED)
    QString name;             ///< of a new file's robot
};

struct SavedProfile {
    QByteArray text;
    int changedValues = 0, newRegisters = 0, newJoints = 0;
    QStringList notes; ///< joints that were left as they are, and why

    bool isChanged() const { return changedValues + newRegisters + newJoints > 0; }
};

/// `text` with the values that the devices hold: of its joints (by ID and baud rate) what has another value is changed
/// in its place, registers it doesn't have come to the end of the joint, joints it doesn't have to the end. All else
/// stays, byte for byte. Empty: a new file. BadFile as profileFromYaml() says it.
Result<SavedProfile> saveProfile(const QByteArray &text, const QString &file, const std::vector<SavedDevice> &devices,
                                 const Catalog &catalog, const ProfileSaveOptions &options = {});

/// Whole or as it was; the file's permissions stay, and of a link what it leads to is written. BadFile.
Result<void> writeProfile(const QString &path, const QByteArray &text);

} // namespace dynascope
