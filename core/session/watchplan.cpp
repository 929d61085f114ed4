// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/watchplan.h"

#include "core/session/commands.h"
#include "core/session/vitals.h"
#include "core/table/indirect.h"

#include <algorithm>
#include <cmath>

namespace dynascope {
namespace {

using namespace std::chrono_literals;

constexpr auto SelectedInterval = 100ms;
constexpr auto GlanceInterval = 200ms;
constexpr auto StateInterval = 1000ms;
constexpr auto SignInterval = 9000ms; ///< with a cycle that is late still within 10 s

/// Those in long runs that nobody looks at.
std::set<int> foldedFields(const DeviceWatches &watches)
{
    std::set<int> folded;
    for (const FieldRun &run : longRuns(watches.device->table())) {
        for (int field = run.first; field <= run.last; ++field) {
            if (!watches.unfolded.contains(field))
                folded.insert(field);
        }
    }
    return folded;
}

bool isState(const Field &field)
{
    return field.name == QLatin1String("Torque Enable") || isVital(field, Vital::Error) || isVital(field, Vital::Voltage)
        || isVital(field, Vital::Temperature);
}

/// What of the selected device is read all the time. Where nobody knows what a register is, reading waits to be asked.
bool isLive(const Field &field)
{
    return field.area == Area::Ram || field.area == Area::Hybrid;
}

/// What tells how it answers: read until it is known.
bool isUnknownManner(const Device &device, const Field &field)
{
    const ControlTable &table = device.table();
    return (&field == table.find(Known::ReturnDelayTime) || &field == table.find(Known::StatusReturnLevel))
        && !device.raw(field.name);
}

bool isAtFullRate(const DeviceWatches &watches, int field)
{
    return std::ranges::find(watches.fields, field) != watches.fields.end() && !watches.rates.contains(field);
}

void addSpans(PollPlan &plan, const Device &device, std::chrono::milliseconds interval,
              const std::function<bool(const Field &)> &wanted)
{
    for (const Span &span : spansOf(device, wanted))
        plan.spans.push_back({device.key(), span, interval});
}

/// What is watched, by how often; only what touches is joined.
void addWatched(PollPlan &plan, const DeviceWatches &watches)
{
    const Device &device = *watches.device;
    std::map<std::chrono::milliseconds, std::set<int>> byInterval;
    bool isPacked = false;
    for (const int field : watches.fields) {
        const auto rate = watches.rates.find(field);
        const auto interval = rate == watches.rates.end() ? 0ms : intervalOf(rate->second);
        if (interval == 0ms && watches.packing && watches.packing->addressOf(field) >= 0)
            isPacked = true;
        else
            byInterval[interval].insert(field);
    }
    if (isPacked) {
        const IndirectPacking &packing = *watches.packing;
        plan.spans.push_back({device.key(), {device.id(), packing.address, packing.length}, 0ms});
    }
    for (const auto &[interval, fields] : byInterval) {
        const std::size_t begin = plan.spans.size();
        for (const int index : fields) { // by address
            const Field &field = device.table().fields()[static_cast<std::size_t>(index)];
            Span *last = plan.spans.size() > begin ? &plan.spans.back().span : nullptr;
            if (last && field.address <= last->address + last->length)
                last->length =
                    static_cast<std::uint16_t>(std::max(last->address + last->length, field.end()) - last->address);
            else
                plan.spans.push_back({device.key(), {device.id(), field.address, field.size}, interval});
        }
    }
}

} // namespace

std::chrono::milliseconds intervalOf(double hertz)
{
    constexpr double Fastest = 1000; // beyond it, and below it by mistake: as fast as the line allows
    constexpr double Slowest = 0.01;
    if (!(hertz > 0) || hertz >= Fastest)
        return 0ms;
    return std::chrono::milliseconds(std::lround(1000 / std::max(hertz, Slowest)));
}

PollPlan planWatches(const std::vector<DeviceWatches> &devices, int baudRate)
{
    PollPlan plan;
    plan.baudRate = baudRate;
    for (const DeviceWatches &watches : devices) {
        const Device &device = *watches.device;
        if (device.baudRate() != baudRate || device.state() == Device::State::Rebooting) {
            plan.others.push_back(device.traits());
            continue;
        }
        const Field *first = device.table().fields().data();
        addWatched(plan, watches);
        const std::set<int> folded = watches.isSelected ? foldedFields(watches) : std::set<int>();
        if (watches.isSelected) {
            addSpans(plan, device, SelectedInterval, [&](const Field &field) {
                return isLive(field) && !folded.contains(static_cast<int>(&field - first));
            });
        }
        addSpans(plan, device, GlanceInterval, [&](const Field &field) {
            const int index = static_cast<int>(&field - first);
            const bool isRead = watches.isSelected && isLive(field);
            return watches.glance.contains(index) && !isRead && !isAtFullRate(watches, index);
        });
        addSpans(plan, device, StateInterval, [&](const Field &field) {
            const bool isRead = watches.isSelected && isLive(field);
            const int index = static_cast<int>(&field - first);
            return !isRead
                && ((isState(field) && !watches.isSelected) || isUnknownManner(device, field)
                    || (watches.once.contains(index) && !device.value(index).raw));
        });
        if (watches.packing) { // another program may set them anew
            addSpans(plan, device, StateInterval, [&](const Field &field) {
                const int index = static_cast<int>(&field - first);
                const auto isIt = [index](const IndirectPacking::Entry &entry) { return entry.field == index; };
                return std::ranges::any_of(watches.packing->entries, isIt);
            });
        }
        addSpans(plan, device, SignInterval, [&](const Field &field) {
            const int index = static_cast<int>(&field - first);
            const bool isWatched = std::ranges::find(watches.fields, index) != watches.fields.end();
            const bool isOnScreen = watches.isSelected && isLive(field) && !folded.contains(index);
            return watches.signs.contains(index) && !isWatched && !isOnScreen && !isState(field);
        });
        plan.traits.push_back(device.traits());
    }
    return plan;
}

} // namespace dynascope
