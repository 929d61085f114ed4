// SPDX-License-Identifier: GPL-3.0-or-later
// New IDs and baud rates for many devices: found, planned, checked, then moved one by one.
#include "app/dxl/commands.h"
#include "app/dxl/directjob.h"
#include "app/dxl/target.h"
#include "core/bus/scan.h"
#include "core/session/deviceplace.h"
#include "core/session/moves.h"
#include "core/session/procedures/movedevices.h"

#include <algorithm>
#include <set>

namespace dynascope::dxl {

namespace {

/// Only where it has one that is in use: 253 and above stand for none.
Result<int> secondaryIdOf(const Work &work, const Found &found, const ControlTable &table)
{
    const Field *field = table.find(Known::SecondaryId);
    if (!field)
        return -1;
    const auto raw = read(work.bus, {found.id, field->address, 1});
    if (!raw && raw.error().kind != ErrorKind::Refused)
        return tl::unexpected(raw.error());
    return raw && raw->data.front() <= MaximumId ? raw->data.front() : -1;
}

/// Who is at one rate, and shall stay there for now.
Result<void> findAt(const Work &work, int baudRate, std::vector<MoveDevice> &devices)
{
    if (const auto set = work.bus.setBaudRate(baudRate); !set)
        return set;
    const auto scan = scanBaud(work.bus, {});
    if (!scan)
        return tl::unexpected(scan.error());
    if (!scan->unreadable.isEmpty())
        return failure(ErrorKind::NotConfirmed, scan->unreadable + QStringLiteral("; nothing was written"));
    for (const Found &found : scan->devices) {
        const ControlTablePtr table = work.catalog.find(found.modelNumber, found.firmware);
        const QString model = modelName(work.catalog, found.modelNumber);
        const QString name = QStringLiteral("%1 (ID %2)").arg(model).arg(found.id);
        if (!found.doubt.isEmpty())
            return failure(ErrorKind::NotConfirmed,
                           QStringLiteral("ID %1 at %2 bps: %3; nothing was written")
                               .arg(QString::number(found.id), QString::number(baudRate), found.doubt));
        MoveDevice device = table ? moveDevice(found, *table, name) : moveDevice(found, name);
        if (table) {
            const auto secondary = secondaryIdOf(work, found, *table);
            if (!secondary) {
                return failure(secondary.error().kind,
                               QStringLiteral("the Secondary ID of %1 could not be read: %2; nothing was written")
                                   .arg(name, secondary.error().text));
            }
            device.secondaryId = *secondary;
        }
        devices.push_back(std::move(device));
    }
    return {};
}

Result<void> setGoals(const Work &work, std::vector<MoveDevice> &devices)
{
    const MoveOptions &options = work.options.move;
    std::set<int> unknown;
    for (const auto &[old, now] : options.ids)
        unknown.insert(old);
    unknown.insert(options.movers.begin(), options.movers.end());
    for (MoveDevice &device : devices) {
        if (device.place.baudRate != work.options.baudRate)
            continue;
        const int id = device.place.id;
        unknown.erase(id);
        const auto pair = std::ranges::find(options.ids, id, &std::pair<int, int>::first);
        if (pair != options.ids.end())
            device.goal.id = pair->second;
        const bool isNamed = options.movers.empty() || std::ranges::find(options.movers, id) != options.movers.end();
        // Without --ids everybody goes, and with new IDs alone nobody.
        if (options.toBaud && isNamed)
            device.goal.baudRate = *options.toBaud;
        if (device.moves() && device.rates.empty()) {
            return failure(
                ErrorKind::NotSupported,
                QStringLiteral("%1: its registers are not known; nothing was written").arg(device.place.name));
        }
    }
    if (!unknown.empty()) {
        return failure(ErrorKind::NotFound, QStringLiteral("device %1 did not answer at %2 bps; nothing was written")
                                                .arg(*unknown.begin())
                                                .arg(work.options.baudRate));
    }
    return {};
}

Result<MovePlan> makePlan(const Work &work)
{
    std::vector<MoveDevice> devices;
    std::set<int> rates{work.options.baudRate};
    if (work.options.move.toBaud)
        rates.insert(*work.options.move.toBaud);
    for (const int rate : rates) {
        if (const auto found = findAt(work, rate, devices); !found)
            return tl::unexpected(found.error());
    }
    if (const auto set = work.bus.setBaudRate(work.options.baudRate); !set)
        return tl::unexpected(set.error());
    if (const auto goals = setGoals(work, devices); !goals)
        return tl::unexpected(goals.error());
    auto plan = planMoves(std::move(devices));
    if (!plan)
        return tl::unexpected(Error{plan.error().kind, plan.error().text + QStringLiteral("; nothing was written")});
    const JournalDevice here = journalDevice(Found{}, {}, work.options.port);
    plan->line = here.line;
    plan->adapter = here.adapter;
    plan->turnTorqueOff = work.options.move.turnTorqueOff;
    return plan;
}

void show(const Work &work, const MovePlan &plan, const MoveStep &step)
{
    Document document;
    document.add("id", qint64(step.from.id))
        .add("baud", qint64(step.from.baudRate))
        .add("now_id", qint64(step.to.id))
        .add("now_baud", qint64(step.to.baudRate));
    const QString model = plan.devices[step.device].place.name;
    work.output.result(QStringLiteral("%1: %2 -> %3%4")
                           .arg(model, placeText(step.from), placeText(step.to),
                                step.isDetour ? QStringLiteral(", for a while") : QString()),
                       document);
}

ExitCode perform(const Work &work, MovePlan plan, const MoveFile &file)
{
    DirectJob job(work.bus);
    const std::size_t begun = plan.next;
    if (const auto checked = checkMoves(job, plan); !checked)
        return work.output.fail(checked.error());
    const auto note = [&](const MoveStep &step) {
        const QString model = modelName(work.catalog, plan.devices[step.device].place.modelNumber);
        return noteMoveStep(&work.journal, JournalAuthor::CommandLine, plan, step, model, work.options.port);
    };
    if (!work.options.move.dryRun && plan.next > begun) // the program that began it was killed before it noted its end
        note(plan.steps[begun]).moved(foundAfter(plan, plan.steps[begun]));
    if (work.options.move.dryRun) {
        for (std::size_t i = plan.next; i < plan.steps.size(); ++i)
            show(work, plan, plan.steps[i]);
        return ExitCode::Done;
    }
    JournalNote present;
    MoveHooks hooks;
    hooks.save = [&file](const MovePlan &now) { return file.save(now); };
    hooks.begun = [&](const MoveStep &step) { present = note(step); };
    hooks.ended = [&](const MoveStep &step, const Result<Found> &found) {
        if (!found)
            return present.failed(found.error());
        present.moved(*found);
        show(work, plan, step);
    };
    const auto moved = moveDevices(job, plan, hooks);
    if (moved)
        return ExitCode::Done;
    const ExitCode code = work.output.fail(moved.error());
    if (file.exists())
        work.output.note(QStringLiteral("%1 of %2 steps are done; dxl move --resume goes on, --forget leaves it so")
                             .arg(plan.next)
                             .arg(plan.steps.size()));
    return code;
}

} // namespace

ExitCode moveCommand(const Work &work)
{
    work.output.expectMany();
    const MoveOptions &options = work.options.move;
    const MoveFile file = moveFileOf(work.options);
    if (options.forget) {
        file.remove();
        return ExitCode::Done;
    }
    if (options.resume) {
        auto left = file.load();
        if (!left)
            return work.output.refuse(left.error());
        if (const auto known = takeTables(*left, work.catalog); !known)
            return work.output.refuse(known.error());
        left->turnTorqueOff = left->turnTorqueOff || options.turnTorqueOff;
        return perform(work, std::move(*left), file);
    }
    if (file.exists() && !options.dryRun) {
        return work.output.refuse({ErrorKind::InvalidArgument,
                                   QStringLiteral("moves on this line were left half done: dxl move --resume goes on "
                                                  "with them, --forget leaves it so; nothing was written")});
    }
    auto plan = makePlan(work);
    if (!plan && plan.error().kind == ErrorKind::InvalidArgument)
        return work.output.refuse(plan.error());
    if (!plan)
        return work.output.fail(plan.error());
    if (plan->isOver())
        work.output.note(QStringLiteral("everybody is where they shall be; nothing was written"));
    return perform(work, std::move(*plan), file);
}

Result<void> checkMove(const Work &work)
{
    if (moveFileOf(work.options).exists()) {
        return failure(ErrorKind::InvalidArgument,
                       QStringLiteral("moves on this line were left half done: dxl move --resume goes on with them, "
                                      "--forget leaves it so; nothing was written"));
    }
    auto plan = makePlan(work);
    if (!plan)
        return tl::unexpected(plan.error());
    DirectJob job(work.bus);
    return checkMoves(job, *plan);
}

MoveFile moveFileOf(const Options &options)
{
    return dynascope::moveFileOf(options.port, MoveFile::usualFolder());
}

} // namespace dynascope::dxl
