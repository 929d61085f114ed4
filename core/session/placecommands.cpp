// SPDX-License-Identifier: GPL-3.0-or-later
// Commands after which a device stands elsewhere, or is gone for a moment.
#include "core/session/commands.h"

#include "core/bus/operations.h"
#include "core/session/procedures/atbaud.h"
#include "core/session/resetplan.h"

#include <QTimer>

#include <algorithm>
#include <chrono>

namespace dynascope {
namespace {

using namespace std::chrono_literals;

constexpr auto BootTime = 450ms;    ///< most are back after 0.4 s
constexpr int ReturnAttempts = 8;   ///< some take up to 3 s

/// The line goes along where nobody is left at its own rate.
void follow(LineSession &line, int from, int to)
{
    const bool others = std::ranges::any_of(
        line.devices(), [](const auto &each) { return each->state() == Device::State::Present; });
    if (to != from && !others)
        line.setWorkingBaudRate(to);
}

} // namespace

void Commands::runAt(Device &device, std::function<Result<void>(Bus &)> operation, Done done)
{
    device.line()->bus().run<void>(
        Priority::Click, this,
        [place = placeOf(device), operation = std::move(operation)](JobContext &context) {
            return atPlace(context, place, operation);
        },
        std::move(done));
}

void Commands::ping(Device &device, Done done)
{
    device.line()->bus().run<Found>(
        Priority::Click, this, [place = placeOf(device)](JobContext &context) { return look(context, place); },
        [this, key = device.key(), done = std::move(done)](const Result<Found> &found) {
            Device *present = m_session.device(key);
            if (!found) {
                if (present && found.error().kind != ErrorKind::Cancelled && found.error().kind != ErrorKind::Stopped)
                    present->setState(Device::State::Silent);
                return refuse(present, found.error(), done);
            }
            if (present) {
                Found answered = *found;
                answered.doubt = present->doubt(); // two under one ID may answer a Ping as one
                present->line()->heard(answered);
            }
            if (done)
                done({});
        });
}

void Commands::reboot(Device &device, Done done)
{
    // Startup Configuration may turn torque on when it comes back.
    if (m_stopped)
        return refuse(&device, {ErrorKind::Stopped, tr("STOP is held: release it before anything reboots")}, done);
    const DevicePlace place = placeOf(device);
    auto report = reporting(device, tr("%1 has rebooted; its RAM is back to defaults").arg(place.name), std::move(done));
    auto sent = [this, key = device.key(), place, report,
                 note = noteEvent(device, JournalKind::Reboot)](const Result<void> &result) mutable {
        // The status of Reboot may be missing or cut off by it.
        result ? note.done() : note.failed(result.error());
        if (!result && !mayHaveArrived(result.error()))
            return report(result);
        if (Device *present = m_session.device(key))
            present->setState(Device::State::Rebooting);
        awaitReturn(key, place, place, ReturnAttempts, report);
    };
    runAt(device, [id = device.id()](Bus &bus) { return dynascope::reboot(bus, id); }, sent);
}

void Commands::controlTableBackup(Device &device, BackupOption option, Done done)
{
    const bool restore = option == BackupOption::Restore;
    if (m_stopped && restore) // Startup Configuration may turn torque on
        return refuse(&device, {ErrorKind::Stopped, tr("STOP is held: release it before anything restarts")}, done);
    const DevicePlace place = placeOf(device);
    const QString success = restore ? tr("%1 has restored its own backup and restarted")
                                    : tr("%1 has stored a backup of its own");
    auto report = reporting(device, success.arg(place.name), std::move(done));
    auto sent = [this, key = device.key(), place, report, restore,
                 note = noteEvent(device, restore ? JournalKind::Restore : JournalKind::Backup)](
                    const Result<void> &result) mutable {
        result ? note.done() : note.failed(result.error());
        Device *present = m_session.device(key);
        if (!result && (!restore || !mayHaveArrived(result.error())))
            return report(result);
        if (!present)
            return report({});
        if (!restore)
            return readAll(*present, report);
        present->setState(Device::State::Rebooting);
        awaitReturn(key, place, place, ReturnAttempts, report);
    };
    runAt(device, [id = device.id(), option](Bus &bus) { return dynascope::backup(bus, id, option); }, sent);
}

/// After a boot. Where the device should be elsewhere then, the old place is looked at from the second time on: by then
/// who answers there has ignored what was asked of it.
void Commands::awaitReturn(DeviceKey key, const DevicePlace &from, const DevicePlace &to, int attempts, Done done)
{
    QTimer::singleShot(BootTime, this, [this, key, from, to, attempts, done = std::move(done)] {
        Device *device = m_session.device(key);
        if (!device) {
            done(failure(ErrorKind::Cancelled, tr("The device is gone")));
            return;
        }
        const DevicePlace old = attempts < ReturnAttempts ? from : to;
        device->line()->bus().run<Found>(
            Priority::Click, this, [old, to](JobContext &context) { return lookForMoved(context, old, to); },
            [this, key, from, to, attempts, done](const Result<Found> &found) {
                Device *present = m_session.device(key);
                if (found && present)
                    return finishReturn(*present, from, to, *found, done);
                if (present && attempts > 1 && found.error().kind != ErrorKind::PortLost)
                    return awaitReturn(key, from, to, attempts - 1, done);
                if (present)
                    present->setState(Device::State::Silent);
                done(tl::unexpected(found ? Error{ErrorKind::Cancelled, tr("The device is gone")} : found.error()));
            });
    });
}

void Commands::finishReturn(Device &device, const DevicePlace &from, const DevicePlace &to, const Found &found,
                            const Done &done)
{
    moved(device.key(), found);
    follow(*device.line(), from.baudRate, found.baudRate);
    if (isAt(found, to))
        return readAll(device, done);
    readAll(device);
    done(failure(ErrorKind::NotConfirmed, tr("%1 still answers at ID %2, %3 bps: it did not take the reset")
                                              .arg(from.name)
                                              .arg(from.id)
                                              .arg(from.baudRate)));
}

void Commands::moved(DeviceKey key, const Found &found)
{
    Device *device = m_session.device(key);
    if (!device)
        return;
    device->line()->moveDevice(*device, found);
    // It answered there: that is what its registers say, before they are read again.
    const ControlTable &table = device->table();
    if (const int id = table.indexOf(Known::Id); id >= 0)
        device->takeReadBack(id, found.id);
    const int baud = table.indexOf(Known::BaudRate);
    if (const auto code = table.baudCode(found.baudRate); baud >= 0 && code)
        device->takeReadBack(baud, *code);
}

void Commands::finishChange(DeviceKey key, const DevicePlace &from, const DevicePlace &to, const Result<Found> &found,
                            JournalNote note, const Done &report)
{
    found ? note.moved(*found) : note.failed(found.error());
    if (!found && found.error().kind == ErrorKind::Stopped)
        return lookAgain(key, from, to, note, report);
    if (!found)
        return report(tl::unexpected(found.error()));
    moved(key, *found);
    if (Device *device = m_session.device(key)) {
        follow(*device->line(), from.baudRate, found->baudRate);
        readAll(*device);
    }
    report({});
}

/// STOP came in the middle of a change: nobody knows yet whether the device took it.
void Commands::lookAgain(DeviceKey key, const DevicePlace &from, const DevicePlace &to, const JournalNote &note,
                         const Done &report)
{
    Device *device = m_session.device(key);
    if (!device)
        return report(failure(ErrorKind::Stopped, tr("STOP ended the change")));
    device->line()->bus().run<Found>(
        Priority::Click, this, [from, to](JobContext &context) { return lookForMoved(context, from, to); },
        [this, key, from, to, note = note, report](const Result<Found> &found) mutable {
            Device *present = m_session.device(key);
            if (found) {
                if (isAt(*found, to))
                    note.moved(*found);
                moved(key, *found);
                return report(failure(ErrorKind::Stopped, tr("STOP ended the change: %1 is at ID %2, %3 bps")
                                                              .arg(from.name)
                                                              .arg(found->id)
                                                              .arg(found->baudRate)));
            }
            const ErrorKind kind = found.error().kind;
            const bool pressedAgain = kind == ErrorKind::Stopped || kind == ErrorKind::Cancelled;
            if (pressedAgain && present && present->line()->state() == BusThread::State::Open)
                return lookAgain(key, from, to, note, report);
            if (present)
                present->setState(Device::State::Silent);
            report(failure(ErrorKind::Stopped, tr("STOP ended the change: %1").arg(found.error().text)));
        });
}

void Commands::factoryReset(Device &device, ResetOption option, Done done)
{
    const FactoryResetPlan plan{placeOf(device), option, placeAfterReset(device, option)};
    if (!device.table().find(Known::Id) || !device.table().find(Known::BaudRate)) {
        return refuse(&device,
                      {ErrorKind::NotSupported,
                       tr("It isn't known where %1 would be after a reset").arg(device.displayName())},
                      done);
    }

    if (option == ResetOption::All && device.table().description().axes > 1) {
        return refuse(&device,
                      {ErrorKind::NotSupported,
                       tr("%1 is one of two axes, and it isn't known which ID this reset gives it; keep the ID, then "
                          "change it")
                           .arg(device.displayName())},
                      done);
    }

    auto report = reporting(device,
                            tr("%1 is reset; it is now ID %2 at %3 bps")
                                .arg(plan.place.name)
                                .arg(plan.after.id)
                                .arg(plan.after.baudRate),
                            std::move(done));
    device.line()->bus().run<void>(
        Priority::Click, this, [plan](JobContext &context) { return resetToFactory(context, plan); },
        [this, key = device.key(), from = plan.place, to = plan.after, report,
         note = noteEvent(device, JournalKind::FactoryReset)](const Result<void> &result) mutable {
            if (!result) {
                note.failed(result.error());
                return report(result);
            }
            note.moved({to.id, to.baudRate, to.modelNumber, 0, false, {}}); // most likely; killed now, it is looked for there
            if (Device *present = m_session.device(key))
                present->setState(Device::State::Rebooting);
            awaitReturn(key, from, to, ReturnAttempts, [report, note](const Result<void> &back) mutable {
                if (!back && back.error().kind == ErrorKind::NotConfirmed)
                    note.failed(back.error());
                report(back);
            });
        });
}

struct Commands::Resets {
    std::vector<DeviceKey> keys; ///< the next one last
    ResetOption option = ResetOption::AllButIdAndBaud;
    Done done;
    Result<void> outcome;
};

void Commands::factoryReset(const std::vector<Device *> &devices, ResetOption option, Done done)
{
    const auto order = resetOrder(devices, option);
    if (!order)
        return refuse(devices.empty() ? nullptr : devices.front(), order.error(), done);
    auto resets = std::make_shared<Resets>();
    resets->option = option;
    resets->done = std::move(done);
    for (const Device *device : *order)
        resets->keys.insert(resets->keys.begin(), device->key());
    resetNext(resets);
}

void Commands::resetNext(const std::shared_ptr<Resets> &resets)
{
    Device *next = nullptr;
    while (!next && !resets->keys.empty()) {
        next = m_session.device(resets->keys.back()); // who is gone meanwhile is passed over
        resets->keys.pop_back();
    }
    if (!next) {
        if (resets->done)
            resets->done(resets->outcome);
        return;
    }
    factoryReset(*next, resets->option, [this, resets](const Result<void> &result) {
        if (!result && resets->outcome)
            resets->outcome = result;
        if (!result && endsAll(result.error()))
            resets->keys.clear();
        resetNext(resets);
    });
}

void Commands::clearMultiTurn(Device &device, Done done)
{
    auto report = reporting(device, tr("%1: multi-turn position cleared").arg(device.displayName()), std::move(done));
    runAt(device, [id = device.id()](Bus &bus) { return dynascope::clear(bus, id, ClearOption::Position); },
          [report, note = noteEvent(device, JournalKind::Clear)](const Result<void> &result) mutable {
              result ? note.done() : note.failed(result.error());
              report(result);
          });
}

void Commands::changeId(Device &device, int newId, bool turnTorqueOff, Done done)
{
    const Field *field = device.table().find(Known::Id);
    const auto invalid = [&](const QString &text) { refuse(&device, {ErrorKind::InvalidArgument, text}, done); };
    if (!field)
        return invalid(tr("The table of %1 has no ID register").arg(device.displayName()));
    if (newId < 0 || newId > MaximumId)
        return invalid(tr("An ID is 0 to %1, not %2").arg(MaximumId).arg(newId));
    if (newId == device.id())
        return invalid(tr("%1 has that ID already").arg(device.displayName()));
    if (const IdHolder holder = holderOf(device, newId); holder.device) {
        return invalid((holder.isSecondary ? tr("ID %1 is the Secondary ID of %2") : tr("ID %1 is taken by %2"))
                           .arg(newId)
                           .arg(holder.device->displayName()));
    }
    ChangeIdPlan plan{placeOf(device), static_cast<std::uint8_t>(newId), field->address, turnTorqueOff};
    auto report = reporting(device, tr("%1 now has ID %2").arg(device.displayName()).arg(newId), std::move(done));
    device.line()->bus().run<Found>(
        Priority::Click, this,
        [plan](JobContext &context) { return dynascope::changeId(context, plan); },
        [this, key = device.key(), from = plan.place, newId = plan.newId, report,
         note = noteMove(device, *field, newId, turnTorqueOff)](const Result<Found> &found) {
            DevicePlace to = from;
            to.id = newId;
            finishChange(key, from, to, found, note, report);
        });
}

void Commands::changeBaud(Device &device, int newBaud, bool turnTorqueOff, Done done)
{
    const Field *field = device.table().find(Known::BaudRate);
    const auto invalid = [&](const QString &text) { refuse(&device, {ErrorKind::InvalidArgument, text}, done); };
    if (newBaud == device.baudRate())
        return invalid(tr("%1 works at that baud rate already").arg(device.displayName()));
    const std::optional<int> code = device.table().baudCode(newBaud);
    if (!field || !code)
        return invalid(tr("%1 does not offer %2 bps").arg(device.model()).arg(newBaud));
    if (const IdHolder holder = holderOf(device, device.id(), newBaud); holder.device) {
        return invalid((holder.isSecondary ? tr("ID %1 at %2 bps is the Secondary ID of %3")
                                           : tr("ID %1 at %2 bps is taken by %3"))
                           .arg(device.id())
                           .arg(newBaud)
                           .arg(holder.device->displayName()));
    }

    ChangeBaudPlan plan{placeOf(device), newBaud, static_cast<std::uint8_t>(*code), field->address, turnTorqueOff};
    auto report = reporting(device, tr("%1 now works at %2 bps").arg(device.displayName()).arg(newBaud), std::move(done));
    device.line()->bus().run<Found>(
        Priority::Click, this,
        [plan](JobContext &context) { return dynascope::changeBaud(context, plan); },
        [this, key = device.key(), from = plan.place, newBaud, report,
         note = noteMove(device, *field, *code, turnTorqueOff)](const Result<Found> &found) {
            DevicePlace to = from;
            to.baudRate = newBaud;
            finishChange(key, from, to, found, note, report);
        });
}

void Commands::workAtBaud(LineSession &line, int baudRate, Done done)
{
    line.bus().run<void>(
        Priority::Click, this,
        [baudRate](JobContext &context) { return AtBaud(context.bus(), baudRate).entered(); },
        [this, where = QPointer<LineSession>(&line), baudRate, done = std::move(done)](const Result<void> &result) {
            if (!result)
                return refuse(nullptr, result.error(), done);
            if (where)
                where->setWorkingBaudRate(baudRate);
            if (done)
                done(result);
        });
}

} // namespace dynascope
