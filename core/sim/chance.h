// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

namespace dynascope::sim {

/// Random numbers that are the same everywhere for the same seed (SplitMix64), as the standard's distributions are not.
class Chance
{
public:
    explicit Chance(std::uint64_t seed) : m_state(seed) { }

    std::uint64_t next()
    {
        m_state += 0x9E3779B97F4A7C15ULL;
        std::uint64_t mixed = m_state;
        mixed = (mixed ^ (mixed >> 30)) * 0xBF58476D1CE4E5B9ULL;
        mixed = (mixed ^ (mixed >> 27)) * 0x94D049BB133111EBULL;
        return mixed ^ (mixed >> 31);
    }
    std::uint64_t below(std::uint64_t limit) { return limit ? next() % limit : 0; }
    double fraction() { return static_cast<double>(next() >> 11) * 0x1.0p-53; } ///< 0 <= it < 1
    std::uint8_t byte() { return static_cast<std::uint8_t>(next() >> 56); }

private:
    std::uint64_t m_state;
};

} // namespace dynascope::sim
