// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/linesession.h"

#include "core/table/catalog.h"

#include <algorithm>
#include <chrono>

namespace dynascope {
namespace {

using namespace std::chrono_literals;

constexpr int SilentAfter = 3; ///< poll answers missing in a row before a device is called silent
constexpr auto MeasureInterval = 1s;
constexpr auto FrameInterval = 16ms;

LineTime monotonicNow()
{
    return std::chrono::steady_clock::now().time_since_epoch();
}

} // namespace

LineSession::LineSession(LineFactory &factory, const QString &name, int baudRate, const Catalog &catalog,
                         DeviceKeys &keys, QObject *parent)
    : QObject(parent)
    , m_factory(factory)
    , m_catalog(catalog)
    , m_keys(keys)
{
    connect(&m_rateTimer, &QTimer::timeout, this, &LineSession::measureRates);
    m_rateTimer.start(MeasureInterval);
    // The screen needs them once a frame, however fast they come.
    m_frameTimer.setSingleShot(true);
    m_frameTimer.setInterval(FrameInterval);
    connect(&m_frameTimer, &QTimer::timeout, this, &LineSession::takeBatches);
    connect(&m_foresight, &PollForesight::changed, this, &LineSession::rateChanged);
    startThread(name, baudRate);
}

LineSession::~LineSession()
{
    close();
}

void LineSession::close()
{
    if (!m_thread)
        return;
    m_thread->disconnect(this);
    m_thread->close();
}

void LineSession::startThread(const QString &name, int baudRate)
{
    close();
    m_thread.reset();
    ++m_generation;
    m_plan = {};
    m_packed.clear(); // nobody knows what came to pass meanwhile
    m_thread = std::make_unique<BusThread>(m_factory, name, baudRate);
    m_sinceMeasured.start();
    m_busyAtMeasure = {};
    connect(m_thread.get(), &BusThread::stateChanged, this, &LineSession::onThreadState);
    m_health.begin();
    connect(m_thread.get(), &BusThread::qualityChanged, this, [this] { m_health.take(m_thread->quality()); });
    connect(m_thread.get(), &BusThread::batchesReady, this, [this] {
        if (!m_frameTimer.isActive())
            m_frameTimer.start();
    });
}

void LineSession::reopen(const QString &name)
{
    startThread(QString(name.isEmpty() ? this->name() : name), baudRate());
    emit stateChanged();
}

void LineSession::onThreadState()
{
    if (state() != BusThread::State::Open) {
        takeBatches(); // from before
        m_cycleRate = 0;
        m_foresight.clear();
        m_busLoad = 0;
        for (const auto &device : m_devices)
            device->setAllStale();
        emit rateChanged();
    } else { // perhaps at another rate than it was told: one that the port refused
        for (const auto &device : m_devices) {
            if (device->state() == Device::State::Parked || device->baudRate() != baudRate())
                park(*device);
        }
    }
    emit stateChanged();
}

Device *LineSession::device(DeviceKey key) const
{
    const auto at = std::ranges::find_if(m_devices, [key](const auto &device) { return device->key() == key; });
    return at == m_devices.end() ? nullptr : at->get();
}

Device *LineSession::deviceAt(std::uint8_t id, int baudRate) const
{
    const auto at = std::ranges::find_if(
        m_devices, [=](const auto &device) { return device->id() == id && device->baudRate() == baudRate; });
    return at == m_devices.end() ? nullptr : at->get();
}

Device &LineSession::heard(const Found &found)
{
    Device *known = deviceAt(found.id, found.baudRate);
    if (known && found.modelNumber == 0 && !found.doubt.isEmpty()) {
        Found doubted = found; // unreadable for once: no reason to forget whom we know there
        doubted.modelNumber = static_cast<std::uint16_t>(known->modelNumber());
        doubted.firmware = static_cast<std::uint8_t>(known->firmware());
        known->setFound(doubted);
        return *known;
    }
    if (known && (known->modelNumber() != found.modelNumber || known->firmware() != found.firmware)) {
        forget(known->key()); // another servo stands there now
        known = nullptr;
    }
    if (known) {
        known->setFound(found);
    } else {
        auto table = m_catalog.findOrRaw(found.modelNumber, found.firmware);
        auto device = std::make_unique<Device>(m_keys.take(name(), found), this, std::move(table), found);
        known = device.get();
        connect(known, &Device::attributesChanged, this, [this, known] { emit deviceChanged(known); });
        const auto before = [](const auto &a, const auto &b) {
            return std::pair(a->baudRate(), a->id()) < std::pair(b->baudRate(), b->id());
        };
        m_devices.insert(std::ranges::upper_bound(m_devices, device, before), std::move(device));
        countAnew(*known);
        park(*known);
        emit deviceAdded(known);
    }
    m_failures[known->key()] = 0;
    known->setHeard(monotonicNow());
    known->setAlert(found.alert);
    park(*known);
    return *known;
}

void LineSession::park(Device &device)
{
    device.setState(device.baudRate() == baudRate() ? Device::State::Present : Device::State::Parked);
}

void LineSession::moveDevice(Device &device, const Found &found)
{
    Device *other = deviceAt(found.id, found.baudRate);
    if (other && other != &device)
        forget(other->key()); // an entry left behind: what stands there now is this device
    m_failures[device.key()] = 0;
    device.setFound(found);
    device.setHeard(monotonicNow());
    countAnew(device);
    park(device);
    emit deviceLocated(&device);
}

/// What was counted for its ID was another one's.
void LineSession::countAnew(const Device &device)
{
    if (device.baudRate() == baudRate())
        m_health.startAnew(device.id());
}

void LineSession::forget(DeviceKey key)
{
    const auto at = std::ranges::find_if(m_devices, [key](const auto &device) { return device->key() == key; });
    if (at == m_devices.end())
        return;
    emit deviceAboutToBeRemoved(at->get());
    m_packed.end(key);
    m_keys.release(name(), **at);
    m_failures.erase(key);
    m_devices.erase(at);
}

void LineSession::setPollPlan(PollPlan plan)
{
    m_plan = plan;
    m_thread->setPollPlan(std::move(plan));
}

void LineSession::setWorkingBaudRate(int bitsPerSecond)
{
    takeBatches(); // from before
    m_thread->setWorkingBaudRate(bitsPerSecond);
    m_health.startAnew();
    for (const auto &device : m_devices)
        park(*device);
    emit stateChanged();
}

void LineSession::takeBatches()
{
    m_frameTimer.stop();
    for (Batch &batch : m_thread->takeBatches()) {
        std::erase_if(batch.values, [this, &batch](const PollValue &value) {
            const Device *device = this->device(value.device);
            // Gone since, or at another rate: who was asked at this one was somebody else.
            return !device || (batch.baudRate != AnyRate && batch.baudRate != device->baudRate());
        });
        take(batch);
        unpack(batch);
        emit batchTaken(batch);
    }
}

void LineSession::show(Batch batch)
{
    std::erase_if(batch.values, [this](const PollValue &value) { return !device(value.device); });
    take(batch);
    emit batchTaken(batch);
}

/// Behind what was read: the registers that were seen through it.
void LineSession::unpack(Batch &batch)
{
    const std::size_t read = batch.values.size();
    const std::vector<DeviceKey> lost = m_packed.unpack(batch);
    for (std::size_t i = read; i < batch.values.size(); ++i) {
        const PollValue &value = batch.values[i];
        Device *device = value.data.empty() ? nullptr : this->device(value.device);
        if (device)
            device->take(value, isPresent(*device) ? FieldState::Fresh : FieldState::Stale);
    }
    for (const DeviceKey key : lost) {
        Device *device = this->device(key);
        endPacking(*device);
        emit packingLost(device);
    }
}

void LineSession::setPacking(Device &device, IndirectPacking packing, LineTime since)
{
    m_packed.set(device, std::move(packing), since);
    emit deviceChanged(&device); // it is polled otherwise
}

void LineSession::endPacking(Device &device)
{
    if (m_packed.end(device.key()))
        emit deviceChanged(&device);
}

bool LineSession::isPresent(const Device &device) const
{
    return state() == BusThread::State::Open && device.state() == Device::State::Present;
}

void LineSession::take(const Batch &batch)
{
    if (batch.fullRate)
        ++m_fullRateCycles;
    for (const PollValue &value : batch.values) {
        Device *device = this->device(value.device);
        if (value.data.empty()) {
            countFailure(*device, value);
            continue;
        }
        device->setAlert(value.alert);
        if (state() == BusThread::State::Open)
            answered(*device);
        device->take(value, isPresent(*device) ? FieldState::Fresh : FieldState::Stale);
    }
}

void LineSession::answered(Device &device)
{
    m_failures[device.key()] = 0;
    device.setAnswersOnlyPing(false);
    if (device.state() == Device::State::Silent)
        park(device);
}

void LineSession::countFailure(Device &device, const PollValue &value)
{
    const Error &error = value.error;
    if (device.raw(Known::StatusReturnLevel) == 0 && value.answersPing && state() == BusThread::State::Open) {
        device.setAllStale(); // no Read is answered by it: it is there, and what was read is old
        return answered(device);
    }
    device.setAnswersOnlyPing(value.answersPing);
    if (error.kind == ErrorKind::Refused || error.kind == ErrorKind::Stopped || error.kind == ErrorKind::Cancelled)
        return; // it is there, or nobody waited for it
    if (++m_failures[device.key()] >= SilentAfter && device.state() == Device::State::Present)
        device.setState(Device::State::Silent);
}

PolledLine LineSession::polled() const
{
    PolledLine line{m_plan, baudRate(), m_health.delays(), {}, {}};
    for (const Traits &traits : m_plan.traits) {
        const Device *device = deviceAt(traits.id, baudRate());
        if (!device)
            continue;
        if (device->state() == Device::State::Silent || traits.statusReturnLevel < 1)
            line.silent.push_back(traits.id);
        else if (!traits.fastReads && device->traits().fastReads)
            line.couldBeFast.push_back(traits.id);
    }
    return line;
}

const std::vector<RateLimit> &LineSession::limits()
{
    if (state() == BusThread::State::Open)
        m_foresight.lookForLimits(polled());
    return m_foresight.limits();
}

void LineSession::lowerLatency(QObject *context, std::function<void(const Result<void> &)> done)
{
    m_thread->run<bool>(
        Priority::Click, context,
        [](JobContext &job) { return job.bus().line().lowerLatency().map([] { return true; }); },
        [done = std::move(done)](const Result<bool> &lowered) {
            done(lowered ? Result<void>() : tl::unexpected(lowered.error()));
        });
}

void LineSession::measureRates()
{
    const double seconds = static_cast<double>(m_sinceMeasured.nsecsElapsed()) * 1e-9;
    if (seconds <= 0 || state() != BusThread::State::Open)
        return;
    const LineTime busy = m_thread->statistics().busy;
    m_busLoad = std::clamp(std::chrono::duration<double>(busy - m_busyAtMeasure).count() / seconds, 0.0, 1.0);
    m_cycleRate = m_fullRateCycles / seconds;
    m_foresight.look(polled());
    m_busyAtMeasure = busy;
    m_fullRateCycles = 0;
    m_sinceMeasured.restart();
    emit rateChanged();
}

} // namespace dynascope
