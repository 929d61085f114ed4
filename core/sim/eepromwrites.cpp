// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/eepromwrites.h"

#include <algorithm>

namespace dynascope::sim {

void EepromWrites::begin(RegisterFile &registers, const std::vector<const Field *> &fields, LineTime from,
                         LineTime duration)
{
    store(registers, from);
    const auto kept = [](const Field *field) { return RegisterFile::isKept(*field); };
    const auto count = std::ranges::count_if(fields, kept);
    // One write at a time: a second one waits for the first.
    const LineTime start = m_pending.empty() ? from : std::max(from, m_pending.back().at);
    LineTime::rep place = 0;
    for (const Field *field : fields) {
        if (!kept(field))
            continue;
        // Each has its share of the time; in the middle of it the new value is there.
        const LineTime at = start + duration * (2 * place + 1) / (2 * count);
        const ByteView value = registers.bytes(*field);
        m_pending.push_back({at, field, Bytes(value.begin(), value.end())});
        ++place;
    }
    store(registers, from);
}

void EepromWrites::cut(RegisterFile &registers, LineTime at)
{
    store(registers, at);
    m_pending.clear();
}

void EepromWrites::store(RegisterFile &registers, LineTime until)
{
    const auto later = std::ranges::find_if(m_pending, [until](const Pending &one) { return one.at > until; });
    for (auto one = m_pending.begin(); one != later; ++one)
        registers.keep(*one->field, one->value);
    m_pending.erase(m_pending.begin(), later);
}

} // namespace dynascope::sim
