// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/window/replaypicture.h"

namespace dynascope {

ReplayPicture::ReplayPicture(Workshop &workshop)
    : m_workshop(workshop)
    , m_recorder(Workbench{workshop.session(), workshop.commands(), workshop.monitor(), workshop.scanner(),
                           workshop.stop(), workshop.lines()})
{
}

void ReplayPicture::record()
{
    RecordWishes wishes;
    wishes.folder = m_folder.path();
    wishes.note = QStringLiteral("the demo arm");
    m_recorder.start(wishes);
}

QWidget *ReplayPicture::open()
{
    const QString path = m_recorder.status().path;
    m_recorder.finish();
    ReplayRoom *room = m_workshop.openRecording(path);
    if (!room)
        return nullptr;
    Replayer &replayer = room->replayer();
    const auto toMiddle = [&replayer] {
        replayer.seek(replayer.clock().begin() + (replayer.clock().end() - replayer.clock().begin()) / 2);
    };
    QObject::connect(&replayer, &Replayer::loaded, &replayer, toMiddle);
    return &room->window();
}

} // namespace dynascope
