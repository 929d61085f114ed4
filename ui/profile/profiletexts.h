// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/profilerun.h"
#include "core/session/profilesaver.h"

/// What a profile, and what came of it, is in words.
namespace dynascope {

/// "180.00 ° (2048)" in a person's units, "2048" where that is all. `as`: the unit that holds on its side.
QString profileValueText(const ControlTable &table, const Field &field, const EffectiveField &as, std::int64_t raw,
                         const UnitPreferences &units);

QString profilePlaceText(const QString &model, int id, int baudRate); ///< "XM430-W350, ID 3, 1 Mbps"
QString jointStateText(const ProfileJoint &wanted, const JointComparison &joint);
QString registerStateText(const RegisterComparison &row);

/// What was found, as a sentence or two.
QString comparisonText(const ProfileComparison &comparison);
/// What apply() came to, torque included; empty before.
QString outcomeText(const ProfileRun &run);
/// What was saved.
QString savedText(const QString &path, const SavedProfile &saved);

} // namespace dynascope
