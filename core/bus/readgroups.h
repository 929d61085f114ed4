// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/readchoice.h"

#include <optional>

namespace dynascope {

/// One device's stretch to be read in one reply.
struct ReadPiece {
    Span span;
    std::size_t device = 0;         ///< by number, in the order in which they are asked
    std::vector<std::size_t> spans; ///< those that it answers
};

/// Of one device, what grouping asks for.
struct ReadDevice {
    LineTime returnDelay{};
    std::size_t parameters = 0; ///< that its buffer takes
    bool fast = false, group = true;
};

/// Pieces by number that one exchange reads.
struct ReadGroup {
    std::vector<std::size_t> pieces;
    ReadKind kind = ReadKind::Single;
    LineTime cost{};
};

/// Which pieces are read together: by Sync, Bulk or alone, fast or not. Pure.
class ReadGrouping
{
public:
    ReadGrouping(std::span<const ReadPiece> pieces, std::span<const ReadDevice> devices, const ReadCosts &costs)
        : m_pieces(pieces), m_devices(devices), m_costs(costs)
    {
    }
    std::vector<ReadGroup> best();
    static LineTime sum(const std::vector<ReadGroup> &groups);

private:
    using Pieces = std::vector<std::size_t>;
    using Groups = std::vector<ReadGroup>;

    const ReadDevice &deviceOf(std::size_t piece) const { return m_devices[m_pieces[piece].device]; }
    ReadGroup make(Pieces pieces, bool fast) const;
    void append(Groups &to, const Pieces &pieces, bool fast) const;
    Groups split(const Pieces &pieces) const;
    std::vector<Pieces> classes(const Pieces &among) const;
    Groups withSyncs(const std::vector<Pieces> &classes, std::uint32_t synced, bool apart) const;
    std::vector<std::uint32_t> choices(const std::vector<Pieces> &classes) const;
    Groups bestOfFew(const Pieces &open) const;
    Groups bestOfMany(const Pieces &open) const;
    std::optional<ReadGroup> cheapest(const Pieces &pieces) const;
    void polish(Groups &groups) const;
    bool mergeOnce(Groups &groups) const;
    bool moveOnce(Groups &groups) const;
    bool holds(const Pieces &pieces, std::size_t device) const;
    bool fits(const Pieces &pieces, bool fast, bool sync) const;
    bool isSync(const Pieces &pieces) const;

    std::span<const ReadPiece> m_pieces;
    std::span<const ReadDevice> m_devices;
    const ReadCosts &m_costs;
};

} // namespace dynascope
