// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/record/recordactions.h"

#include "core/session/eventlog.h"
#include "ui/common/icons.h"
#include "ui/common/present.h"
#include "ui/common/texts.h"
#include "ui/record/recordbadge.h"
#include "ui/record/recordoptionsdialog.h"
#include "ui/record/recordtexts.h"
#include "ui/record/streamdialog.h"

#include <QAction>
#include <QDesktopServices>
#include <QFileInfo>
#include <QUrl>

namespace dynascope {
namespace {

const QString Topic = QStringLiteral("recording");

} // namespace

RecordActions::RecordActions(const Workbench &workbench, const EventLog &log, QWidget *window)
    : QObject(window)
    , m_window(window)
    , m_recorder(workbench)
    , m_stream(workbench)
    , m_record(add(QStringLiteral("recordAction"), {}, {}, {}))
{
    m_record->setShortcut(QKeySequence(QStringLiteral("Ctrl+Alt+R"))); // Ctrl+R scans
    showState();
    QAction *options = add(QStringLiteral("recordOptionsAction"), tr("Recording opt&ions…"),
                           tr("Format, folder, size of the files, a note"), QStringLiteral("gear"));
    QAction *stream = add(QStringLiteral("streamAction"), tr("Stream as &JSON over UDP…"),
                          tr("Send what is plotted to PlotJuggler or another program"), QStringLiteral("stream"));
    m_badge = new RecordBadge(m_recorder, m_stream, *m_record, window);
    connect(m_record, &QAction::triggered, this, &RecordActions::toggle);
    connect(options, &QAction::triggered, this, &RecordActions::openOptions);
    connect(stream, &QAction::triggered, this, &RecordActions::openStream);
    connect(&m_recorder, &SessionRecorder::changed, this, &RecordActions::showState);
    connect(&m_recorder, &SessionRecorder::ended, this, &RecordActions::sayEnd);
    connect(&m_recorder, &SessionRecorder::fellBehind, this, [this](quint64 lost) {
        emit posted({MessageKind::Warning, tr("The disk does not keep up: %1 samples are not in the recording, which goes on")
                                               .arg(grouped(lost)), {}, {}, Topic});
    });
    connect(&log, &EventLog::added, &m_recorder, &SessionRecorder::add);
}

QAction *RecordActions::add(const QString &name, const QString &text, const QString &tip, const QString &iconName)
{
    auto *action = new QAction(text, this);
    action->setObjectName(name);
    action->setToolTip(tip);
    action->setAutoRepeat(false);
    if (!iconName.isEmpty())
        action->setIcon(icon(iconName));
    m_actions.push_back(action);
    return action;
}

void RecordActions::toggle()
{
    if (m_recorder.isRunning())
        return m_recorder.stop();
    const auto started = m_recorder.start(RecordWishes::saved());
    if (!started) {
        const bool isMissing = started.error().kind == ErrorKind::InvalidArgument;
        emit posted({isMissing ? MessageKind::Warning : MessageKind::Error,
                     tr("Not recorded: %1").arg(started.error().text), tr("Recording options…"), [this] { openOptions(); },
                     Topic});
    }
}

void RecordActions::showState()
{
    const bool runs = m_recorder.isRunning();
    m_record->setText(runs ? tr("&End recording") : tr("R&ecord"));
    m_record->setIconText(runs ? tr("End recording") : tr("Record"));
    m_record->setIcon(icon(runs ? QStringLiteral("record-end") : QStringLiteral("record"), IconTint::Bad));
    m_record->setToolTip(runs ? tr("End the recording (%1)").arg(m_record->shortcut().toString(QKeySequence::NativeText))
                              : tr("Write everything that is plotted to a file, at the rate of the bus (%1)")
                                    .arg(m_record->shortcut().toString(QKeySequence::NativeText)));
    m_record->setEnabled(!m_recorder.isEnding());
}

void RecordActions::sayEnd()
{
    showState();
    const RecorderStatus status = m_recorder.status();
    const MessageKind kind = !status.error.text.isEmpty() ? MessageKind::Error
        : status.lost > 0                                 ? MessageKind::Warning
                                                          : MessageKind::Success;
    Message message{kind, endText(status, m_recorder.length()), tr("Show in folder"),
                    [folder = QFileInfo(status.path).absolutePath()] { QDesktopServices::openUrl(QUrl::fromLocalFile(folder)); },
                    Topic};
    if (status.samples > 0 && status.path.endsWith(QStringLiteral(".mcap"))) {
        message.otherText = tr("Open");
        message.other = [this, path = status.path] { emit openRequested(path); };
    }
    emit posted(message);
}

void RecordActions::openOptions()
{
    if (!raiseOpen(*m_window, QStringLiteral("recordOptionsDialog")))
        present(*new RecordOptionsDialog(m_window));
}

void RecordActions::openStream()
{
    if (!raiseOpen(*m_window, QStringLiteral("streamDialog")))
        present(*new StreamDialog(m_stream, m_window));
}

} // namespace dynascope
