// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/replay/replayer.h"

#include "core/session/monitor.h"

#include <algorithm>
#include <array>

namespace dynascope {
namespace {

using namespace std::chrono_literals;

constexpr auto FrameInterval = 16ms;
/// Of a longer way only the end is told, reading by reading, and what was right before: nobody could follow the rest.
constexpr LineTime TellsUpTo = 100ms;
constexpr LineTime BeginsWithin = 1s;
constexpr LineTime MissesUpTo = 1s; ///< so far back is looked for replies that did not come: who is silent?

/// The last sample at or before `at`; of what is folded away, the last value of its stretch.
std::optional<History::Sample> lastUpTo(const History &history, LineTime at)
{
    const std::size_t end = history.indexAt(at + LineTime(1));
    if (end > 0)
        return history.at(end - 1);
    if (!history.isFolded(at - MissesUpTo, at + LineTime(1)))
        return std::nullopt;
    std::array<History::Column, 1> column;
    history.columns(at - MissesUpTo, at + LineTime(1), column);
    return column[0].isEmpty ? std::nullopt : std::optional(History::Sample{at, column[0].last});
}

PollValue valueOf(const ReplayDevice &device, const ReplayField &field, const History::Sample &sample)
{
    PollValue value;
    value.device = device.key;
    value.address = field.recorded.address;
    value.length = field.recorded.size;
    value.data = countedBytes(field.recorded, sample.raw);
    value.at = sample.at;
    return value;
}

} // namespace

Replayer::Replayer(Session &session, Monitor &monitor, QObject *parent)
    : QObject(parent)
    , m_session(session)
    , m_monitor(monitor)
{
    m_session.setClock({[this] { return m_clock.position(); }, [this] { return wallTime(m_clock.position()); }});
    m_timer.setInterval(FrameInterval);
    m_timer.setTimerType(Qt::PreciseTimer);
    connect(&m_timer, &QTimer::timeout, this, &Replayer::onTimer);
}

Replayer::~Replayer()
{
    m_session.setClock(Session::machineClock());
    if (!m_thread)
        return;
    m_progress->isCancelled = true;
    m_thread->wait();
}

Result<void> Replayer::open(const QString &path)
{
    auto opened = Recording::open(path);
    if (!opened)
        return tl::unexpected(opened.error());
    std::shared_ptr<Recording> recording = std::move(*opened);
    m_path = path;
    m_header = recording->header();
    m_isWhole = recording->isWhole();
    m_clock = ReplayClock(recording->begin(), recording->end());
    const std::size_t budget = m_monitor.histories().budget();
    m_monitor.showRecorded(std::make_unique<Histories>(budget)); // from here on nothing is polled
    auto devices = addDevices(m_session, m_header);
    if (!devices)
        return tl::unexpected(devices.error());
    m_devices = std::move(*devices);
    std::map<DeviceKey, QString> names;
    for (const ReplayDevice &device : m_devices.devices)
        names[device.key] = m_session.device(device.key)->displayName();
    // A line is open only when its thread has begun; what it is told before counts as old.
    for (const auto &line : m_session.lines())
        connect(line.get(), &LineSession::stateChanged, this, [this] {
            m_shown.reset();
            show(true);
        });
    m_progress = std::make_shared<ReplayProgress>();
    m_thread.reset(QThread::create(
        [this, recording, devices = m_devices, names, budget, progress = m_progress] {
            auto data = std::make_shared<Result<ReplayData>>(loadReplay(*recording, devices, names, budget, *progress));
            QMetaObject::invokeMethod(this, [this, data] { takeData(std::move(*data)); }, Qt::QueuedConnection);
        }));
    m_thread->start();
    m_timer.start();
    return {};
}

int Replayer::percentLoaded() const
{
    return m_isLoaded ? 100 : m_progress ? m_progress->percent.load() : 0;
}

void Replayer::takeData(Result<ReplayData> data)
{
    m_thread->wait();
    if (!data)
        return; // it was closed
    m_data = std::move(*data);
    m_clock.extend(m_data.last);
    lookOver();
    m_monitor.showRecorded(std::move(m_data.histories));
    m_isLoaded = true;
    if (!m_clock.isPlaying())
        m_timer.stop();
    m_shown.reset();
    emit loaded();
    show(true);
}

/// What most was recorded of; and on to where something of everybody has come, if that is soon.
void Replayer::lookOver()
{
    std::uint64_t most = 0;
    LineTime all = m_clock.position();
    for (const ReplayDevice &device : m_devices.devices) {
        for (const ReplayField &field : device.fields) {
            const Watch watch{device.key, field.field};
            const History *history = m_data.histories->find(watch);
            if (!history || history->isEmpty())
                continue;
            all = std::max(all, history->at(0).at);
            if (history->appended() <= most)
                continue;
            most = history->appended();
            m_busiest = watch;
        }
    }
    m_clock.seek(std::min(all, m_clock.position() + BeginsWithin));
}

void Replayer::onTimer()
{
    if (!m_isLoaded)
        emit loadProgressed();
    if (!m_clock.isPlaying())
        return;
    const bool moves = m_clock.advance(LineTime(m_passed.nsecsElapsed()));
    m_passed.restart();
    if (moves)
        show(false);
    if (m_clock.isPlaying())
        return;
    if (m_isLoaded)
        m_timer.stop();
    emit stateChanged(); // it has come to the end
}

void Replayer::seek(LineTime to)
{
    m_clock.seek(to);
    show(true);
}

void Replayer::play()
{
    const LineTime before = m_clock.position();
    m_clock.play();
    if (m_clock.position() != before)
        show(true);
    m_passed.start();
    m_timer.start();
    emit stateChanged();
}

void Replayer::pause()
{
    m_clock.pause();
    if (m_isLoaded)
        m_timer.stop();
    emit stateChanged();
}

void Replayer::setSpeed(double speed)
{
    m_clock.setSpeed(speed);
    emit stateChanged();
}

void Replayer::step(int samples)
{
    if (m_clock.isPlaying())
        pause();
    const History *history = m_busiest ? m_monitor.history(*m_busiest) : nullptr;
    if (!history || history->isEmpty())
        return;
    // The one at the position, or the last before it; a step back from between two is one to that.
    const auto before = static_cast<std::int64_t>(history->indexAt(m_clock.position() + LineTime(1))) - 1;
    const bool isBetween = before >= 0 && history->at(static_cast<std::size_t>(before)).at < m_clock.position();
    const std::int64_t to = before + samples + (isBetween && samples < 0 ? 1 : 0);
    seek(history->at(static_cast<std::size_t>(std::clamp<std::int64_t>(to, 0, std::ssize(*history) - 1))).at);
}

QDateTime Replayer::wallTime(LineTime at) const
{
    return QDateTime::fromMSecsSinceEpoch(m_header.unixTime(at) / 1'000'000);
}

void Replayer::show(bool isSought)
{
    const LineTime to = m_clock.position();
    if (m_isLoaded) {
        const bool isFar = !m_shown || to < *m_shown || to - *m_shown > TellsUpTo;
        if (isFar)
            showBefore(to - TellsUpTo);
        if (isFar && isSought)
            emit jumped();
        showBetween(isFar ? to - TellsUpTo : *m_shown, to);
        m_shown = to;
    }
    emit moved();
}

/// What everybody held then, whatever came before it.
void Replayer::showBefore(LineTime at)
{
    Batches batches;
    for (const ReplayDevice &one : m_devices.devices) {
        Device *device = m_session.device(one.key);
        if (!device)
            continue;
        device->setAllStale(); // so that older news count
        for (const ReplayField &field : one.fields) {
            const History *history = m_monitor.history({one.key, field.field});
            if (const auto sample = history ? lastUpTo(*history, at) : std::nullopt)
                batches[device->line()].values.push_back(valueOf(one, field, *sample));
        }
    }
    addMissed(batches, at - MissesUpTo, at);
    tell(batches);
}

/// All that came in (from, to].
void Replayer::showBetween(LineTime from, LineTime to)
{
    Batches batches;
    for (const ReplayDevice &one : m_devices.devices) {
        Device *device = m_session.device(one.key);
        if (!device)
            continue;
        for (const ReplayField &field : one.fields) {
            const History *history = m_monitor.history({one.key, field.field});
            const std::size_t end = history ? history->indexAt(to + LineTime(1)) : 0;
            for (std::size_t i = history ? history->indexAt(from + LineTime(1)) : 0; i < end; ++i)
                batches[device->line()].values.push_back(valueOf(one, field, history->at(i)));
        }
    }
    addMissed(batches, from, to);
    tell(batches);
}

void Replayer::addMissed(Batches &batches, LineTime from, LineTime to) const
{
    auto missed = std::ranges::upper_bound(m_data.missed, from, {}, &MissedReply::at);
    for (; missed != m_data.missed.end() && missed->at <= to; ++missed) {
        const Device *device = m_session.device(missed->device);
        if (!device)
            continue;
        PollValue value;
        value.device = missed->device;
        value.address = missed->address;
        value.length = missed->length;
        value.at = missed->at;
        value.error = {ErrorKind::NothingReceived, tr("It did not answer when this was recorded")};
        batches[device->line()].values.push_back(std::move(value));
    }
}

/// In the order in which it came.
void Replayer::tell(Batches &batches)
{
    for (auto &[line, batch] : batches) {
        std::ranges::stable_sort(batch.values, {}, &PollValue::at);
        batch.begin = batch.values.front().at;
        batch.end = batch.values.back().at;
        line->show(std::move(batch));
    }
}

} // namespace dynascope
