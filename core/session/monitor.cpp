// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/monitor.h"

#include "core/bus/batch_values.h"
#include "core/session/vitals.h"
#include "core/session/watchplan.h"
#include "core/table/units.h"

#include <algorithm>

namespace dynascope {
namespace {

/// What the history keeps: where a bit is the direction, a signed number, so that minimum, maximum and the line between
/// two samples mean something.
std::int64_t countedBy(const Device &device, int index, std::int64_t raw)
{
    const Field &field = device.table().fields()[static_cast<std::size_t>(index)];
    const bool mayHaveDirection = field.directionBit >= 0
        || std::ranges::any_of(field.alternates, [](const Alternate &other) { return other.directionBit >= 0; });
    return mayHaveDirection ? signedFromRaw(device.effective(index), raw) : raw;
}

} // namespace

Monitor::Monitor(Session &session, QObject *parent)
    : QObject(parent)
    , m_session(session)
{
    // Whatever changes in a burst (a scan finding ten servos) is planned once.
    m_replanTimer.setSingleShot(true);
    m_replanTimer.setInterval(0);
    connect(&m_replanTimer, &QTimer::timeout, this, &Monitor::replan);
    connect(&session, &Session::lineAdded, this, &Monitor::follow);
    connect(&session, &Session::lineAboutToBeRemoved, this, [this](LineSession *line) { m_sentPlans.erase(line); });
    connect(&session, &Session::deviceAdded, this, &Monitor::replanSoon);
    connect(&session, &Session::deviceAboutToBeRemoved, this, &Monitor::drop);
    for (const auto &line : session.lines())
        follow(line.get());
}

void Monitor::follow(LineSession *line)
{
    connect(line, &LineSession::stateChanged, this, &Monitor::replanSoon);
    connect(line, &LineSession::deviceChanged, this, &Monitor::replanSoon);
    connect(line, &LineSession::batchTaken, this, &Monitor::record);
    replanSoon();
}

void Monitor::drop(Device *device)
{
    // A trace keeps its curve; what nobody watches any more has none.
    eraseHistories([this, device](const Watch &watch) {
        return watch.device == device->key() && !m_watches.contains(watch);
    });
    std::erase_if(m_watches, [device](const Watch &watch) { return watch.device == device->key(); });
    std::erase_if(m_rates, [device](const auto &entry) { return entry.first.device == device->key(); });
    std::erase(m_selected, device->key());
    replanSoon();
    emit watchesChanged();
}

void Monitor::watch(const Watch &watch)
{
    if (!m_watches.insert(watch).second)
        return;
    if (!m_isRecorded)
        m_histories->markGap(watch); // where it was watched before: nobody knows what was in between
    replanSoon();
    emit watchesChanged();
}

void Monitor::unwatch(const Watch &watch)
{
    if (!m_session.device(watch.device))
        eraseHistories([&watch](const Watch &other) { return other == watch; });
    if (m_watches.erase(watch) == 0)
        return;
    replanSoon();
    emit watchesChanged();
}

void Monitor::setRate(const Watch &watch, double hertz)
{
    if (rate(watch) == hertz)
        return;
    if (hertz > 0)
        m_rates[watch] = hertz;
    else
        m_rates.erase(watch);
    replanSoon();
    emit watchesChanged();
}

double Monitor::rate(const Watch &watch) const
{
    const auto at = m_rates.find(watch);
    return at == m_rates.end() ? 0 : at->second;
}

void Monitor::select(const std::vector<Device *> &devices)
{
    m_selected.clear();
    for (const Device *device : devices)
        m_selected.push_back(device->key());
    replanSoon();
}

void Monitor::setUnfolded(const std::set<Watch> &fields)
{
    m_unfolded = fields;
    replanSoon();
}

void Monitor::setSigns(DeviceKey device, const std::set<int> &fields)
{
    std::set<int> &signs = m_signs[device];
    if (signs == fields)
        return;
    signs = fields;
    replanSoon();
}

void Monitor::setGlancing(bool glancing)
{
    if (m_isGlancing == glancing)
        return;
    m_isGlancing = glancing;
    replanSoon();
}

/// What is read of a device besides, so that all of them can be told at a glance.
void Monitor::glance(DeviceWatches &watches) const
{
    for (const VitalField &vital : vitalFields(watches.device->table())) {
        if (vital.vital == Vital::Position || vital.vital == Vital::Load)
            watches.glance.insert(vital.field);
    }
    if (const auto asked = m_asked.find(watches.device->key()); asked != m_asked.end())
        watches.once = asked->second;
}

/// Of the registers that say how far values may go, those that nobody has read yet.
std::set<int> Monitor::unknownLimits(const Device &device)
{
    const ControlTable &table = device.table();
    std::set<int> limits{table.indexOf(Known::OperatingMode)};
    for (const VitalField &vital : vitalFields(table))
        limits.insert({vital.low, vital.high});
    if (const Field *goal = table.find(u"Goal Position"))
        limits.insert({table.indexOf(goal->minimum.reg), table.indexOf(goal->maximum.reg)});
    std::set<int> unknown;
    for (const int limit : limits) {
        if (limit >= 0 && !device.value(limit).raw)
            unknown.insert(limit);
    }
    return unknown;
}

/// Has something come that needed to be read only once?
bool Monitor::learned(const Batch &batch) const
{
    return std::ranges::any_of(batch.values, [this](const PollValue &value) {
        const auto asked = m_asked.find(value.device);
        const Device *device = asked == m_asked.end() || value.data.empty() ? nullptr : m_session.device(value.device);
        return device && std::ranges::any_of(asked->second, [device](int field) {
            return device->value(field).raw.has_value();
        });
    });
}

void Monitor::clear()
{
    if (m_isRecorded)
        return;
    m_histories->erase([this](const Watch &watch) { return !m_watches.contains(watch); });
    m_histories->clear();
}

/// What a recording holds is there as long as it is open.
void Monitor::eraseHistories(const std::function<bool(const Watch &)> &which)
{
    if (!m_isRecorded)
        m_histories->erase(which);
}

void Monitor::showRecorded(std::unique_ptr<Histories> histories)
{
    m_isRecorded = true;
    m_histories = std::move(histories);
    emit watchesChanged();
}

std::optional<History::Sample> Monitor::newest(const History &history) const
{
    const std::size_t end = m_isRecorded ? history.indexAt(m_session.now() + LineTime(1)) : history.size();
    return end > 0 ? std::optional(history.at(end - 1)) : std::nullopt;
}

void Monitor::setPaused(bool paused)
{
    m_paused = paused;
    replanSoon();
}

void Monitor::setMayReadFast(bool may)
{
    m_mayReadFast = may;
    replanSoon();
}

void Monitor::replanSoon()
{
    if (!m_replanTimer.isActive())
        m_replanTimer.start();
}

PollPlan Monitor::planOf(const LineSession &line, const PackingOf &packing) const
{
    std::vector<DeviceWatches> devices;
    for (const auto &device : line.devices()) {
        if (m_paused)
            break;
        const bool isSelected = std::ranges::find(m_selected, device->key()) != m_selected.end();
        DeviceWatches watches{device.get(), {}, isSelected, {}, {}, {}, packing(*device), {}, {}};
        if (m_isGlancing)
            glance(watches);
        for (auto at = m_unfolded.lower_bound({device->key(), 0});
             isSelected && at != m_unfolded.end() && at->device == device->key(); ++at)
            watches.unfolded.insert(at->field);
        if (const auto signs = m_signs.find(device->key()); signs != m_signs.end())
            watches.signs = signs->second;
        for (auto at = m_watches.lower_bound({device->key(), 0});
             at != m_watches.end() && at->device == device->key(); ++at) {
            watches.fields.push_back(at->field);
            if (const double hertz = rate(*at); hertz > 0)
                watches.rates[at->field] = hertz;
        }
        devices.push_back(std::move(watches));
    }
    PollPlan plan = planWatches(devices, line.baudRate());
    for (Traits &device : plan.traits)
        device.fastReads = device.fastReads && m_mayReadFast;
    return plan;
}

void Monitor::markGaps(const LineSession &line)
{
    for (const Watch &watch : m_watches) {
        const Device *device = line.device(watch.device);
        if (device && (line.state() != BusThread::State::Open || device->state() != Device::State::Present))
            m_histories->markGap(watch);
    }
}

void Monitor::replan()
{
    if (m_isRecorded)
        return;
    m_asked.clear();
    for (const auto &line : m_session.lines()) {
        if (!m_paused)
            markGaps(*line);
        for (const auto &device : line->devices()) {
            if (m_isGlancing && !m_paused)
                m_asked[device->key()] = unknownLimits(*device);
        }
        PollPlan plan = planOf(*line, [&line](const Device &device) { return line->packing(device.key()); });
        SentPlan &sent = m_sentPlans[line.get()];
        if (sent.generation != line->generation())
            sent = {line->generation(), {}};
        if (plan == sent.plan)
            continue;
        sent.plan = plan;
        line->setPollPlan(std::move(plan));
    }
}

void Monitor::record(const Batch &batch)
{
    if (m_isRecorded)
        return;
    if (!m_asked.empty() && learned(batch))
        replanSoon();
    for (const PollValue &value : batch.values) {
        const Device *device = m_session.device(value.device);
        if (!device || standsInAnother(batch, value))
            continue;
        const int end = value.address + static_cast<int>(value.data.size());
        for (auto at = m_watches.lower_bound({value.device, 0}); at != m_watches.end() && at->device == value.device;
             ++at) {
            const Field &field = device->table().fields()[static_cast<std::size_t>(at->field)];
            if (value.data.empty()) {
                if (field.address >= value.address && field.address < value.address + value.length)
                    m_histories->appendGap(*at, value.at);
            } else if (field.address >= value.address && field.end() <= end) {
                const auto offset = static_cast<std::size_t>(field.address - value.address);
                const std::int64_t raw = rawFromBytes(field, ByteView(value.data).subspan(offset));
                m_histories->append(
                    *at, value.at, static_cast<std::int32_t>(countedBy(*device, at->field, raw)));
            }
        }
    }
}

} // namespace dynascope
