// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QIcon>

namespace dynascope {

/// Our own line icon ":/icons/NAME.svg", tinted with the palette of whatever draws it, also when that changes.
QIcon icon(const QString &name);

} // namespace dynascope
