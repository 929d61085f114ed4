// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/result.h"

#include <QByteArray>
#include <QJsonObject>

namespace dynascope {

constexpr qsizetype MaximumTableFileSize = 1024 * 1024;
constexpr int MaximumTableFileDepth = 12;

/// One JSON object, read with distrust: size and depth are bounded before the parser sees it, and the same key twice in
/// one object is refused, where QJsonDocument would silently take the last. Errors name the line.
Result<QJsonObject> readJsonObject(const QByteArray &json, const QString &name);

/// A file that is not what it should be: "name: text".
tl::unexpected<Error> badFile(const QString &name, const QString &text);

} // namespace dynascope
