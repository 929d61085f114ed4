// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/moves.h"

#include "core/session/deviceplace.h"
#include "core/session/linesession.h"
#include "core/session/texts.h"
#include "core/table/catalog.h"

#include <algorithm>

namespace dynascope {
namespace {

Found foundAt(const MoveDevice &device, const MovePlace &place)
{
    Found found;
    found.id = static_cast<std::uint8_t>(place.id);
    found.baudRate = place.baudRate;
    found.modelNumber = device.place.modelNumber;
    found.firmware = static_cast<std::uint8_t>(device.firmware);
    return found;
}

} // namespace

MoveFile moveFileOf(const QString &line, const QString &folder)
{
    if (line == QLatin1String("sim"))
        return {{}, {}, {}};
    const JournalDevice here = journalDevice(Found{}, {}, line);
    return {folder, here.line, here.adapter};
}

std::vector<MoveDevice> moveDevicesOf(const LineSession &line)
{
    std::vector<MoveDevice> devices;
    for (const auto &each : line.devices()) {
        MoveDevice device = moveDevice(each->found(), each->table(), each->displayName());
        const std::int64_t secondary = each->raw(Known::SecondaryId).value_or(-1);
        // 253 and above stand for none.
        device.secondaryId = secondary <= MaximumId ? static_cast<int>(secondary) : -1;
        if (!each->isKnownModel())
            device.rates.clear();
        devices.push_back(std::move(device));
    }
    return devices;
}

Result<void> takeTables(MovePlan &plan, const Catalog &catalog)
{
    for (std::size_t i = 0; i < plan.devices.size(); ++i) {
        MoveDevice &device = plan.devices[i];
        const ControlTablePtr table = catalog.find(device.place.modelNumber, device.firmware);
        const bool moves = std::ranges::any_of(plan.steps, [i](const MoveStep &step) { return step.device == i; });
        if (!table && !moves) // it stays: nobody has to know its model
            continue;
        if (!table) {
            return failure(
                ErrorKind::InvalidArgument,
                MoveText::tr("the plan that was left names model %1, which has no control table; nothing was written")
                    .arg(device.place.modelNumber));
        }
        const MoveDevice known =
            moveDevice(foundAt(device, {device.place.baudRate, device.place.id}), *table, device.place.name);
        device.idAddress = known.idAddress;
        device.baudAddress = known.baudAddress;
        device.rates = known.rates;
        device.place = known.place;
    }
    return {};
}

JournalNote noteMoveStep(Journal *journal, JournalAuthor by, const MovePlan &plan, const MoveStep &step,
                         const QString &model, const QString &line, bool endsTorque)
{
    if (!journal)
        return {};
    const MoveDevice &device = plan.devices[step.device];
    JournalEntry entry;
    entry.by = by;
    entry.device = journalDevice(foundAt(device, step.from), model, line);
    const auto code = [&device](int rate) {
        const auto at = std::ranges::find(device.rates, rate, &std::pair<int, int>::first);
        return static_cast<std::uint8_t>(at == device.rates.end() ? 0 : at->second);
    };
    RegisterChange change;
    change.name = nameOf(step.isBaud() ? Known::BaudRate : Known::Id).toString();
    change.address = step.isBaud() ? device.baudAddress : device.idAddress;
    change.before = {step.isBaud() ? code(step.from.baudRate) : static_cast<std::uint8_t>(step.from.id)};
    change.after = {step.isBaud() ? code(step.to.baudRate) : static_cast<std::uint8_t>(step.to.id)};
    entry.changes = {change};
    if (endsTorque && plan.turnTorqueOff) {
        RegisterChange torque;
        torque.name = nameOf(Known::TorqueEnable).toString();
        torque.address = device.place.torqueAddress;
        torque.before = {1};
        torque.after = {0};
        entry.changes.push_back(torque);
    }
    return {journal, std::move(entry)};
}

Found foundAfter(const MovePlan &plan, const MoveStep &step)
{
    return foundAt(plan.devices[step.device], step.to);
}

} // namespace dynascope
