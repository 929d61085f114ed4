// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/table/catalog.h"

#include <vector>

/// A robot as one file has it: its joints, where they are and what their registers shall hold. Values; any thread.
/// resources/profiles/FORMAT.md says how the file is written.
namespace dynascope {

/// One register of a joint and the value that it shall have.
struct ProfileRegister {
    QString name;          ///< the manufacturer's
    QString text;          ///< its value as written: 180 deg, 0x10, Position control
    int line = 0, column = 0; ///< of the value
    bool isShared = false; ///< from the file's defaults, not the joint's own
};

struct ProfileJoint {
    QString name;
    int modelNumber = 0;
    QString model;
    int id = 0;
    int baudRate = 0;  ///< bits per second
    int firmware = -1; ///< at least; −1: any
    std::vector<ProfileRegister> registers; ///< its own as they stand in the file, then the defaults that hold for it
    int line = 0, column = 0;

    const ProfileRegister *find(QStringView registerName) const;
};

struct Profile {
    static constexpr int Version = 1;
    static constexpr std::size_t MostJoints = 1000;
    static constexpr qsizetype LongestName = 64;

    QString file; ///< for messages
    QString name;
    std::vector<ProfileJoint> joints;
    /// The file's defaults, those of one model before those of all. What they are for a joint is among its registers.
    struct Default {
        int modelNumber = -1; ///< −1: of every model that has such a register
        QString name, text;
    };
    std::vector<Default> defaults;

    std::vector<int> baudRates() const; ///< ascending
    const ProfileJoint *at(int baudRate, int id) const;
    const Default *defaultOf(int modelNumber, QStringView registerName) const;
};

/// What a register is for a profile.
enum class ProfileUse {
    Setting,     ///< saved where it isn't as the factory had it
    Calibration, ///< of one single device, a spare part has another: saved only where it is asked for
    State,       ///< may be given, but comes and goes while a robot works (LED): saved only with all
    Place,       ///< ID and Baud Rate, which a joint has keys for
    Motion,      ///< torque, goals, and what leads to them: never in a profile
    Order,       ///< makes the device do something, or be gone: never in a profile
    ReadOnly,
};
ProfileUse profileUse(const ControlTable &table, const Field &field);
QString whyNotInProfile(ProfileUse use, const Field &field); ///< empty: it may be
inline bool mayBeInProfile(ProfileUse use)
{
    return use == ProfileUse::Setting || use == ProfileUse::Calibration || use == ProfileUse::State;
}

/// Reads a profile with distrust: its text, every register's name and value against the tables. BadFile; the message
/// has a line for each fault, "name:line:column: sentence", ten at most. A value whose unit or range another register
/// decides that isn't in the profile is looked at again once the device has been read.
Result<Profile> profileFromYaml(const QByteArray &yaml, const QString &name, const Catalog &catalog);
/// The bytes of a file, unless it is too large for a profile, which is said without reading it all. NotFound, BadFile.
Result<QByteArray> profileText(const QString &path);
/// Both of them.
Result<Profile> loadProfile(const QString &path, const Catalog &catalog);

} // namespace dynascope
