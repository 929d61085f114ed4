// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/packedreads.h"

namespace dynascope {

void PackedReads::set(const Device &device, IndirectPacking packing, LineTime since)
{
    m_packed.insert_or_assign(device.key(), Packed{std::move(packing), device.sharedTable(), since});
}

const IndirectPacking *PackedReads::packing(DeviceKey device) const
{
    const auto at = m_packed.find(device);
    return at == m_packed.end() ? nullptr : &at->second.packing;
}

std::vector<DeviceKey> PackedReads::unpack(Batch &batch) const
{
    std::vector<DeviceKey> lost;
    if (m_packed.empty())
        return lost;
    const std::size_t read = batch.values.size();
    for (std::size_t i = 0; i < read; ++i) {
        const auto at = m_packed.find(batch.values[i].device);
        if (at == m_packed.end())
            continue;
        const auto &[packing, table, since] = at->second;
        const PollValue whole = batch.values[i];
        if (whole.address != packing.address || whole.length != packing.length || whole.at < since)
            continue;
        const bool isThrough = !whole.data.empty() && packing.isThrough(whole.data);
        if (!whole.data.empty() && !isThrough)
            lost.push_back(whole.device);
        for (const IndirectPacking::Place &place : packing.places) {
            const Field &field = table->fields()[static_cast<std::size_t>(place.field)];
            PollValue part = whole;
            part.address = field.address;
            part.length = field.size;
            part.data.clear();
            if (isThrough) {
                const auto bytes = ByteView(whole.data).subspan(static_cast<std::size_t>(place.offset), field.size);
                part.data.assign(bytes.begin(), bytes.end());
            }
            batch.values.push_back(std::move(part));
        }
    }
    return lost;
}

} // namespace dynascope
