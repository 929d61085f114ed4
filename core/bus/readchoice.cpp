// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/readchoice.h"

#include "core/bus/readgroups.h"

#include <algorithm>
#include <map>

namespace dynascope {
namespace {

constexpr std::size_t EachGap = 3; ///< so many gaps: each set of them is tried
constexpr std::size_t FewGaps = 6;
constexpr int Rounds = 3;

/// Spans of one device that overlap: read together, whatever it costs.
struct Run {
    Span span;
    std::vector<std::size_t> spans;

    int end() const { return span.address + span.length; }
};

/// Devices of which the same is read, and that can do the same.
struct Family {
    std::vector<std::size_t> devices;
    std::vector<int> gaps;   ///< behind each run but the last
    std::vector<bool> joined; ///< which of them are read through
};

class ReadChooser
{
public:
    ReadChooser(std::span<const Span> spans, std::span<const Traits> traits, const ReadCosts &costs) : m_costs(costs)
    {
        std::map<std::uint8_t, std::size_t> numbers;
        for (std::size_t i = 0; i < spans.size(); ++i) {
            const auto [at, isNew] = numbers.try_emplace(spans[i].id, m_devices.size());
            if (isNew)
                addDevice(spans[i].id, traits);
            m_runs[at->second].push_back({spans[i], {i}});
        }
        for (std::size_t device = 0; device < m_runs.size(); ++device) {
            if (mayJoin(device))
                joinOverlaps(m_runs[device]);
        }
        findFamilies();
    }

    std::vector<ChosenRead> choose()
    {
        if (m_costs.mayJoin && !chooseAmongAll())
            chooseGaps();
        const std::vector<ReadPiece> pieces = makePieces();
        std::vector<ChosenRead> reads;
        for (const ReadGroup &group : ReadGrouping(pieces, m_devices, m_costs).best()) {
            ChosenRead read;
            read.kind = group.kind;
            for (const std::size_t number : group.pieces) {
                const ReadPiece &piece = pieces[number];
                for (const std::size_t span : piece.spans) {
                    read.spans.push_back(span);
                    read.replies.push_back(read.asked.size());
                }
                read.asked.push_back(piece.span);
            }
            reads.push_back(std::move(read));
        }
        return reads;
    }

private:
    bool mayJoin(std::size_t device) const
    {
        return m_costs.mayJoin && !m_costs.unjoined.test(m_runs[device].front().span.id);
    }

    void addDevice(std::uint8_t id, std::span<const Traits> traits)
    {
        const auto known = std::ranges::find(traits, id, &Traits::id);
        Traits device;
        if (known != traits.end())
            device = *known;
        // Who answers nothing but Ping, or no group read, would break every chain: it stays alone.
        const bool group = device.groupReads && device.statusReturnLevel >= 1;
        m_devices.push_back(
            {device.returnDelay, parameterLimit(device.receiveBuffer), group && device.fastReads, group});
        m_runs.emplace_back();
    }

    static void joinOverlaps(std::vector<Run> &runs)
    {
        std::ranges::stable_sort(runs, {}, [](const Run &run) { return run.span.address; });
        std::vector<Run> joined;
        for (Run &run : runs) {
            const int end = joined.empty() ? 0 : std::max(joined.back().end(), run.end());
            if (joined.empty() || run.span.address >= joined.back().end()
                || end - joined.back().span.address > LongestJoined) {
                joined.push_back(std::move(run));
                continue;
            }
            Run &last = joined.back();
            last.span.length = static_cast<std::uint16_t>(end - last.span.address);
            last.spans.insert(last.spans.end(), run.spans.begin(), run.spans.end());
        }
        runs = std::move(joined);
    }

    void findFamilies()
    {
        std::map<std::vector<int>, std::size_t> known;
        for (std::size_t device = 0; device < m_devices.size(); ++device) {
            std::vector<int> key{m_devices[device].fast, m_devices[device].group, mayJoin(device)};
            std::vector<int> gaps;
            for (std::size_t i = 0; i < m_runs[device].size(); ++i) {
                const Run &run = m_runs[device][i];
                key.push_back(run.span.address);
                key.push_back(run.span.length);
                if (i > 0 && mayJoin(device))
                    gaps.push_back(run.span.address - m_runs[device][i - 1].end());
            }
            const auto [at, isNew] = known.try_emplace(key, m_families.size());
            if (isNew)
                m_families.push_back({{}, gaps, std::vector<bool>(gaps.size())});
            m_families[at->second].devices.push_back(device);
        }
    }

    /// Few gaps in all: every set of them, of each device by itself.
    bool chooseAmongAll()
    {
        std::vector<std::pair<std::size_t, std::size_t>> gaps; // family, and which of its gaps
        std::vector<Family> each;
        for (const Family &family : m_families) {
            for (const std::size_t device : family.devices)
                each.push_back({{device}, family.gaps, std::vector<bool>(family.gaps.size())});
        }
        for (std::size_t family = 0; family < each.size(); ++family) {
            for (std::size_t gap = 0; gap < each[family].gaps.size(); ++gap)
                gaps.emplace_back(family, gap);
        }
        if (gaps.size() > FewGaps)
            return false;
        m_families = std::move(each);
        std::vector<Family> best;
        LineTime least = LineTime::max();
        for (std::uint32_t bits = 0; bits < 1U << gaps.size(); ++bits) {
            for (std::size_t i = 0; i < gaps.size(); ++i)
                m_families[gaps[i].first].joined[gaps[i].second] = (bits >> i & 1U) != 0;
            if (const LineTime cost = costNow(); cost < least) {
                least = cost;
                best = m_families;
            }
        }
        m_families = std::move(best);
        return true;
    }

    /// By family, the others as they are, until nothing gets cheaper; from nothing joined, and from everything.
    void chooseGaps()
    {
        std::vector<Family> best;
        LineTime least = LineTime::max();
        for (const bool joined : {false, true}) {
            for (Family &family : m_families)
                family.joined.assign(family.gaps.size(), joined);
            LineTime cost = costNow();
            for (int round = 0; round < Rounds; ++round) {
                const LineTime before = cost;
                for (Family &family : m_families)
                    improve(family, cost);
                if (cost >= before)
                    break;
            }
            if (cost < least) {
                least = cost;
                best = m_families;
            }
        }
        m_families = std::move(best);
    }

    void improve(Family &family, LineTime &cost)
    {
        std::vector<bool> best = family.joined;
        for (std::vector<bool> &option : optionsOf(family)) {
            if (option == best)
                continue;
            family.joined = std::move(option);
            const LineTime now = costNow();
            if (now < cost) {
                cost = now;
                best = family.joined;
            }
        }
        family.joined = std::move(best);
    }

    static std::vector<std::vector<bool>> optionsOf(const Family &family)
    {
        const std::size_t count = family.gaps.size();
        std::vector<std::vector<bool>> options;
        if (count <= EachGap) {
            for (std::uint32_t bits = 0; bits < 1U << count; ++bits) {
                options.emplace_back(count);
                for (std::size_t i = 0; i < count; ++i)
                    options.back()[i] = (bits >> i & 1U) != 0;
            }
            return options;
        }
        std::vector<int> widths = family.gaps; // those up to some width
        std::ranges::sort(widths);
        widths.erase(std::unique(widths.begin(), widths.end()), widths.end());
        for (const int width : widths) {
            options.emplace_back(count);
            for (std::size_t i = 0; i < count; ++i)
                options.back()[i] = family.gaps[i] <= width;
        }
        return options;
    }

    LineTime costNow() const
    {
        const std::vector<ReadPiece> pieces = makePieces();
        return ReadGrouping::sum(ReadGrouping(pieces, m_devices, m_costs).best());
    }

    /// By device, then address.
    std::vector<ReadPiece> makePieces() const
    {
        std::vector<const Family *> familyOf(m_devices.size());
        for (const Family &family : m_families) {
            for (const std::size_t device : family.devices)
                familyOf[device] = &family;
        }
        std::vector<ReadPiece> pieces;
        for (std::size_t device = 0; device < m_devices.size(); ++device) {
            const std::vector<Run> &runs = m_runs[device];
            for (std::size_t i = 0; i < runs.size(); ++i) {
                const bool joins = i > 0 && mayJoin(device) && familyOf[device]->joined[i - 1]
                    && runs[i].end() - pieces.back().span.address <= LongestJoined;
                if (!joins) {
                    pieces.push_back({runs[i].span, device, runs[i].spans});
                    continue;
                }
                ReadPiece &last = pieces.back();
                last.span.length = static_cast<std::uint16_t>(runs[i].end() - last.span.address);
                last.spans.insert(last.spans.end(), runs[i].spans.begin(), runs[i].spans.end());
            }
        }
        return pieces;
    }

    const ReadCosts &m_costs;
    std::vector<ReadDevice> m_devices;    ///< in the order in which they stand in the spans
    std::vector<std::vector<Run>> m_runs; ///< of each
    std::vector<Family> m_families;
};

} // namespace

std::size_t parameterLimit(int receiveBuffer)
{
    const int room = std::min(receiveBuffer, MaximumPacketSize) - InstructionOverhead;
    return static_cast<std::size_t>(std::max(16, room * 3 / 4 - 1));
}

Request ChosenRead::request() const
{
    if (kind == ReadKind::Single)
        return readRequest(asked.front());
    if (kind == ReadKind::Bulk || kind == ReadKind::FastBulk)
        return bulkReadRequest(asked, isFast(kind));
    std::vector<std::uint8_t> ids;
    for (const Span &span : asked)
        ids.push_back(span.id);
    return syncReadRequest(asked.front().address, asked.front().length, ids, isFast(kind));
}

std::vector<ChosenRead> chooseReads(std::span<const Span> spans, std::span<const Traits> traits, const ReadCosts &costs)
{
    return ReadChooser(spans, traits, costs).choose();
}

ExchangeCost costOf(std::span<const ChosenRead> reads, std::span<const Traits> traits, const ReadCosts &costs)
{
    ExchangeCost sum;
    for (const ChosenRead &read : reads) {
        std::vector<AskedDevice> asked;
        for (const Span &span : read.asked)
            asked.push_back({span.length, returnDelayOf(span.id, traits)});
        sum += costOf(read.kind, asked, costs.byteTime, costs.delays);
    }
    return sum;
}

} // namespace dynascope
