// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

class QApplication;

namespace dynascope {

class Workshop;
struct WindowOptions;

/// Shows the window as the options say and runs until it is closed; or, where they ask for pictures, until those are saved.
/// The program's exit code.
int runWindow(QApplication &application, Workshop &workshop, const WindowOptions &options);

} // namespace dynascope
