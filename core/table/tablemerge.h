// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/table/tablefault.h"

#include <QJsonObject>

/// How table files build on each other (resources/controltables/FORMAT.md, "How files build on each other").
namespace dynascope {

/// Unknown keys and wrong kinds of values, in `file` as it was read.
TableFault wrongKeys(const QJsonObject &file);

/// `changes` laid over `base`: the variants that they use first, objects merged, null removes, all else replaces.
/// Registers that `base` doesn't have start from its definitions. `path` is where `changes` stands in its file.
QJsonObject merged(const QJsonObject &base, const QJsonObject &changes, const QStringList &path, TableFault *fault);

} // namespace dynascope
