// SPDX-License-Identifier: GPL-3.0-or-later
// Registers: writing, reading, torque, LED. What moves a device or makes it reboot is in placecommands.cpp.
#include "core/session/commands.h"

#include "core/bus/operations.h"
#include "core/table/units.h"

#include <memory>

namespace dynascope {
namespace {

std::vector<const Field *> with(std::vector<const Field *> fields, const Field &field)
{
    fields.push_back(&field);
    return fields;
}

/// What a write to this field may move now.
std::vector<const Field *> affectedNow(const Device &device, const Field &field)
{
    return affectedBy(device.table(), field, device.goalTurnsTorqueOn() && !device.isTorqueOn());
}

} // namespace

std::vector<Span> spansOf(const Device &device, const std::function<bool(const Field &)> &wanted, int longest)
{
    return spansOf(device.table(), device.id(), wanted, longest);
}

Commands::Commands(Session &session, Journal *journal, QObject *parent)
    : QObject(parent)
    , m_session(session)
    , m_journal(journal)
{
}

void Commands::refuse(Device *device, const Error &error, const Done &done, int field)
{
    if (error.kind != ErrorKind::Cancelled)
        emit failed(device, error, field);
    if (done)
        done(tl::unexpected(error));
}

Commands::Done Commands::reporting(Device &device, const QString &success, Done done)
{
    return [this, key = device.key(), success, done = std::move(done)](const Result<void> &result) {
        Device *present = m_session.device(key);
        if (!result)
            return refuse(present, result.error(), done);
        if (present)
            emit succeeded(present, success);
        if (done)
            done(result);
    };
}

Result<void> Commands::checkWrite(const Device &device, int fieldIndex, std::int64_t raw, bool insisting) const
{
    const Field &field = device.table().fields()[static_cast<std::size_t>(fieldIndex)];
    // Indirect Data may point at a goal or at Torque Enable.
    const bool mayMove = isGoal(field) || field.mayBeTried() || isIndirectData(field)
        || (&field == device.table().find(Known::TorqueEnable) && raw != 0);
    if (m_stopped && mayMove)
        return failure(ErrorKind::Stopped, tr("STOP is held: release it before anything moves again"));
    const QString lock = device.lockReason(fieldIndex, insisting);
    if (!lock.isEmpty())
        return failure(ErrorKind::InvalidArgument, lock);
    return checkRange(field, device.effective(fieldIndex), raw);
}

void Commands::writeField(Device &device, int fieldIndex, std::int64_t raw, Done done)
{
    write(device, fieldIndex, raw, false, std::move(done));
}

void Commands::writeUnknown(Device &device, int fieldIndex, std::int64_t raw, Done done)
{
    write(device, fieldIndex, raw, true, std::move(done));
}

void Commands::write(Device &device, int fieldIndex, std::int64_t raw, bool insisting, Done done)
{
    if (const auto allowed = checkWrite(device, fieldIndex, raw, insisting); !allowed)
        return refuse(&device, allowed.error(), done);
    const auto onItsWay = m_writes.find({device.key(), fieldIndex});
    if (onItsWay == m_writes.end())
        return sendWrite(device, fieldIndex, raw, std::move(done));
    std::optional<Waiting> &slot = onItsWay->second;
    if (slot && slot->done)
        slot->done(failure(ErrorKind::Cancelled, tr("A newer value took its place")));
    slot = Waiting{raw, insisting, std::move(done)};
    device.setPending(fieldIndex, raw);
}

void Commands::sendWrite(Device &device, int fieldIndex, std::int64_t raw, Done done)
{
    const Field &field = device.table().fields()[static_cast<std::size_t>(fieldIndex)];
    m_writes[{device.key(), fieldIndex}] = std::nullopt;
    device.setPending(fieldIndex, raw);
    const std::vector<const Field *> affected = affectedNow(device, field);
    WriteFieldPlan plan{placeOf(device), {device.id(), field.address, bytesFromRaw(field, raw)},
                        spansOf(device, among(affected)),
                        &field == device.table().find(Known::StatusReturnLevel) && raw == 0, {},
                        becomesLater(field, raw)};
    // Torque off waits for no Read, and of a drag the old value is known.
    const bool isTorqueOff = &field == device.table().find(Known::TorqueEnable) && raw == 0;
    const bool isDrag = m_journal && m_journal->continues(journalDevice(device), changeOf(field, raw));
    if (m_journal && !isTorqueOff && !isDrag)
        plan.before = spansOf(device, among(with(affected, field)));
    device.line()->bus().run<WrittenField>(
        Priority::Click, this, [plan = std::move(plan)](JobContext &context) { return dynascope::writeField(context, plan); },
        [this, key = device.key(), fieldIndex, raw, note = noteWrite(device, field, raw, affected),
         done = std::move(done)](const Result<WrittenField> &written) mutable {
            const auto values = written ? written->after : tl::unexpected(written.error());
            const std::span<const PollValue> before = written ? written->before : std::span<const PollValue>();
            if (values)
                note.done(before, *values);
            else
                note.failed(values.error(), before);
            finishWrite(key, fieldIndex, raw, values, done);
        });
}

/// The old values as last seen: what is read before the write replaces them.
JournalNote Commands::noteWrite(const Device &device, const Field &field, std::int64_t raw,
                                const std::vector<const Field *> &affected) const
{
    if (!m_journal)
        return {};
    JournalEntry entry;
    entry.device = journalDevice(device);
    entry.changes = {changeOf(field, raw)};
    if (const auto now = device.value(device.table().indexOf(&field)).raw)
        entry.changes.front().before = bytesFromRaw(field, *now);
    addResets(entry, device.table(), field, [&device](const Field &other) {
        const auto old = device.value(device.table().indexOf(&other)).raw;
        return old ? bytesFromRaw(other, *old) : Bytes();
    });
    return {m_journal, std::move(entry), affected};
}

/// A change of ID or baud rate, for which torque may be turned off first.
JournalNote Commands::noteMove(const Device &device, const Field &field, std::int64_t raw, bool turnTorqueOff) const
{
    if (!m_journal)
        return {};
    JournalEntry entry;
    entry.device = journalDevice(device);
    const int here = &field == device.table().find(Known::Id)
                         ? device.id() : device.table().baudCode(device.baudRate()).value_or(-1);
    entry.changes = {changeOf(field, raw)};
    if (here >= 0)
        entry.changes.front().before = bytesFromRaw(field, here);
    const Field *torque = device.table().find(Known::TorqueEnable);
    if (turnTorqueOff && torque && device.isTorqueOn()) {
        entry.changes.push_back(changeOf(*torque, 0));
        entry.changes.back().before = bytesFromRaw(*torque, 1);
    }
    return {m_journal, std::move(entry)};
}

JournalNote Commands::noteEvent(const Device &device, JournalKind kind, const QString &what) const
{
    JournalEntry entry;
    entry.kind = kind;
    entry.device = journalDevice(device);
    entry.note = what;
    return {m_journal, std::move(entry)};
}

void Commands::finishWrite(DeviceKey key, int fieldIndex, std::int64_t raw,
                           const Result<std::vector<PollValue>> &values, const Done &done)
{
    const auto onItsWay = m_writes.find({key, fieldIndex});
    std::optional<Waiting> next = onItsWay == m_writes.end() ? std::nullopt : std::move(onItsWay->second);
    if (onItsWay != m_writes.end())
        m_writes.erase(onItsWay);

    Device *device = m_session.device(key);
    if (device && values) {
        device->line()->answered(*device);
        device->clearPending(fieldIndex);
        for (const PollValue &value : *values)
            device->take(value);
    } else if (device && mayHaveArrived(values.error())) {
        device->setUnconfirmed(fieldIndex, raw, values.error().text);
    } else if (device) {
        device->setFailed(fieldIndex, values.error().text);
    }
    if (values) {
        if (done)
            done({});
    } else {
        refuse(device, values.error(), done, fieldIndex);
    }
    if (!next)
        return;
    if (!device || (!values && endsAll(values.error()))) // what waited behind it must not go out after a STOP
        return refuse(nullptr, {ErrorKind::Cancelled, tr("The write before it was cancelled")}, next->done);
    write(*device, fieldIndex, next->raw, next->insisting, std::move(next->done));
}

void Commands::readAll(Device &device, Done done)
{
    // Where nobody knows which bytes there are, a piece that is refused should be small.
    constexpr int Piece = 16;
    constexpr int Usual = 128;
    ReadSpansPlan plan{placeOf(device),
                       spansOf(device, [](const Field &) { return true; }, device.isKnownModel() ? Usual : Piece)};
    device.line()->bus().run<std::vector<PollValue>>(
        Priority::Normal, this, [plan = std::move(plan)](JobContext &context) { return readSpans(context, plan); },
        [this, key = device.key(), from = std::pair(device.id(), device.baudRate()), done = std::move(done)](
            const Result<std::vector<PollValue>> &values) {
            Device *present = m_session.device(key);
            const bool hasMoved = present && from != std::pair(present->id(), present->baudRate());
            // The job was made before its ID or baud rate changed: whoever answered there may be another one.
            if (hasMoved && present->line()->state() == BusThread::State::Open)
                return readAll(*present, done);
            if (!values)
                return refuse(present, values.error(), done);
            if (present) {
                present->clearFailures();
                for (const PollValue &value : *values)
                    present->take(value);
            }
            if (done)
                done({});
        });
}

/// One for each line and baud rate; `done` comes once, after the last, with the first failure there was.
struct Commands::TorqueJob {
    struct Outcome {
        int jobs = 0;
        Result<void> result;
        Done done;
    };
    bool on = false;
    std::vector<DeviceKey> keys;
    std::vector<JournalNote> notes; ///< one for each
    std::shared_ptr<Outcome> outcome;
};

void Commands::setTorque(const std::vector<Device *> &devices, bool on, Done done)
{
    if (on && m_stopped) {
        return refuse(devices.empty() ? nullptr : devices.front(),
                      {ErrorKind::Stopped, tr("STOP is held: release it before anything moves again")}, done);
    }
    auto outcome = std::make_shared<TorqueJob::Outcome>();
    outcome->done = std::move(done);
    std::map<std::pair<LineSession *, int>, std::vector<Device *>> groups;
    for (Device *device : devices) {
        if (device->table().find(Known::TorqueEnable))
            groups[{device->line(), device->baudRate()}].push_back(device);
    }
    outcome->jobs = static_cast<int>(groups.size());
    if (groups.empty() && outcome->done)
        outcome->done({});
    for (const auto &[where, members] : groups) {
        std::vector<TorqueEntry> entries;
        TorqueJob job{on, {}, {}, outcome};
        for (const Device *device : members) {
            const Field &torque = *device->table().find(Known::TorqueEnable);
            const auto affected = affectedNow(*device, torque);
            entries.push_back({device->id(), torque.address,
                               m_journal ? spansOf(*device, among(affected)) : std::vector<Span>()});
            job.keys.push_back(device->key());
            job.notes.push_back(noteWrite(*device, torque, on ? 1 : 0, affected));
        }
        where.first->bus().run<std::vector<WrittenField>>(
            Priority::Click, this,
            [entries, on, baud = where.second](JobContext &context) {
                return dynascope::setTorque(context, baud, entries, on);
            },
            [this, job](const Result<std::vector<WrittenField>> &results) { finishTorque(job, results); });
    }
}

void Commands::finishTorque(const TorqueJob &job, const Result<std::vector<WrittenField>> &results)
{
    const std::int64_t raw = job.on ? 1 : 0;
    for (std::size_t i = 0; i < job.keys.size(); ++i) {
        Device *device = m_session.device(job.keys[i]);
        const auto one = results ? (*results)[i].after : tl::unexpected(results.error());
        JournalNote note = job.notes[i];
        if (!one) {
            note.failed(one.error());
            if (job.outcome->result)
                job.outcome->result = tl::unexpected(one.error());
            const int torque = device ? device->table().indexOf(Known::TorqueEnable) : -1;
            if (torque >= 0 && mayHaveArrived(one.error()))
                device->setUnconfirmed(torque, raw, one.error().text);
            emit failed(device, one.error());
            continue;
        }
        note.done((*results)[i].before, *one);
        if (!device)
            continue;
        device->takeReadBack(device->table().indexOf(Known::TorqueEnable), raw);
        for (std::size_t moved = 1; moved < one->size(); ++moved)
            device->take((*one)[moved]);
    }
    if (--job.outcome->jobs == 0 && job.outcome->done)
        job.outcome->done(job.outcome->result);
}

int identifyField(const ControlTable &table)
{
    const int led = table.indexOf(Known::Led);
    const int blue = led >= 0 ? led : table.indexOf(u"LED Blue");
    return blue >= 0 && table.fields()[static_cast<std::size_t>(blue)].isWritable() ? blue : -1;
}

void Commands::setLed(Device &device, bool on, Done done)
{
    const int led = identifyField(device.table());
    if (led < 0)
        return refuse(&device, {ErrorKind::NotSupported, tr("%1 has no LED").arg(device.displayName())}, done);
    const bool isColour = led != device.table().indexOf(Known::Led);
    const std::int64_t bright = isColour ? device.effective(led).maximum.value_or(255) : 1;
    writeField(device, led, on ? bright : 0, std::move(done));
}

} // namespace dynascope
