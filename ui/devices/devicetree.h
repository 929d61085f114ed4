// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

class QTreeView;

namespace dynascope {

class DeviceTreeModel;

/// Has `tree` show the devices as every window does; what comes is unfolded.
void setUpDeviceTree(QTreeView &tree, DeviceTreeModel &model);

} // namespace dynascope
