// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>
#include <QStringList>

class QApplication;

namespace dynascope {

/// What the command line of `dynascope` says.
struct WindowOptions {
    QString port;             ///< "sim", a path; empty: the last one, or the welcome
    int baudRate = 0;         ///< bits per second; 0: the last one, or 57 600 (1 M on the simulated bus)
    QStringList recordings;   ///< to be opened
    int historyBudget = 0;    ///< MB of memory for what is plotted; 0: the usual 512
    QString picture;          ///< render a few seconds without a screen, save this picture, end
    QString pictureDirectory; ///< write the pictures of the documents there and end
};

/// Name, version, icon: what settings and the desktop know the program by.
void setUpApplication(QApplication &application);

/// Ends the program with a message and exit code 2 where the options make no sense.
WindowOptions parseOptions(const QApplication &application);

} // namespace dynascope
