// SPDX-License-Identifier: GPL-3.0-or-later
// Reboot, Factory Reset and Clear: a device is away for a while, or stands elsewhere afterwards.
#include "app/dxl/commands.h"
#include "app/dxl/directjob.h"
#include "app/dxl/noting.h"
#include "app/dxl/restarting.h"
#include "app/dxl/showvalue.h"
#include "app/dxl/target.h"
#include "app/dxl/terminal.h"
#include "core/bus/messages.h"
#include "core/bus/operations.h"
#include "core/session/resetplan.h"

namespace dynascope::dxl {

namespace {

using namespace std::chrono_literals;

constexpr LineTime FirstLook = 300ms; ///< most are back after 0.4 s
constexpr LineTime NextLook = 100ms;
constexpr LineTime LongestBoot = 4s; ///< some take up to 3 s

QString durationText(LineTime duration)
{
    return QStringLiteral("%1 s").arg(std::chrono::duration<double>(duration).count(), 0, 'f', 2);
}

QString resetName(ResetOption option)
{
    switch (option) {
    case ResetOption::All: return QStringLiteral("all");
    case ResetOption::AllButId: return QStringLiteral("all-but-id");
    case ResetOption::AllButIdAndBaud: break;
    }
    return QStringLiteral("all-but-id-and-baud");
}

Result<DevicePlace> placeAfter(const Device &device, ResetOption option)
{
    DevicePlace after = placeOf(device);
    const Field *id = device.table() ? device.table()->find(Known::Id) : nullptr;
    const Field *baud = device.table() ? device.table()->find(Known::BaudRate) : nullptr;
    if (option != ResetOption::AllButIdAndBaud && (!id || !baud)) {
        return failure(ErrorKind::NotSupported,
                       QStringLiteral("%1: its model is not known, nor where it would be after this reset; reset "
                                      "all-but-id-and-baud leaves it where it is")
                           .arg(device.name()));
    }
    if (option == ResetOption::All && device.table()->description().axes > 1) {
        return failure(ErrorKind::NotSupported,
                       QStringLiteral("%1 is one of two axes, and it isn't known which ID this reset gives it; reset "
                                      "all-but-id, then write the ID")
                           .arg(device.name()));
    }
    if (option == ResetOption::All)
        after.id = static_cast<std::uint8_t>(id->initial.value_or(1));
    if (option != ResetOption::AllButIdAndBaud)
        after.baudRate = device.table()->baudRate(static_cast<int>(baud->initial.value_or(1))).value_or(57600);
    return after;
}

/// Of several at once two may not end at one place.
Result<void> checkAfterwards(const Work &work, const std::deque<Device> &devices)
{
    std::vector<ResetMove> resets;
    for (const Device &device : devices) {
        if (const auto after = placeAfter(device, work.options.reset)) // else its own turn says why
            resets.push_back({placeOf(device), *after});
    }
    const auto order = planResets(resets, {});
    if (!order)
        return failure(order.error().kind, order.error().text + QStringLiteral("; nothing was sent"));
    return {};
}

/// What a Factory Reset leaves as it is.
QString survives(ResetOption option)
{
    switch (option) {
    case ResetOption::All: return QStringLiteral("ID and baud rate go, too");
    case ResetOption::AllButId: return QStringLiteral("the baud rate goes, too, the ID stays");
    case ResetOption::AllButIdAndBaud: break;
    }
    return QStringLiteral("ID and baud rate stay");
}

Result<void> checkAway(Bus &bus, const Device &device)
{
    if (const auto waited = bus.wait(30ms); !waited)
        return waited;
    const auto answer = bus.exchange(pingRequest(device.id()), 0);
    if (!answer)
        return tl::unexpected(answer.error());
    if (!answer->replies.front())
        return {};
    return failure(ErrorKind::NotConfirmed,
                   QStringLiteral("%1 did not confirm the reboot, and still answers").arg(device.name()));
}

Result<void> rebootOne(const Work &work, Device &device)
{
    const DevicePlace place = placeOf(device);
    // The status of Reboot may be missing or cut off by it.
    JournalNote note = noteEvent(work, device, JournalKind::Reboot);
    const auto sent = reboot(work.bus, device.id());
    finish(note, sent);
    if (!sent && !mayHaveArrived(sent.error()))
        return sent;
    if (!sent) { // whoever restarts is silent now
        if (const auto away = checkAway(work.bus, device); !away)
            return away;
    }
    LineTime took{};
    const auto found = awaitReturn(work.bus, place, place, took);
    if (!found)
        return tl::unexpected(found.error());
    Document document;
    document.add("id", qint64(device.id()))
        .add("rebooted_s", std::chrono::duration<double>(took).count())
        .addFlag("alert", found->alert);
    const QString alert = found->alert ? QStringLiteral(", alert: see Hardware Error Status") : QString();
    work.output.result(QStringLiteral("%1: back %2 after its reboot%3").arg(device.name(), durationText(took), alert),
                       document);
    return {};
}

Result<void> resetOne(const Work &work, Device &device)
{
    const auto after = placeAfter(device, work.options.reset);
    if (!after)
        return tl::unexpected(after.error());
    const FactoryResetPlan plan{placeOf(device), work.options.reset, *after};
    DirectJob job(work.bus);
    JournalNote note = noteEvent(work, device, JournalKind::FactoryReset, resetName(plan.option));
    if (const auto sent = resetToFactory(job, plan); !sent) {
        note.failed(sent.error());
        return sent;
    }
    note.moved({plan.after.id, plan.after.baudRate, plan.after.modelNumber, 0, false, {}});
    LineTime took{};
    auto found = awaitReturn(work.bus, plan.place, plan.after, took);
    if (found && !isAt(*found, plan.after)) {
        found = failure(ErrorKind::NotConfirmed,
                        QStringLiteral("%1 still answers at ID %2, %3 bps: it did not take the reset")
                            .arg(device.name())
                            .arg(found->id)
                            .arg(found->baudRate));
    }
    if (!found) {
        if (found.error().kind == ErrorKind::NotConfirmed)
            note.failed(found.error());
        return tl::unexpected(found.error());
    }
    Document document;
    document.add("id", qint64(device.id()))
        .add("reset", resetName(plan.option))
        .add("now_id", qint64(found->id))
        .add("now_baud", qint64(found->baudRate));
    work.output.result(QStringLiteral("%1: reset (%2); it is now ID %3 at %4 bps")
                           .arg(device.name(), resetName(plan.option))
                           .arg(found->id)
                           .arg(found->baudRate),
                       document);
    return {};
}

Result<void> clearOne(const Work &work, Device &device)
{
    const bool position = work.options.clear == ClearOption::Position;
    JournalNote note = noteEvent(work, device, JournalKind::Clear,
                                 position ? QStringLiteral("position") : QStringLiteral("error"));
    const auto cleared = clear(work.bus, device.id(), work.options.clear);
    finish(note, cleared);
    if (!cleared)
        return cleared;
    const Field *field = device.table() && position ? device.table()->find(Known::PresentPosition) : nullptr;
    if (field) {
        const auto raw = device.read(*field);
        if (!raw)
            return tl::unexpected(raw.error());
        showField(work.output, device, *field, *raw);
        return {};
    }
    Document document;
    document.add("id", qint64(device.id()))
        .add("cleared", position ? QStringLiteral("position") : QStringLiteral("error"));
    work.output.result(QStringLiteral("%1: cleared").arg(device.name()), document);
    return {};
}

} // namespace

Result<Found> awaitReturn(Bus &bus, const DevicePlace &from, const DevicePlace &to, LineTime &took)
{
    DirectJob job(bus);
    const LineTime begin = bus.line().now();
    if (const auto waited = bus.wait(FirstLook); !waited)
        return tl::unexpected(waited.error());
    while (true) {
        // Until it had time to boot, who answers at the old place has not begun to.
        const bool early = bus.line().now() - begin < LongestBoot / 2;
        auto found = lookForMoved(job, early ? to : from, to);
        took = bus.line().now() - begin;
        if (found || endsAll(found.error()) || took > LongestBoot)
            return found;
        if (const auto waited = bus.wait(NextLook); !waited)
            return tl::unexpected(waited.error());
    }
}

DevicePlace placeOf(const Device &device)
{
    if (device.table())
        return dynascope::placeOf(device.found(), *device.table(), device.name());
    DevicePlace place;
    place.id = device.id();
    place.baudRate = device.found().baudRate;
    place.modelNumber = device.found().modelNumber;
    place.name = device.name();
    return place;
}

bool mayGoOn(const Work &work, const QString &what)
{
    if (work.options.yes)
        return true;
    if (!isTerminal(stdin)) {
        work.output.refuse(
            {ErrorKind::InvalidArgument,
             QStringLiteral("%1; say --yes, since nobody can be asked here; nothing was sent").arg(what)});
        return false;
    }
    if (answersYes(QStringLiteral("%1. Type yes to go on:").arg(what)))
        return true;
    work.output.note(QStringLiteral("nothing was sent"));
    return false;
}

QString idsText(const Options &options)
{
    QStringList texts;
    for (const std::uint8_t id : options.idList)
        texts << QString::number(id);
    return (texts.size() == 1 ? QStringLiteral("device ") : QStringLiteral("devices "))
           + texts.join(QStringLiteral(", "));
}

ExitCode rebootCommand(const Work &work)
{
    return forEachDevice(work, [&](Device &device) { return rebootOne(work, device); });
}

ExitCode resetCommand(const Work &work)
{
    const QString what = QStringLiteral("a Factory Reset (%1) of %2 overwrites the EEPROM (%3)")
                             .arg(resetName(work.options.reset), idsText(work.options), survives(work.options.reset));
    if (!mayGoOn(work, what))
        return ExitCode::Usage;
    return forEachDevice(
        work, [&](Device &device) { return resetOne(work, device); },
        [&](const std::deque<Device> &devices) { return checkAfterwards(work, devices); });
}

ExitCode clearCommand(const Work &work)
{
    return forEachDevice(work, [&](Device &device) { return clearOne(work, device); });
}

} // namespace dynascope::dxl
