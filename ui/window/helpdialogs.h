// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

class QMainWindow;

namespace dynascope {

/// Every action of the window that has a key, and Esc.
void showShortcuts(QMainWindow &window);
void showAbout(QMainWindow &window);

} // namespace dynascope
