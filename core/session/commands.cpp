// SPDX-License-Identifier: GPL-3.0-or-later
// Registers: writing, reading, torque, LED. What moves a device or makes it reboot is in placecommands.cpp.
#include "core/session/commands.h"

#include "core/table/units.h"

#include <algorithm>
#include <set>

namespace dynascope {
namespace {

constexpr int LargestGap = 8; ///< bytes that are cheaper to read through than to ask again

/// What a write to this field may have moved: the registers it resets, torque that a goal turned on, or nothing.
std::vector<Span> sideEffectsOf(const Device &device, const Field &field)
{
    if (&field == device.table().find(Known::TorqueEnable)) {
        return spansOf(device, [](const Field &other) { return isGoal(other); });
    }
    if (isGoal(field) && device.goalTurnsTorqueOn() && !device.isTorqueOn()) {
        const Field *torque = device.table().find(Known::TorqueEnable);
        return spansOf(device, [torque](const Field &other) { return &other == torque; });
    }
    if (field.resets.isEmpty())
        return {};
    return spansOf(device, [&field](const Field &other) { return field.resets.contains(other.name); });
}

/// Manual: "Hybrid Save". It is a request and its answer in one register.
Bytes laterBytes(const Field &field, std::int64_t raw)
{
    constexpr std::int64_t Save = 1, Saved = 2;
    return field.name == u"Hybrid Save" && raw == Save ? bytesFromRaw(field, Saved) : Bytes();
}

} // namespace

bool isGoal(const Field &field)
{
    return field.name.startsWith(QLatin1String("Goal ")) || field.name == u"Moving Speed"; // the latter: XL-320
}

std::vector<Span> spansOf(const Device &device, const std::function<bool(const Field &)> &wanted, int longest)
{
    std::vector<Span> spans;
    for (const Field &field : device.table().fields()) {
        if (!wanted(field))
            continue;
        if (!spans.empty()) {
            Span &last = spans.back();
            const int end = last.address + last.length;
            if (field.address - end <= LargestGap && field.end() - last.address <= longest) {
                last.length = static_cast<std::uint16_t>(field.end() - last.address);
                continue;
            }
        }
        spans.push_back({device.id(), field.address, field.size});
    }
    return spans;
}

Commands::Commands(Session &session, QObject *parent)
    : QObject(parent)
    , m_session(session)
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
    const bool mayMove = isGoal(field) || field.mayBeTried() || field.name.startsWith(QLatin1String("Indirect Data"))
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
    WriteFieldPlan plan{placeOf(device), {device.id(), field.address, bytesFromRaw(field, raw)},
                        sideEffectsOf(device, field),
                        &field == device.table().find(Known::StatusReturnLevel) && raw == 0,
                        laterBytes(field, raw)};
    device.line()->bus().run<std::vector<PollValue>>(
        Priority::Click, this, [plan = std::move(plan)](JobContext &context) { return dynascope::writeField(context, plan); },
        [this, key = device.key(), fieldIndex, raw,
         done = std::move(done)](const Result<std::vector<PollValue>> &values) {
            finishWrite(key, fieldIndex, raw, values, done);
        });
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
    const bool ended = !values
        && (values.error().kind == ErrorKind::Cancelled || values.error().kind == ErrorKind::Stopped
            || values.error().kind == ErrorKind::PortLost);
    if (!device || ended) // what waited behind it must not go out after a STOP
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
            if (!values && hasMoved && present->line()->state() == BusThread::State::Open)
                return readAll(*present, done); // the job was made before its ID or baud rate changed
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

void Commands::setTorque(const std::vector<Device *> &devices, bool on, Done done)
{
    if (on && m_stopped) {
        return refuse(devices.empty() ? nullptr : devices.front(),
                      {ErrorKind::Stopped, tr("STOP is held: release it before anything moves again")}, done);
    }
    // One job per line and baud rate; `done` comes once, after the last, with the first failure there was.
    struct Outcome {
        int jobs = 0;
        Result<void> result;
        Done done;
    };
    auto outcome = std::make_shared<Outcome>();
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
        std::vector<DeviceKey> keys;
        for (const Device *device : members) {
            entries.push_back({device->id(), placeOf(*device).torqueAddress});
            keys.push_back(device->key());
        }
        const auto finished = [this, outcome, keys, on](const Result<std::vector<Result<void>>> &results) {
            for (std::size_t i = 0; i < keys.size(); ++i) {
                Device *device = m_session.device(keys[i]);
                const Result<void> one = results ? (*results)[i] : tl::unexpected(results.error());
                if (!one) {
                    outcome->result = one;
                    const int torque = device ? device->table().indexOf(Known::TorqueEnable) : -1;
                    if (torque >= 0 && mayHaveArrived(one.error()))
                        device->setUnconfirmed(torque, on ? 1 : 0, one.error().text);
                    emit failed(device, one.error());
                } else if (device) {
                    device->takeReadBack(device->table().indexOf(Known::TorqueEnable), on ? 1 : 0);
                }
            }
            if (--outcome->jobs == 0 && outcome->done)
                outcome->done(outcome->result);
        };
        where.first->bus().run<std::vector<Result<void>>>(
            Priority::Click, this,
            [entries, on, baud = where.second](JobContext &context) {
                return dynascope::setTorque(context, baud, entries, on);
            },
            finished);
    }
}

void Commands::setLed(Device &device, bool on, Done done)
{
    const int led = device.table().indexOf(Known::Led);
    if (led < 0) {
        return refuse(&device, {ErrorKind::NotSupported, tr("%1 has no LED").arg(device.displayName())}, done);
    }
    writeField(device, led, on ? 1 : 0, std::move(done));
}

} // namespace dynascope
