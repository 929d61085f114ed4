// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/ramguard.h"

#include "core/session/deviceplace.h"

#include <QPointer>

#include <algorithm>
#include <utility>

namespace dynascope {
namespace {

const Field &fieldOf(const ControlTable &table, int index)
{
    return table.fields()[static_cast<std::size_t>(index)];
}

std::optional<std::int64_t> readingOf(const Field *field, std::span<const PollValue> values)
{
    const Bytes bytes = field ? bytesIn(values, field->address, field->size) : Bytes();
    return bytes.empty() ? std::nullopt : std::optional(rawFromBytes(*field, bytes));
}

Device *deviceOf(const Session &session, const JournalDevice &there)
{
    for (const auto &line : session.lines()) {
        Device *device = line->name() == there.line
            ? line->deviceAt(static_cast<std::uint8_t>(there.id), there.baudRate) : nullptr;
        if (device && device->modelNumber() == there.modelNumber)
            return device;
    }
    return nullptr;
}

} // namespace

RamGuard::RamGuard(Session &session, Monitor &monitor, Commands &commands, Journal &journal, QObject *parent)
    : QObject(parent)
    , m_session(session)
    , m_monitor(monitor)
    , m_commands(commands)
    , m_journal(journal)
{
    connect(&journal, &Journal::ended, this, &RamGuard::onEnded);
    connect(&session, &Session::lineAdded, this, &RamGuard::follow);
    connect(&session, &Session::deviceAdded, this, [this](Device *device) {
        const auto known = m_devices.find(device->key());
        if (known == m_devices.end())
            return;
        known->second.tick.forget(); // perhaps another clock
        known->second.state = device->state();
        settle(device->key());
        look(device->key());
    });
    for (const auto &line : session.lines())
        follow(line.get());
}

void RamGuard::follow(LineSession *line)
{
    connect(line, &LineSession::batchTaken, this, &RamGuard::onBatch);
    connect(line, &LineSession::deviceChanged, this, &RamGuard::onDevice);
    connect(line, &LineSession::deviceLocated, this, &RamGuard::onDevice);
    connect(line, &LineSession::stateChanged, this, [this, line] { onLine(line); });
}

RamState RamGuard::stateOf(DeviceKey device, int field) const
{
    const auto known = m_devices.find(device);
    const RamMark *mark = known == m_devices.end() ? nullptr : known->second.marks.find(field);
    return !mark ? RamState::NotSet : mark->isLost ? RamState::Lost : RamState::Set;
}

std::optional<std::int64_t> RamGuard::setValue(DeviceKey device, int field) const
{
    const auto known = m_devices.find(device);
    const RamMark *mark = known == m_devices.end() ? nullptr : known->second.marks.find(field);
    return mark ? std::optional(mark->set) : std::nullopt;
}

std::vector<Restart> RamGuard::restarts() const
{
    std::vector<Restart> restarts;
    for (const auto &[key, guarded] : m_devices) {
        const auto lost = static_cast<int>(guarded.marks.lost().size());
        if (lost > 0 && guarded.last)
            restarts.push_back({key, *guarded.last, lost});
    }
    return restarts;
}

/// The monitor is told what to read, listeners that something changed.
void RamGuard::settle(DeviceKey key)
{
    const Guarded &guarded = m_devices[key];
    const Device *device = m_session.device(key);
    std::set<int> signs;
    if (const std::vector<int> set = guarded.marks.set(); device && !set.empty()) {
        const Field *tick = tickField(device->table());
        const int torque = device->table().indexOf(Known::TorqueEnable);
        signs.insert(tick ? device->table().indexOf(tick) : set.front());
        if (!tick && torque >= 0)
            signs.insert(torque);
    }
    m_monitor.setSigns(key, signs);
    emit changed();
}

void RamGuard::onEnded(qint64 number)
{
    const JournalEntry *entry = m_journal.entry(number);
    Device *device = entry ? deviceOf(m_session, entry->device) : nullptr;
    if (!device || entry->by == JournalAuthor::Packing) // nobody's setting: IndirectReads looks after them
        return;
    const DeviceKey key = device->key();
    const bool isRestart = entry->kind == JournalKind::Reboot || entry->kind == JournalKind::FactoryReset;
    if (isRestart && entry->state != JournalState::Failed && m_devices.contains(key)) {
        Guarded &guarded = m_devices[key]; // what it took is looked at when it is back
        guarded.expected = entry->kind == JournalKind::Reboot ? RestartSign::Reboot : RestartSign::FactoryReset;
        guarded.tick.forget();
        return;
    }
    RamMarks marks = m_devices.contains(key) ? m_devices[key].marks : RamMarks();
    if (!marks.take(device->table(), *entry))
        return;
    Guarded &guarded = m_devices[key];
    if (guarded.marks.set().empty()) { // it was not looked at until now
        guarded.tick.forget();
        guarded.state = device->state();
    }
    guarded.marks = std::move(marks);
    settle(key);
}

void RamGuard::onBatch(const Batch &batch)
{
    for (const PollValue &value : batch.values) {
        const auto known = m_devices.find(value.device);
        const Device *device = known == m_devices.end() ? nullptr : m_session.device(value.device);
        if (device && !value.data.empty() && !known->second.marks.set().empty())
            seen(known->second, *device, value);
    }
}

void RamGuard::seen(Guarded &guarded, const Device &device, const PollValue &value)
{
    const std::span<const PollValue> values(&value, 1);
    bool isDoubtful = std::exchange(guarded.looksAgain, false);
    const Field *tickRegister = tickField(device.table());
    if (const auto tick = readingOf(tickRegister, values)) {
        const TickSign::Verdict verdict = guarded.tick.take(value.at, *tick);
        if (verdict == TickSign::Verdict::Restarted && !guarded.expected)
            guarded.expected = RestartSign::Tick;
        guarded.isUnclear = guarded.isUnclear || verdict == TickSign::Verdict::Unclear;
        isDoubtful = isDoubtful || verdict != TickSign::Verdict::Runs;
    }
    // Polled before it was set, perhaps; the look is not.
    const auto isInitial = [](const SetReading &reading) { return reading.initial && reading.now == *reading.initial; };
    if (isDoubtful || std::ranges::any_of(guarded.marks.readings(device.table(), values), isInitial))
        look(device.key());
}

void RamGuard::onDevice(Device *device)
{
    const auto known = m_devices.find(device->key());
    if (known == m_devices.end())
        return;
    const Device::State before = std::exchange(known->second.state, device->state());
    const bool isBack = before == Device::State::Silent || before == Device::State::Rebooting;
    const bool wasRestarted = known->second.expected.has_value();
    if (device->state() == Device::State::Present && (isBack || wasRestarted))
        look(device->key());
}

/// A line that was lost: its adapter may have been pulled out together with the power.
void RamGuard::onLine(LineSession *line)
{
    for (const auto &device : line->devices()) {
        const auto known = m_devices.find(device->key());
        if (known == m_devices.end())
            continue;
        known->second.tick.forget();
        if (line->state() == BusThread::State::Open)
            look(device->key());
    }
}

void RamGuard::look(DeviceKey key)
{
    const auto known = m_devices.find(key);
    Device *device = known == m_devices.end() ? nullptr : m_session.device(key);
    if (!device || known->second.marks.set().empty() || device->line()->state() != BusThread::State::Open)
        return;
    if (known->second.isLooking) {
        known->second.looksAgain = true;
        return;
    }
    known->second.isLooking = true;
    known->second.looksAgain = false;
    const ControlTable &table = device->table();
    std::vector<const Field *> wanted;
    for (const Field *sign : {tickField(table), table.find(Known::TorqueEnable)}) {
        if (sign)
            wanted.push_back(sign);
    }
    for (const int field : known->second.marks.set())
        wanted.push_back(&fieldOf(table, field));
    const ReadSpansPlan plan{placeOf(*device), spansOf(*device, among(std::move(wanted)))};
    device->line()->bus().run<std::vector<PollValue>>(
        Priority::Normal, this, [plan](JobContext &context) { return readSpans(context, plan); },
        [this, key](const Result<std::vector<PollValue>> &values) { takeLook(key, values); });
}

void RamGuard::takeLook(DeviceKey key, const Result<std::vector<PollValue>> &values)
{
    Guarded &guarded = m_devices[key];
    guarded.isLooking = false;
    Device *device = m_session.device(key);
    if (!values || !device) {
        guarded.looksAgain = true; // as soon as it answers
        return;
    }
    for (const PollValue &value : *values)
        device->take(value);
    const ControlTable &table = device->table();
    bool isSure = !std::exchange(guarded.isUnclear, false) && guarded.tick.isKnown();
    for (const PollValue &value : *values) {
        const auto tick = readingOf(tickField(table), std::span(&value, 1));
        const auto verdict = tick ? guarded.tick.take(value.at, *tick) : TickSign::Verdict::Runs;
        if (verdict == TickSign::Verdict::Restarted && !guarded.expected)
            guarded.expected = RestartSign::Tick;
        isSure = isSure && verdict != TickSign::Verdict::Unclear;
    }
    const auto torque = readingOf(table.find(Known::TorqueEnable), *values);
    const auto isOn = torque ? std::optional(*torque != 0) : std::nullopt;
    auto sign = std::exchange(guarded.expected, std::nullopt);
    if (!sign && !isSure && looksRestarted(isOn, guarded.marks.readings(table, *values)))
        sign = RestartSign::Values;
    if (!sign) {
        if (guarded.marks.dropChanged(table, *values))
            settle(key);
        return;
    }
    if (guarded.marks.restarted(table, *values) == 0)
        return; // it stored them, or it never went
    if (sign == RestartSign::FactoryReset) {
        guarded.marks.dropLost();
        return settle(key);
    }
    guarded.last = sign;
    settle(key);
    emit restarted(key);
}

void RamGuard::dismiss(const std::vector<DeviceKey> &devices)
{
    for (const DeviceKey key : devices) {
        const auto known = m_devices.find(key);
        if (known != m_devices.end() && known->second.marks.dropLost())
            settle(key);
    }
}

void RamGuard::setAgain(const std::vector<DeviceKey> &devices, Done done)
{
    setNext({devices, {}, {}, std::move(done)});
}

void RamGuard::setNext(Setting setting)
{
    const auto end = [&setting](const Result<void> &result) {
        if (setting.done)
            setting.done(result);
    };
    for (; !setting.devices.empty(); setting.devices.erase(setting.devices.begin())) {
        const DeviceKey key = setting.devices.front();
        const auto known = m_devices.find(key);
        Device *device = m_session.device(key);
        for (const int field : known == m_devices.end() ? std::vector<int>() : known->second.marks.lost()) {
            if (!device)
                return end(failure(ErrorKind::NotFound, tr("A device that has restarted is not connected any more")));
            const RamMark *mark = known->second.marks.find(field);
            if (!mark || !setting.tried.insert({key, field}).second)
                continue;
            const std::int64_t raw = mark->set;
            if (const FieldValue &now = device->value(field); now.raw == raw && now.state == FieldState::Fresh) {
                known->second.marks.recovered(field);
                settle(key);
                continue;
            }
            const auto written = [here = QPointer<RamGuard>(this), setting, key, field, raw](
                                     const Result<void> &result) mutable {
                Device *present = here ? here->m_session.device(key) : nullptr;
                if (here && result && present) {
                    const QString problem = here->setProblem(*present, field, raw);
                    setting.problem = setting.problem.isEmpty() ? problem : setting.problem;
                    return here->setNext(std::move(setting));
                }
                if (setting.done)
                    setting.done(result ? failure(ErrorKind::Cancelled, tr("The device is gone")) : result);
            };
            return m_commands.writeField(*device, field, raw, written);
        }
    }
    end(setting.problem.isEmpty() ? Result<void>() : failure(ErrorKind::NotConfirmed, setting.problem));
}

/// What the servo made of it, where that is something else.
QString RamGuard::setProblem(const Device &device, int field, std::int64_t wanted) const
{
    const auto now = device.value(field).raw;
    if (!now || *now == wanted)
        return {};
    return tr("%1 of %2 is %3 now, not %4 as it was set before")
        .arg(fieldOf(device.table(), field).name, device.displayName(), QString::number(*now), QString::number(wanted));
}

} // namespace dynascope
