// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/indirectkept.h"

#include <algorithm>

namespace dynascope {

Result<void> IndirectKept::load(const LineSession &line)
{
    auto left = IndirectFile(m_folder, line.name()).load();
    if (!left)
        return tl::unexpected(left.error());
    for (SetEntries &set : *left)
        m_lines[&line].push_back({std::move(set), 0});
    return {};
}

Result<void> IndirectKept::keep(const Device &device, std::vector<SetEntries::Entry> entries)
{
    auto &here = m_lines[device.line()];
    here.push_back({{device.modelNumber(), device.id(), device.baudRate(), std::move(entries)}, device.key()});
    const Result<void> saved = save(*device.line());
    if (!saved)
        here.pop_back();
    return saved;
}

bool IndirectKept::isOf(const Kept &kept, const Device &device)
{
    return kept.device == device.key()
        || (kept.device == 0 && kept.set.modelNumber == device.modelNumber() && kept.set.id == device.id()
            && kept.set.baudRate == device.baudRate());
}

const SetEntries *IndirectKept::find(const Device &device) const
{
    const auto line = m_lines.find(device.line());
    if (line == m_lines.end())
        return nullptr;
    const auto at = std::ranges::find_if(line->second, [&](const Kept &kept) { return isOf(kept, device); });
    return at == line->second.end() ? nullptr : &at->set;
}

void IndirectKept::drop(const Device &device)
{
    auto &here = m_lines[device.line()];
    const auto at = std::ranges::find_if(here, [&](const Kept &kept) { return isOf(kept, device); });
    if (at != here.end())
        here.erase(at);
    (void)save(*device.line());
}

void IndirectKept::dropAllBut(const LineSession &line, const std::function<bool(DeviceKey)> &stays)
{
    std::erase_if(m_lines[&line], [&](const Kept &kept) { return !stays(kept.device); });
    (void)save(line);
}

Result<void> IndirectKept::save(const LineSession &line)
{
    const auto here = m_lines.find(&line);
    if (here == m_lines.end())
        return {};
    std::vector<SetEntries> all;
    for (Kept &kept : here->second) {
        if (const Device *device = kept.device ? m_session.device(kept.device) : nullptr) {
            kept.set.id = device->id();
            kept.set.baudRate = device->baudRate();
        }
        all.push_back(kept.set);
    }
    return IndirectFile(m_folder, line.name()).save(all);
}

} // namespace dynascope
