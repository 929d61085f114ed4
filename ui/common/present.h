// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>

class QDialog;
class QWidget;

namespace dynascope {

/// Every dialog is shown by these, never by open() or exec(): a modal one would take STOP's clicks and Esc from the
/// window behind it, which no filter of ours would ever see. GUI thread only.
///
/// Shows `dialog` beside its window, which stays alive, and deletes it when it is closed. `subject` says what it is
/// about, so that raiseOpen() finds it.
void present(QDialog &dialog, const QString &subject = {});

/// Brings an open dialog of `window` to the front: that of this object name about this subject. False: there is none.
bool raiseOpen(const QWidget &window, const QString &name, const QString &subject = {});

/// Closes what `window` still has open, each as by its Cancel.
void closeDialogs(const QWidget &window);

} // namespace dynascope
