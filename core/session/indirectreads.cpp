// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/indirectreads.h"

#include "core/session/procedures/procedures.h"
#include "core/table/indirect.h"

#include <algorithm>
#include <chrono>

namespace dynascope {
namespace {

constexpr std::chrono::milliseconds LookAfter{300}; ///< whoever drags ten fields in sets the entries once

const Field &fieldAt(const Device &device, int index)
{
    return device.table().fields()[static_cast<std::size_t>(index)];
}

bool holdsAll(const Device &device, const IndirectPacking &packing)
{
    return std::ranges::all_of(packing.entries, [&](const IndirectPacking::Entry &entry) {
        const FieldValue &value = device.value(entry.field);
        return value.raw == entry.to && !value.pending && !value.unconfirmed;
    });
}

bool isPresent(const Device &device)
{
    return device.state() == Device::State::Present && device.line()
        && device.line()->state() == BusThread::State::Open;
}

} // namespace

IndirectReads::IndirectReads(Session &session, Monitor &monitor, SettingsCommands &settings, const QString &folder,
                             QObject *parent)
    : QObject(parent)
    , m_session(session)
    , m_monitor(monitor)
    , m_settings(settings)
    , m_kept(session, folder)
{
    m_lookTimer.setSingleShot(true);
    m_lookTimer.setInterval(LookAfter);
    connect(&m_lookTimer, &QTimer::timeout, this, &IndirectReads::look);
    connect(&monitor, &Monitor::watchesChanged, this, [this] {
        if (!m_on.empty())
            m_lookTimer.start();
    });
    connect(&session, &Session::lineAdded, this, &IndirectReads::follow);
    connect(&session, &Session::lineAboutToBeRemoved, this, [this](LineSession *line) {
        m_on.erase(line);
        m_kept.leave(line);
    });
    connect(&session, &Session::deviceAdded, this, [this](Device *device) { onDevice(*device); });
    connect(&session, &Session::deviceAboutToBeRemoved, this, [this](Device *device) {
        m_tasks.erase(device->key());
        m_refused.erase(device->key());
    });
    for (const auto &line : session.lines())
        follow(line.get());
}

void IndirectReads::follow(LineSession *line)
{
    if (const Result<void> left = m_kept.load(*line); !left)
        emit told(left.error().text, true);
    connect(line, &LineSession::stateChanged, this, [this, line] { onLineState(*line); });
    connect(line, &LineSession::packingLost, this, [this](Device *device) { lost(*device); });
    connect(line, &LineSession::deviceLocated, this, [this, line](Device *) { (void)m_kept.save(*line); });
    for (const auto &device : line->devices())
        onDevice(*device);
}

void IndirectReads::onLineState(LineSession &line)
{
    if (line.state() == BusThread::State::Open)
        return m_lookTimer.start();
    for (const auto &device : line.devices())
        m_tasks.erase(device->key()); // its entries are kept, and looked at when it is back
    emit changed(&line);
}

void IndirectReads::onDevice(Device &device)
{
    connect(&device, &Device::fieldsChanged, this, [this, &device] {
        const auto task = m_tasks.find(device.key());
        if (task != m_tasks.end() && task->second.stage == Stage::Live && !holdsAll(device, task->second.packing))
            lost(device);
    });
    if (isOn(*device.line()))
        m_lookTimer.start();
    else if (m_kept.find(device))
        emit leftFound(device.line());
}

void IndirectReads::setOn(LineSession &line, bool on, UsedEntries used)
{
    for (const auto &device : line.devices())
        m_refused.erase(device->key());
    if (on) {
        m_on[&line] = used;
        look();
    } else if (m_on.erase(&line) > 0) {
        for (const auto &device : line.devices()) {
            const auto task = m_tasks.find(device->key());
            if (task != m_tasks.end() && task->second.stage == Stage::Live)
                putBack(*device, false);
            else if (task != m_tasks.end())
                task->second.isAbandoned = true;
        }
    }
    emit changed(&line);
}

bool IndirectReads::isBusy(const LineSession &line) const
{
    return std::ranges::any_of(line.devices(), [this](const auto &device) {
        const auto task = m_tasks.find(device->key());
        return task != m_tasks.end() && task->second.stage != Stage::Live;
    });
}

int IndirectReads::packedDevices(const LineSession &line) const
{
    return static_cast<int>(std::ranges::count_if(
        line.devices(), [&line](const auto &device) { return line.packing(device->key()) != nullptr; }));
}

/// What is packed and what should be.
void IndirectReads::look()
{
    for (const auto &line : m_session.lines()) {
        if (!isOn(*line))
            continue;
        for (const auto &device : line->devices()) {
            const auto task = m_tasks.find(device->key());
            if (task == m_tasks.end()) {
                begin(*device);
                continue;
            }
            if (task->second.stage == Stage::Live && task->second.packing.fields() != wantedOf(*device))
                putBack(*device, true);
            else if (task->second.stage != Stage::Live)
                m_lookTimer.start();
        }
    }
}

/// At full rate, and such as can be pointed at; by index.
std::vector<int> IndirectReads::wantedOf(const Device &device) const
{
    std::vector<int> fields;
    const std::set<Watch> &watches = m_monitor.watches();
    for (auto at = watches.lower_bound({device.key(), 0}); at != watches.end() && at->device == device.key(); ++at) {
        const Field &field = fieldAt(device, at->field);
        if (mayBePointedAt(field) && m_monitor.rate(*at) <= 0)
            fields.push_back(at->field);
    }
    return fields;
}

Result<IndirectPacking> IndirectReads::plan(const Device &device, bool unreadIsFresh) const
{
    const auto on = m_on.find(device.line());
    const auto known = [&](int index) {
        const std::optional<std::int64_t> raw = device.value(index).raw;
        return raw || !unreadIsFresh ? raw : fieldAt(device, index).initial;
    };
    const UsedEntries used = on == m_on.end() ? UsedEntries::Refuse : on->second;
    return packWorthwhile(device.table(), wantedOf(device), known, used);
}

IndirectReads::Forecast IndirectReads::forecast(const LineSession &line) const
{
    Forecast result;
    std::map<DeviceKey, IndirectPacking> packings;
    for (const auto &device : line.devices()) {
        if (!isPresent(*device) || wantedOf(*device).empty())
            continue;
        if (const IndirectPacking *packing = line.packing(device->key()))
            packings[device->key()] = *packing;
        else if (auto planned = plan(*device, true))
            packings[device->key()] = std::move(*planned);
        else if (result.obstacle.isEmpty())
            result.obstacle = QStringLiteral("%1: %2").arg(device->displayName(), planned.error().text);
    }
    result.devices = static_cast<int>(packings.size());
    result.with = result.without = line.polled();
    result.without.plan = m_monitor.planOf(line, [](const Device &) { return nullptr; });
    result.with.plan = m_monitor.planOf(line, [&packings](const Device &device) {
        const auto at = packings.find(device.key());
        return at == packings.end() ? nullptr : &at->second;
    });
    return result;
}

void IndirectReads::begin(Device &device)
{
    if (!isPresent(device) || m_refused.contains(device.key()))
        return;
    if (m_kept.find(device)) // by a program that was ended, or before the line was lost
        return putBack(device, true);
    const auto possible = plan(device, true);
    // That nothing is scattered, or nothing watched, is no failure.
    if (!possible && possible.error().kind == ErrorKind::NotFound && wantedOf(device).size() > 1)
        return refuse(device, possible.error().text);
    if (!possible || wantedOf(device).size() < 2)
        return;
    startTask(device, Stage::Reading);
    readEntries(device, {}, [this](Device &there, Task &task, const std::vector<PollValue> &, LineTime) {
        write(there, task);
    });
}

void IndirectReads::write(Device &device, Task &task)
{
    auto packing = plan(device, false);
    if (task.isAbandoned || !packing) {
        const bool isProblem = !task.isAbandoned;
        m_tasks.erase(device.key());
        emit changed(device.line());
        return isProblem ? refuse(device, packing.error().text) : void();
    }
    task.packing = std::move(*packing);
    std::vector<SetEntries::Entry> entries;
    std::vector<WantedSetting> wanted;
    for (const IndirectPacking::Entry &entry : task.packing.entries) {
        entries.push_back({fieldAt(device, entry.field).address, static_cast<int>(entry.before),
                           static_cast<int>(entry.to)});
        wanted.push_back({entry.field, entry.to});
    }
    if (const Result<void> kept = m_kept.keep(device, std::move(entries)); !kept) {
        m_tasks.erase(device.key());
        return refuse(device, kept.error().text);
    }
    task.stage = Stage::Writing;
    const auto done = [this, key = device.key(), number = task.number, here = QPointer(this)](const auto &outcome) {
        Device *there = here ? m_session.device(key) : nullptr;
        Task *mine = there ? taskOf(key, number) : nullptr;
        if (!mine)
            return;
        if (outcome && outcome->isDone() && !mine->isAbandoned)
            return check(*there, *mine);
        m_refused.insert(key);
        putBack(*there, false);
    };
    m_settings.apply(device, wanted, {}, done, JournalAuthor::Packing);
}

/// Only what the device shows after all of them are written counts.
void IndirectReads::check(Device &device, Task &task)
{
    task.stage = Stage::Checking;
    const Span stretch{device.id(), task.packing.address, task.packing.length};
    readEntries(device, {stretch},
                [this](Device &there, Task &mine, const std::vector<PollValue> &values, LineTime at) {
                    const bool isThrough = std::ranges::any_of(values, [&](const PollValue &value) {
                        return value.address == mine.packing.address && mine.packing.isThrough(value.data);
                    });
                    if (mine.isAbandoned)
                        return putBack(there, false);
                    if (!isThrough || !holdsAll(there, mine.packing))
                        return lost(there);
                    mine.stage = Stage::Live;
                    there.line()->setPacking(there, mine.packing, at);
                    emit changed(there.line());
                });
}

void IndirectReads::lost(Device &device)
{
    refuse(device, tr("its Indirect Addresses don't hold what was set: it was restarted, or somebody else set them"));
    putBack(device, false);
}

void IndirectReads::refuse(Device &device, const QString &why)
{
    m_refused.insert(device.key());
    emit told(tr("%1 is read register by register: %2").arg(device.displayName(), why), true);
    emit changed(device.line());
}

void IndirectReads::putBack(Device &device, bool begins)
{
    device.line()->endPacking(device);
    startTask(device, Stage::PuttingBack).begins = begins;
    readEntries(device, {}, [this](Device &there, Task &task, const std::vector<PollValue> &, LineTime) {
        writeBack(there, task);
    });
    emit changed(device.line());
}

/// What somebody else has set since stays.
void IndirectReads::writeBack(Device &device, Task &task)
{
    const SetEntries *kept = m_kept.find(device);
    std::vector<WantedSetting> wanted;
    for (const SetEntries::Entry &entry : kept ? kept->entries : std::vector<SetEntries::Entry>()) {
        const Field *field = device.table().at(entry.address);
        if (!field || field->address != entry.address || !isSettableEntry(*field) || entry.before == entry.to)
            continue; // the file is not to be believed
        const int index = device.table().indexOf(field);
        const FieldValue &value = device.value(index);
        if (value.raw == entry.to && !value.pending)
            wanted.push_back({index, entry.before});
    }
    if (wanted.empty())
        return finish(device, true);
    const auto done = [this, key = device.key(), number = task.number, here = QPointer(this)](const auto &outcome) {
        Device *there = here ? m_session.device(key) : nullptr;
        if (there && taskOf(key, number))
            finish(*there, outcome && outcome->isDone());
    };
    m_settings.apply(device, wanted, {}, done, JournalAuthor::Packing);
}

void IndirectReads::finish(Device &device, bool isBack)
{
    const auto task = m_tasks.extract(device.key());
    if (isBack) {
        m_kept.drop(device);
    } else {
        refuse(device, tr("what its Indirect Addresses held could not be put back yet"));
    }
    if (isBack && task.mapped().begins && !task.mapped().isAbandoned && isOn(*device.line()))
        begin(device);
    emit changed(device.line());
}

/// What they hold, then `more`, and when that was over. What can't be read ends the task; what was set stays kept.
void IndirectReads::readEntries(Device &device, std::vector<Span> more,
                                std::function<void(Device &, Task &, const std::vector<PollValue> &, LineTime)> then)
{
    using Read = std::pair<std::vector<PollValue>, LineTime>;
    ReadSpansPlan plan{placeOf(device), spansOf(device, isSettableEntry)};
    plan.spans.insert(plan.spans.end(), more.begin(), more.end());
    // No write comes in between: one that is asked for meanwhile is still pending when this is looked at.
    device.line()->bus().run<Read>(
        Priority::Click, this,
        [plan = std::move(plan)](JobContext &context) -> Result<Read> {
            auto values = readSpans(context, plan);
            if (!values)
                return tl::unexpected(values.error());
            return Read{std::move(*values), context.bus().line().now()};
        },
        [this, key = device.key(), number = m_tasks.at(device.key()).number, then = std::move(then)](
            const Result<Read> &read) {
            Device *there = m_session.device(key);
            Task *task = there ? taskOf(key, number) : nullptr;
            if (!task)
                return;
            if (!read) {
                m_tasks.erase(key);
                return refuse(*there, read.error().text);
            }
            for (const PollValue &value : read->first)
                there->take(value);
            if (taskOf(key, number)) // taking it may have told that it is lost
                then(*there, *taskOf(key, number), read->first, read->second);
        });
}

IndirectReads::Task &IndirectReads::startTask(Device &device, Stage stage)
{
    return m_tasks.insert_or_assign(device.key(), Task{++m_tasksSoFar, stage, {}, false, false}).first->second;
}

IndirectReads::Task *IndirectReads::taskOf(DeviceKey device, int number)
{
    const auto at = m_tasks.find(device);
    return at == m_tasks.end() || at->second.number != number ? nullptr : &at->second;
}

std::vector<Device *> IndirectReads::left(const LineSession &line) const
{
    std::vector<Device *> devices;
    for (const auto &device : line.devices()) {
        if (m_kept.find(*device) && !m_tasks.contains(device->key()))
            devices.push_back(device.get());
    }
    return devices;
}

void IndirectReads::putBackLeft(LineSession &line)
{
    for (Device *device : left(line)) {
        if (isPresent(*device))
            putBack(*device, false);
    }
}

void IndirectReads::forgetLeft(const LineSession &line)
{
    m_kept.dropAllBut(line, [this](DeviceKey device) { return m_tasks.contains(device); });
}

} // namespace dynascope
