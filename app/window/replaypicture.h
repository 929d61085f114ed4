// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/window/workshop.h"
#include "ui/record/sessionrecorder.h"

#include <QTemporaryDir>

namespace dynascope {

/// Records the demo for a picture of its replay, and shows that in the middle. Leaves nothing behind. GUI thread.
class ReplayPicture
{
public:
    explicit ReplayPicture(Workshop &workshop);

    void record();
    QWidget *open(); ///< ends the recording; nullptr where there is none

private:
    Workshop &m_workshop;
    QTemporaryDir m_folder;
    SessionRecorder m_recorder;
};

} // namespace dynascope
