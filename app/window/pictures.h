// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QTemporaryDir>

#include <memory>

class QApplication;

namespace dynascope {

class Workshop;
struct WindowOptions;

/// Pictures are taken of the program as it comes: while this lives, settings are read and written in a folder that goes away
/// with it, where the options ask for pictures.
class OwnSettings
{
public:
    explicit OwnSettings(const WindowOptions &options);
    ~OwnSettings();

private:
    std::unique_ptr<QTemporaryDir> m_folder;
};

/// Shows the window as the options say and runs until it is closed; or, where they ask for pictures, until those are saved.
/// The program's exit code.
int runWindow(QApplication &application, Workshop &workshop, const WindowOptions &options);

} // namespace dynascope
