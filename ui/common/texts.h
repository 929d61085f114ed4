// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/linesession.h"

namespace dynascope {

/// Thousands set apart by a thin space, which doesn't depend on the locale.
QString grouped(quint64 number);
/// With the minus sign of typography, as all numbers in the window: tables, lists, axes.
QString withMinus(QString number);
/// What was seen, as a sentence to show: a capital (not of a port's name) and a full stop.
QString asSentence(QString text);
QString baudText(int bitsPerSecond);    ///< "57 600 bps", "1 Mbps"
/// A text of core, which says rates as `dxl` takes them ("1000000 bps"), with the window's words for them.
QString withBaudTexts(const QString &text);
QString agoText(LineTime at);           ///< "just now", "3 min ago"; since the monotonic clock's `at`
QString portText(const QString &name);  ///< "Simulated bus" for "sim", else the name

/// For tool tips that show what a person, a device or the system named: "<b>" in it is shown as typed, not obeyed.
QString plainToolTip(const QString &text);
/// The same for buttons and menus, where "&" would underline a letter.
QString plainLabel(QString text);

/// What a line does, in words: "Connected to /dev/ttyUSB0 at 1 Mbps".
QString lineStateText(const LineSession &line);
/// What a device does, in a few words: "Torque on", "Parked, heard 3 min ago".
QString deviceStateText(const Device &device);
/// The same as a sentence that says what follows from it; empty where the words say all.
QString deviceStateHelp(const Device &device);
/// Names of the latched hardware errors; empty without an alert.
QString alertText(const Device &device);

} // namespace dynascope
