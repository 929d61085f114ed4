// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/devices/leftmoves.h"

#include "ui/common/present.h"
#include "ui/common/texts.h"
#include "ui/devices/movedialog.h"

#include <QWidget>

namespace dynascope {
namespace {

QString topicOf(const LineSession &line)
{
    return QStringLiteral("moves on %1").arg(line.name());
}

} // namespace

LeftMoves::LeftMoves(const Workbench &workbench, QWidget *window)
    : QObject(window), m_workbench(workbench), m_window(window)
{
    connect(&workbench.session, &Session::lineAdded, this, &LeftMoves::follow);
    for (const auto &line : workbench.session.lines())
        follow(line.get());
}

/// Said each time it is opened: after a while out of the hand, too.
void LeftMoves::follow(LineSession *line)
{
    const auto look = [this, line, known = -1]() mutable {
        if (line->state() != BusThread::State::Open || std::exchange(known, line->generation()) == line->generation())
            return;
        say(*line);
    };
    connect(line, &LineSession::stateChanged, this, look);
}

void LeftMoves::say(LineSession &line)
{
    const MoveFile file = moveFileOf(line.name(), MoveFile::usualFolder());
    if (!file.exists())
        return emit retracted(topicOf(line));
    const auto left = file.load();
    Message message;
    message.kind = MessageKind::Warning;
    message.topic = topicOf(line);
    message.otherText = tr("Forget");
    message.other = [this, file, topic = topicOf(line)] {
        file.remove();
        emit retracted(topic);
    };
    if (left) {
        message.text = tr("On %1 %2").arg(portText(line.name()), unfinishedText(*left));
        message.actionText = tr("Continue…");
        message.action = [this, where = QPointer<LineSession>(&line)] {
            if (where)
                open(*where, {});
        };
    } else {
        message.text =
            tr("The plan of moves that was left on %1 can't be read: %2").arg(portText(line.name()), left.error().text);
    }
    emit posted(message);
}

void LeftMoves::open(LineSession &line, const std::vector<Device *> &devices)
{
    const QString name = QStringLiteral("moveDialog");
    if (raiseOpen(*m_window, name, line.name()))
        return;
    emit retracted(topicOf(line));
    auto *dialog =
        new MoveDialog(m_workbench.session, m_workbench.commands, line, devices, MoveFile::usualFolder(), m_window);
    connect(dialog, &QDialog::finished, this, [this, where = QPointer<LineSession>(&line)] {
        if (where && where->state() == BusThread::State::Open)
            say(*where);
    });
    present(*dialog, line.name());
}

} // namespace dynascope
