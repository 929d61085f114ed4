// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

class QFileDialog;
class QString;
class QWidget;

namespace dynascope {

/// Asks where to save; to be opened with open(), deletes itself when closed. Every file dialog is made here: the
/// system's own would be a window of another toolkit, whose keys no filter of ours sees, so that Esc would not be STOP
/// while it is open. `suffix` is without a dot: "csv".
QFileDialog *makeSaveDialog(QWidget *parent, const QString &title, const QString &suffix, const QString &suggested);

} // namespace dynascope
