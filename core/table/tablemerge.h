// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QJsonObject>
#include <QString>

/// How a file and what it extends become one set of settings (FORMAT.md, "How files build on each other").
namespace dynascope {

/// What is wrong with the keys of one file, before anything is merged: unknown keys, objects that are none. Empty where
/// nothing is.
QString wrongKeys(const QJsonObject &file);

/// `base` changed by `changes`: objects are merged key by key, null removes, everything else replaces. A register that
/// is new starts from its definition. On failure `wrong` says what it is.
QJsonObject merged(const QJsonObject &base, const QJsonObject &changes, QString *wrong);

} // namespace dynascope
