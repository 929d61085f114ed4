// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/dxl/statsdevices.h"

#include <algorithm>

namespace dynascope::dxl {

namespace {

constexpr Span ModelNumber{0, 0, 2}; ///< the one register that every Protocol 2.0 device has

Result<std::vector<Found>> whoIsThere(const Work &work)
{
    std::vector<Found> found;
    if (work.options.idList.empty()) {
        auto scanned = scanBaud(work.bus, {}, {});
        if (!scanned)
            return tl::unexpected(scanned.error());
        found = std::move(scanned->devices);
    }
    for (const std::uint8_t id : work.options.idList) {
        Found one;
        one.id = id;
        one.baudRate = work.bus.line().baudRate();
        const auto reply = ping(work.bus, id);
        if (reply) {
            one.modelNumber = reply->modelNumber;
            one.firmware = reply->firmware;
        } else if (reply.error().kind == ErrorKind::PortLost) {
            return tl::unexpected(reply.error());
        }
        found.push_back(one);
    }
    return found;
}

/// Nothing where it can't be read: the bus then takes the device for factory-fresh.
std::optional<std::int64_t> valueOf(Bus &bus, std::uint8_t id, const ControlTable &table, QStringView name)
{
    const Field *field = table.find(name);
    if (!field)
        return std::nullopt;
    const auto reply = read(bus, {id, static_cast<std::uint16_t>(field->address), static_cast<std::uint16_t>(field->size)});
    return reply ? std::optional(rawFromBytes(*field, reply->data)) : std::nullopt;
}

Traits traitsOf(Bus &bus, const Found &found, const ControlTable *table)
{
    Traits traits;
    traits.id = found.id;
    traits.baudRate = found.baudRate;
    traits.firmware = found.firmware;
    if (!table)
        return traits;
    traits.fastReads = table->hasFastReads(found.firmware);
    traits.receiveBuffer = table->receiveBuffer();
    if (const auto delay = valueOf(bus, found.id, *table, u"Return Delay Time"))
        traits.returnDelay = std::chrono::microseconds(*delay * 2 + 8);
    return traits;
}

/// What is read where nothing was asked for, or nothing of it is there.
const Field *usualField(const ControlTable &table)
{
    if (const Field *position = table.find(u"Present Position"))
        return position;
    const auto ram =
        std::ranges::find_if(table.fields(), [](const Field &field) { return field.area != Area::Eeprom; });
    return ram == table.fields().end() ? nullptr : &*ram;
}

void addSpan(StatsDevices &all, std::size_t device, int address, int length, const QString &name)
{
    StatsDevice &one = all.devices[device];
    const Span span{one.found.id, static_cast<std::uint16_t>(address), static_cast<std::uint16_t>(length)};
    all.plan.spans.push_back({static_cast<quint32>(device), span, {}});
    one.watched << name;
}

void addSpans(StatsDevices &all, std::size_t device, const ControlTable *table,
    const std::vector<RegisterArgument> &registers)
{
    for (const RegisterArgument &argument : registers) {
        const Field *field = table && !argument.isByAddress() ? table->find(argument.field) : nullptr;
        if (argument.isByAddress())
            addSpan(all, device, argument.address, argument.length, argument.text());
        else if (field)
            addSpan(all, device, field->address, field->size, field->name);
    }
    if (!all.devices[device].watched.isEmpty())
        return;
    if (const Field *usual = table ? usualField(*table) : nullptr)
        addSpan(all, device, usual->address, usual->size, usual->name);
    else
        addSpan(all, device, ModelNumber.address, ModelNumber.length, QStringLiteral("Model Number"));
}

} // namespace

Result<StatsDevices> findStatsDevices(const Work &work)
{
    const auto found = whoIsThere(work);
    if (!found)
        return tl::unexpected(found.error());
    std::vector<bool> known(work.options.registers.size(), found->empty());
    StatsDevices all;
    for (const Found &one : *found) {
        const ControlTablePtr table = work.catalog.find(one.modelNumber, one.firmware);
        const bool silent = one.modelNumber == 0;
        all.devices.push_back(
            {one, silent ? QStringLiteral("?") : modelName(work.catalog, one.modelNumber), {}, {}});
        all.plan.traits.push_back(traitsOf(work.bus, one, table.get()));
        addSpans(all, all.devices.size() - 1, table.get(), work.options.registers);
        for (std::size_t i = 0; i < known.size(); ++i) {
            const RegisterArgument &argument = work.options.registers[i];
            known[i] = known[i] || argument.isByAddress() || silent || (table && table->find(argument.field));
        }
    }
    const auto missing = std::ranges::find(known, false);
    if (missing == known.end())
        return all;
    const auto index = static_cast<std::size_t>(missing - known.begin());
    return failure(ErrorKind::InvalidArgument,
        QStringLiteral("none of the devices has a field \"%1\"").arg(work.options.registers[index].field));
}

} // namespace dynascope::dxl
