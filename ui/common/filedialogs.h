// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QStringList>

#include <functional>

class QWidget;

namespace dynascope {

/// Asks where to save; `save` gets the path, unless it is closed otherwise. One for each suffix is open at a time: asking
/// again brings it to the front. Every file dialog is made here: the system's own would be a window of another toolkit,
/// whose keys no filter of ours sees, so that Esc would not be STOP while it is open, and what Qt's asks before it
/// replaces a file would be modal. Each begins in the folder where one of its suffix was chosen last. `suffix` is without a
/// dot: "csv".
void askWhereToSave(QWidget *parent, const QString &title, const QString &suffix, const QString &suggested,
                    std::function<void(const QString &path)> save);

/// Asks for a file that is there, of one of these suffixes or any; `open` gets the path, unless it is closed otherwise. As
/// above, the first time in `usualFolder`.
void askWhatToOpen(QWidget *parent, const QString &title, const QStringList &suffixes,
                   std::function<void(const QString &path)> open, const QString &usualFolder = {});

/// Asks for a folder that is there, or is made in the dialog. As above.
void askForFolder(QWidget *parent, const QString &title, std::function<void(const QString &path)> take);

} // namespace dynascope
