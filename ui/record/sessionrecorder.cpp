// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/record/sessionrecorder.h"

#include "core/session/commands.h"
#include "core/session/eventlog.h"

#include <QCoreApplication>
#include <QDateTime>
#include <QDir>
#include <QFileInfo>
#include <QPointer>

namespace dynascope {
namespace {

using namespace std::chrono_literals;

constexpr auto LostInterval = 500ms;

QString kindOf(LoggedEvent::Kind kind)
{
    switch (kind) {
    case LoggedEvent::Kind::Restart: return QStringLiteral("reboot");
    case LoggedEvent::Kind::Alert: return QStringLiteral("alert");
    case LoggedEvent::Kind::TorqueOn:
    case LoggedEvent::Kind::TorqueOff: return QStringLiteral("torque");
    case LoggedEvent::Kind::Write: break;
    }
    return QStringLiteral("write");
}

} // namespace

SessionRecorder::SessionRecorder(const Workbench &workbench, QObject *parent)
    : QObject(parent)
    , m_workbench(workbench)
{
    m_lostTimer.setInterval(LostInterval);
    connect(&m_lostTimer, &QTimer::timeout, this, &SessionRecorder::lookAtLost);
    connect(&workbench.session, &Session::lineAdded, this, [this](LineSession *line) {
        if (isRunning())
            follow(line);
    });
}

SessionRecorder::~SessionRecorder()
{
    finish();
}

Result<void> SessionRecorder::start(const RecordWishes &wishes)
{
    if (m_recorder)
        return failure(ErrorKind::InvalidArgument, tr("The recording before is still being written"));
    auto devices = std::make_unique<WatchedDevices>(m_workbench.session, m_workbench.monitor);
    if (devices->isEmpty())
        return failure(ErrorKind::InvalidArgument,
                       tr("There is nothing to record: plot at least one register first (column Plot of the table)"));
    if (!QDir().mkpath(wishes.folder))
        return failure(ErrorKind::BadFile,
                       tr("The folder %1 can't be made").arg(QDir::toNativeSeparators(wishes.folder)));
    RecorderSettings settings;
    settings.header.program = QStringLiteral("Dynascope ") + QCoreApplication::applicationVersion();
    settings.header.name = QFileInfo(devices->devices().front().line).fileName();
    settings.header.notes = wishes.note;
    settings.header.devices = devices->devices();
    settings.header.startUnix = std::chrono::nanoseconds(std::chrono::system_clock::now().time_since_epoch()).count();
    settings.header.startLine = std::chrono::steady_clock::now().time_since_epoch(); // the clock of all lines
    settings.path = automaticName(wishes.folder, settings.header.name, QDateTime::currentDateTime(), wishes.format);
    settings.splitBytes = qint64(wishes.splitMegabytes) * 1'000'000;
    settings.splitAfter = std::chrono::minutes(wishes.splitMinutes);
    auto recorder = Recorder::start(std::move(settings));
    if (!recorder)
        return tl::unexpected(recorder.error());
    m_recorder = std::move(*recorder);
    m_devices = std::move(devices);
    m_isEnding = false;
    m_isLostTold = false;
    m_elapsed.start();
    m_lostTimer.start();
    connect(m_recorder.get(), &Recorder::failed, this, &SessionRecorder::stop);
    connect(m_recorder.get(), &Recorder::finished, this, &SessionRecorder::onEnded);
    connect(m_devices.get(), &WatchedDevices::changed, m_recorder.get(),
            qOverload<const RecordedDevice &>(&Recorder::setDevice));
    for (const auto &line : m_workbench.session.lines())
        follow(line.get());
    readTables();
    emit changed();
    return {};
}

void SessionRecorder::follow(LineSession *line)
{
    m_lines.push_back(connect(line, &LineSession::batchTaken, this, [this](const Batch &batch) { m_recorder->add(batch); }));
}

/// Of those of which only what is plotted is known; their header follows when it has come.
void SessionRecorder::readTables()
{
    for (const RecordedDevice &one : m_devices->devices()) {
        Device *device = m_workbench.session.device(one.key);
        const bool answers = device && device->state() == Device::State::Present
            && device->line()->state() == BusThread::State::Open;
        if (!answers || WatchedDevices::isImageWhole(*device))
            continue;
        m_workbench.commands.readAll(
            *device, [devices = QPointer<WatchedDevices>(m_devices.get()), &session = m_workbench.session,
                      key = one.key](const Result<void> &) {
                if (const Device *present = devices ? session.device(key) : nullptr)
                    devices->takeImage(*present);
            });
    }
}

void SessionRecorder::add(const LoggedEvent &event)
{
    if (isRunning())
        m_recorder->add(RecordedEvent{event.at, kindOf(event.kind), QStringLiteral("%1: %2").arg(event.name, event.text)});
}

void SessionRecorder::stop()
{
    if (!isRunning())
        return;
    for (const QMetaObject::Connection &line : std::exchange(m_lines, {}))
        disconnect(line);
    m_isEnding = true;
    m_length = std::chrono::seconds(m_elapsed.elapsed() / 1000);
    m_devices.reset();
    m_lostTimer.stop();
    m_recorder->finish();
    emit changed();
}

void SessionRecorder::finish()
{
    if (!m_recorder)
        return;
    for (const QMetaObject::Connection &line : std::exchange(m_lines, {}))
        disconnect(line);
    m_devices.reset();
    m_lostTimer.stop();
    m_last = m_recorder->wait();
    m_recorder.reset();
}

void SessionRecorder::onEnded()
{
    stop(); // where it ended by itself
    m_last = m_recorder->status();
    m_recorder.release()->deleteLater(); // it is its signal that came
    emit ended();
}

RecorderStatus SessionRecorder::status() const
{
    return m_recorder ? m_recorder->status() : m_last;
}

std::chrono::seconds SessionRecorder::length() const
{
    return isRunning() ? std::chrono::seconds(m_elapsed.elapsed() / 1000) : m_length;
}

void SessionRecorder::lookAtLost()
{
    const quint64 lost = status().lost;
    if (lost == 0 || m_isLostTold)
        return;
    m_isLostTold = true;
    emit fellBehind(lost);
}

} // namespace dynascope
