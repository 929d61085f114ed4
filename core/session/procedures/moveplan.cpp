// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/procedures/moveplan.h"
#include "core/session/texts.h"

#include <algorithm>
#include <set>

namespace dynascope {
namespace {

bool offers(const MoveDevice &device, int rate)
{
    return std::ranges::any_of(device.rates, [rate](const auto &each) { return each.first == rate; });
}

/// Where everybody is while the plan is made.
class Board
{
public:
    explicit Board(const std::vector<MoveDevice> &devices) : m_devices(devices)
    {
        for (const MoveDevice &device : devices)
            m_places.push_back({device.place.baudRate, device.place.id});
    }

    const MovePlace &place(std::size_t device) const { return m_places[device]; }
    bool isHome(std::size_t device) const { return m_places[device] == m_devices[device].goal; }
    bool areAllHome() const
    {
        for (std::size_t i = 0; i < m_places.size(); ++i) {
            if (!isHome(i))
                return false;
        }
        return true;
    }

    /// Does nobody but `device` answer there, by either of its IDs? And would its Secondary ID be in nobody's way?
    bool isFree(const MovePlace &place, std::size_t device) const
    {
        for (std::size_t i = 0; i < m_places.size(); ++i) {
            if (i == device || m_places[i].baudRate != place.baudRate)
                continue;
            if (m_places[i].id == place.id || m_devices[i].secondaryId == place.id
                || m_devices[device].secondaryId == m_places[i].id)
                return false;
        }
        return true;
    }

    void move(std::size_t device, const MovePlace &to) { m_places[device] = to; }

    /// The way in one write, nearest to the goal first.
    std::optional<MovePlace> step(std::size_t device) const
    {
        const MovePlace here = m_places[device], goal = m_devices[device].goal;
        for (const MovePlace &to : {MovePlace{here.baudRate, goal.id}, MovePlace{goal.baudRate, here.id}}) {
            if (to != here && isFree(to, device))
                return to;
        }
        return std::nullopt;
    }

    /// From the top, where few are.
    std::optional<MovePlace> detour(std::size_t device) const
    {
        for (int id = MaximumId; id >= 0; --id) {
            const MovePlace to{m_places[device].baudRate, id};
            const bool isWanted =
                std::ranges::any_of(m_devices, [id](const MoveDevice &each) { return each.goal.id == id; });
            if (!isWanted && id != m_places[device].id && isFree(to, device))
                return to;
        }
        return std::nullopt;
    }

private:
    const std::vector<MoveDevice> &m_devices;
    std::vector<MovePlace> m_places;
};

Result<void> checkGoals(const std::vector<MoveDevice> &devices)
{
    std::set<MovePlace> starts;
    for (const MoveDevice &device : devices) {
        const QString &name = device.place.name;
        if (!starts.insert({device.place.baudRate, device.place.id}).second)
            return failure(ErrorKind::InvalidArgument,
                           ProcedureText::tr("Two devices have %1: give one of them another ID alone first")
                               .arg(placeText(MovePlace{device.place.baudRate, device.place.id})));
        if (device.goal.id < 0 || device.goal.id > MaximumId)
            return failure(
                ErrorKind::InvalidArgument,
                ProcedureText::tr("%1: an ID is 0 to %2, not %3").arg(name).arg(MaximumId).arg(device.goal.id));
        if (device.goal.baudRate != device.place.baudRate && !offers(device, device.goal.baudRate))
            return failure(ErrorKind::InvalidArgument,
                           ProcedureText::tr("%1 does not offer %2 bps").arg(name).arg(device.goal.baudRate));
    }
    for (const MoveDevice &one : devices) {
        for (const MoveDevice &other : devices) {
            if (&one == &other || one.goal.baudRate != other.goal.baudRate || (!one.moves() && !other.moves()))
                continue;
            if (one.goal.id == other.goal.id)
                return failure(ErrorKind::InvalidArgument,
                               ProcedureText::tr("%1 and %2 would both have %3")
                                   .arg(one.place.name, other.place.name, placeText(one.goal)));
            if (one.goal.id == other.secondaryId)
                return failure(ErrorKind::InvalidArgument,
                               ProcedureText::tr("%1 would have %2, which is the Secondary ID of %3")
                                   .arg(one.place.name, placeText(one.goal), other.place.name));
        }
    }
    return {};
}

} // namespace

QString placeText(const MovePlace &place)
{
    return ProcedureText::tr("ID %1 at %2 bps").arg(place.id).arg(place.baudRate);
}

MovePlace MovePlan::placeOf(std::size_t device) const
{
    MovePlace place{devices[device].place.baudRate, devices[device].place.id};
    for (std::size_t i = 0; i < std::min(next, steps.size()); ++i) {
        if (steps[i].device == device)
            place = steps[i].to;
    }
    return place;
}

Result<MovePlan> planMoves(std::vector<MoveDevice> devices)
{
    if (const auto fine = checkGoals(devices); !fine)
        return tl::unexpected(fine.error());
    MovePlan plan;
    plan.devices = std::move(devices);
    Board board(plan.devices);
    const auto go = [&](std::size_t device, const MovePlace &to, bool isDetour) {
        plan.steps.push_back({device, board.place(device), to, isDetour});
        board.move(device, to);
    };
    while (!board.areAllHome()) {
        bool moved = false;
        for (std::size_t i = 0; i < plan.devices.size(); ++i) {
            while (!board.isHome(i)) {
                const auto to = board.step(i);
                if (!to)
                    break;
                go(i, *to, false);
                moved = true;
            }
        }
        if (moved || board.areAllHome())
            continue;
        // A ring: one of it steps aside, each once at most.
        std::size_t aside = 0;
        const auto hasStepped = [&](std::size_t device) {
            return std::ranges::any_of(
                plan.steps, [device](const MoveStep &step) { return step.isDetour && step.device == device; });
        };
        while (aside < plan.devices.size() && (board.isHome(aside) || hasStepped(aside)))
            ++aside;
        const auto to = aside < plan.devices.size() ? board.detour(aside) : std::nullopt;
        if (!to)
            return failure(ErrorKind::InvalidArgument,
                           ProcedureText::tr("There is no way to these places: no ID is free to step aside to"));
        go(aside, *to, true);
    }
    return plan;
}

} // namespace dynascope
