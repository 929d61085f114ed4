// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/readgroups.h"

#include <algorithm>
#include <map>
#include <tuple>

namespace dynascope {
namespace {

constexpr std::size_t Few = 7;      ///< pieces: every way is tried
constexpr std::size_t AllWays = 4;  ///< so many kinds of spans: each set of them is tried for Sync
/// Groups to merge, pieces to move: with more it takes too long for what it brings.
constexpr std::size_t Polished = 24;

} // namespace

LineTime ReadGrouping::sum(const std::vector<ReadGroup> &groups)
{
    LineTime sum{};
    for (const ReadGroup &group : groups)
        sum += group.cost;
    return sum;
}

bool ReadGrouping::holds(const Pieces &pieces, std::size_t device) const
{
    return std::ranges::any_of(pieces, [&](std::size_t piece) { return m_pieces[piece].device == device; });
}

bool ReadGrouping::isSync(const Pieces &pieces) const
{
    const Span &first = m_pieces[pieces.front()].span;
    return std::ranges::all_of(pieces, [&](std::size_t piece) {
        const Span &span = m_pieces[piece].span;
        return span.address == first.address && span.length == first.length;
    });
}

/// Into the buffers of all of them, and for a fast reply into that of the controller.
bool ReadGrouping::fits(const Pieces &pieces, bool fast, bool sync) const
{
    std::size_t parameters = sync ? 4 : 0;
    std::size_t reply = HeaderSize + 1;
    std::size_t limit = parameterLimit(MaximumPacketSize);
    for (const std::size_t piece : pieces) {
        limit = std::min(limit, deviceOf(piece).parameters);
        parameters += sync ? 1 : 5;
        reply += m_pieces[piece].span.length + std::size_t(FastBlockOverhead);
    }
    return parameters <= limit && (!fast || reply <= MaximumPacketSize);
}

ReadGroup ReadGrouping::make(Pieces pieces, bool fast) const
{
    std::ranges::sort(pieces, {}, [&](std::size_t piece) { return std::pair(m_pieces[piece].device, piece); });
    ReadGroup group{std::move(pieces), ReadKind::Single, {}};
    if (group.pieces.size() > 1) {
        const bool sync = isSync(group.pieces);
        group.kind = sync ? (fast ? ReadKind::FastSync : ReadKind::Sync) : (fast ? ReadKind::FastBulk : ReadKind::Bulk);
    }
    std::vector<AskedDevice> asked;
    asked.reserve(group.pieces.size());
    for (const std::size_t piece : group.pieces)
        asked.push_back({m_pieces[piece].span.length, deviceOf(piece).returnDelay});
    group.cost = costOf(group.kind, asked, m_costs.byteTime, m_costs.delays).total();
    return group;
}

/// As many packets as the buffers ask for.
void ReadGrouping::append(Groups &to, const Pieces &pieces, bool fast) const
{
    if (pieces.empty())
        return;
    const bool sync = isSync(pieces);
    if (fits(pieces, fast, sync)) {
        to.push_back(make(pieces, fast));
        return;
    }
    Pieces part;
    for (const std::size_t piece : pieces) {
        part.push_back(piece);
        if (part.size() > 1 && !fits(part, fast, sync)) {
            part.pop_back();
            to.push_back(make(part, fast));
            part = {piece};
        }
    }
    to.push_back(make(part, fast));
}

/// Pieces of different devices: fast for those who can and the others apart, or all alike.
ReadGrouping::Groups ReadGrouping::split(const Pieces &pieces) const
{
    Pieces fast, plain;
    for (const std::size_t piece : pieces)
        (deviceOf(piece).fast ? fast : plain).push_back(piece);
    Groups apart, together;
    append(apart, fast, true);
    append(apart, plain, false);
    if (fast.empty() || (plain.empty() && fast.size() == 1))
        return apart;
    append(together, pieces, false);
    return sum(together) < sum(apart) ? together : apart;
}

/// Pieces that a Sync Read could ask for together.
std::vector<ReadGrouping::Pieces> ReadGrouping::classes(const Pieces &among) const
{
    using Place = std::tuple<int, int, int>; ///< a device that has it twice: in another class
    std::map<Place, Pieces> byPlace;
    std::vector<Place> order;
    for (const std::size_t piece : among) {
        Place place{m_pieces[piece].span.address, m_pieces[piece].span.length, 0};
        while (byPlace.contains(place) && holds(byPlace[place], m_pieces[piece].device))
            ++std::get<2>(place);
        if (!byPlace.contains(place))
            order.push_back(place);
        byPlace[place].push_back(piece);
    }
    std::vector<Pieces> result;
    for (const Place &place : order)
        result.push_back(byPlace[place]);
    return result;
}

/// Which classes are tried for a Sync Read of their own, as bits.
std::vector<std::uint32_t> ReadGrouping::choices(const std::vector<Pieces> &classes) const
{
    std::vector<std::uint32_t> result;
    const std::size_t count = std::min<std::size_t>(classes.size(), 31);
    const auto limited = [count](std::uint32_t bits) { return bits & ((1U << count) - 1U); };
    if (count <= AllWays) {
        for (std::uint32_t bits = 0; bits < 1U << count; ++bits)
            result.push_back(bits);
        return result;
    }
    result = {0};
    for (const std::size_t least : {2U, 3U, 5U, 9U, 17U}) {
        std::uint32_t bits = 0;
        for (std::size_t i = 0; i < count; ++i)
            bits |= classes[i].size() >= least ? 1U << i : 0U;
        if (limited(bits) != result.back())
            result.push_back(limited(bits));
    }
    return result;
}

/// Those classes by Sync Read, what is left by Bulk Reads in which no device stands twice; `apart`: those who know fast
/// reads and those who don't never in one.
ReadGrouping::Groups ReadGrouping::withSyncs(const std::vector<Pieces> &classes, std::uint32_t synced, bool apart) const
{
    Groups groups;
    Pieces rest;
    for (std::size_t i = 0; i < classes.size(); ++i) {
        if (i < 32 && (synced >> i & 1U) != 0) {
            for (ReadGroup &group : split(classes[i]))
                groups.push_back(std::move(group));
        } else {
            rest.insert(rest.end(), classes[i].begin(), classes[i].end());
        }
    }
    std::ranges::sort(rest);
    const auto bulk = [&](Pieces open) {
        while (!open.empty()) {
            Pieces round, later;
            std::vector<bool> seen(m_devices.size());
            for (const std::size_t piece : open) {
                const std::size_t device = m_pieces[piece].device;
                (seen[device] ? later : round).push_back(piece);
                seen[device] = true;
            }
            for (ReadGroup &group : split(round))
                groups.push_back(std::move(group));
            open = std::move(later);
        }
    };
    if (!apart) {
        bulk(rest);
        return groups;
    }
    Pieces fast, plain;
    for (const std::size_t piece : rest)
        (deviceOf(piece).fast ? fast : plain).push_back(piece);
    bulk(fast);
    bulk(plain);
    return groups;
}

/// Two exchanges as one, where that is cheaper.
bool ReadGrouping::mergeOnce(Groups &groups) const
{
    for (std::size_t a = 0; a < groups.size(); ++a) {
        for (std::size_t b = a + 1; b < groups.size(); ++b) {
            const auto clashes = [&](std::size_t piece) { return holds(groups[a].pieces, m_pieces[piece].device); };
            const auto isLone = [&](const ReadGroup &group) { return !deviceOf(group.pieces.front()).group; };
            if (isLone(groups[a]) || isLone(groups[b]) || std::ranges::any_of(groups[b].pieces, clashes))
                continue;
            Pieces both = groups[a].pieces;
            both.insert(both.end(), groups[b].pieces.begin(), groups[b].pieces.end());
            const bool allFast = std::ranges::all_of(both, [&](std::size_t piece) { return deviceOf(piece).fast; });
            for (const bool fast : {true, false}) {
                if ((fast && !allFast) || !fits(both, fast, isSync(both)))
                    continue;
                ReadGroup merged = make(both, fast);
                if (merged.cost >= groups[a].cost + groups[b].cost)
                    continue;
                groups[a] = std::move(merged);
                groups.erase(groups.begin() + static_cast<std::ptrdiff_t>(b));
                return true;
            }
        }
    }
    return false;
}

/// A piece into another exchange, where that is cheaper.
bool ReadGrouping::moveOnce(Groups &groups) const
{
    for (std::size_t from = 0; from < groups.size(); ++from) {
        for (std::size_t at = 0; at < groups[from].pieces.size(); ++at) {
            const std::size_t piece = groups[from].pieces[at];
            if (groups[from].pieces.size() < 2 || !deviceOf(piece).group)
                break;
            Pieces left = groups[from].pieces;
            left.erase(left.begin() + static_cast<std::ptrdiff_t>(at));
            const ReadGroup rest = make(left, isFast(groups[from].kind));
            for (std::size_t to = 0; to < groups.size(); ++to) {
                if (to == from || holds(groups[to].pieces, m_pieces[piece].device)
                    || !deviceOf(groups[to].pieces.front()).group)
                    continue;
                Pieces more = groups[to].pieces;
                more.push_back(piece);
                const bool fast = std::ranges::all_of(more, [&](std::size_t each) { return deviceOf(each).fast; })
                    && (isFast(groups[to].kind) || groups[to].pieces.size() == 1);
                if (!fits(more, fast, isSync(more)))
                    continue;
                ReadGroup grown = make(more, fast);
                if (rest.cost + grown.cost >= groups[from].cost + groups[to].cost)
                    continue;
                groups[from] = rest;
                groups[to] = std::move(grown);
                return true;
            }
        }
    }
    return false;
}

void ReadGrouping::polish(Groups &groups) const
{
    if (groups.size() > Polished)
        return;
    const bool mayMove = m_pieces.size() <= Polished;
    while (mergeOnce(groups) || (mayMove && moveOnce(groups))) { } // each makes it cheaper: it ends
}

/// In one exchange; nothing where that can't be.
std::optional<ReadGroup> ReadGrouping::cheapest(const Pieces &pieces) const
{
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        for (std::size_t other = 0; other < i; ++other) {
            if (m_pieces[pieces[i]].device == m_pieces[pieces[other]].device)
                return std::nullopt;
        }
    }
    const bool single = pieces.size() == 1;
    const bool sync = isSync(pieces);
    std::optional<ReadGroup> best;
    for (const bool fast : {false, true}) {
        const bool can = !fast || std::ranges::all_of(pieces, [&](std::size_t piece) { return deviceOf(piece).fast; });
        if ((single && fast) || !can || !(single || fits(pieces, fast, sync)))
            continue;
        ReadGroup group = make(pieces, fast);
        if (!best || group.cost < best->cost)
            best = std::move(group);
    }
    return best;
}

/// Every way to share them among exchanges.
ReadGrouping::Groups ReadGrouping::bestOfFew(const Pieces &open) const
{
    const std::size_t sets = std::size_t(1) << open.size();
    std::vector<std::optional<ReadGroup>> group(sets);
    std::vector<LineTime> cost(sets, LineTime::max());
    std::vector<std::size_t> first(sets); // of the cheapest way: its exchange with the lowest piece
    cost[0] = {};
    for (std::size_t set = 1; set < sets; ++set) {
        Pieces pieces;
        for (std::size_t i = 0; i < open.size(); ++i) {
            if ((set >> i & 1U) != 0)
                pieces.push_back(open[i]);
        }
        group[set] = cheapest(pieces);
        const std::size_t lowest = set & (~set + 1);
        for (std::size_t part = set; part > 0; part = (part - 1) & set) {
            if ((part & lowest) == 0 || !group[part] || group[part]->cost + cost[set ^ part] >= cost[set])
                continue;
            cost[set] = group[part]->cost + cost[set ^ part];
            first[set] = part;
        }
    }
    Groups best;
    for (std::size_t set = sets - 1; set > 0; set ^= first[set])
        best.push_back(*group[first[set]]);
    return best;
}

/// Some ways that are good, made better by small steps.
ReadGrouping::Groups ReadGrouping::bestOfMany(const Pieces &open) const
{
    std::vector<Pieces> syncs = classes(open);
    std::ranges::stable_sort(syncs, std::greater(), &Pieces::size); // the largest have the bits
    Groups best;
    bool any = false;
    for (const std::uint32_t synced : choices(syncs)) {
        for (const bool apart : {false, true}) {
            Groups groups = withSyncs(syncs, synced, apart);
            polish(groups);
            if (!any || sum(groups) < sum(best))
                best = std::move(groups);
            any = true;
        }
    }
    return best;
}

std::vector<ReadGroup> ReadGrouping::best()
{
    Groups lone;
    Pieces open;
    for (std::size_t piece = 0; piece < m_pieces.size(); ++piece) {
        if (deviceOf(piece).group)
            open.push_back(piece);
        else
            lone.push_back(make({piece}, false));
    }
    Groups best = open.size() <= Few ? bestOfFew(open) : bestOfMany(open);
    std::ranges::stable_sort(best, {}, [](const ReadGroup &group) {
        return std::tuple(group.pieces.size() == 1, !isFast(group.kind), group.pieces.front());
    });
    lone.insert(lone.end(), best.begin(), best.end());
    return lone;
}

} // namespace dynascope
