// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/commissioning/commissionlist.h"
#include "core/session/profile/profile.h"

namespace dynascope {

/// The joints of a robot's profile as servos that are new: values in units mean what they mean beside the other values
/// of the profile and, where it says nothing, beside those of the factory. InvalidArgument names the place in the file.
Result<CommissionList> commissionList(const Profile &profile, const Catalog &catalog);

/// Joints of one model, IDs one after the other as given, without names. `names`: as many as IDs, or none.
Result<CommissionList> commissionList(const Catalog &catalog, const QString &model, const std::vector<int> &ids,
                                      int baudRate, const QStringList &names = {}, int minimumFirmware = 0);

} // namespace dynascope
