// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/device.h"
#include "core/session/indirectpacking.h"

#include <map>

namespace dynascope {

/// What is read by indirect addresses on one line, and what readings of it mean. A value.
class PackedReads
{
public:
    void set(const Device &device, IndirectPacking packing, LineTime since);
    bool end(DeviceKey device) { return m_packed.erase(device) > 0; }
    void clear() { m_packed.clear(); }
    const IndirectPacking *packing(DeviceKey device) const; ///< nullptr: nothing is packed

    /// Adds to the batch the registers of the stretches that it holds, as if each had been read by itself; what failed,
    /// or did not come by way of the entries, as failed. Of a reading that began before `since` nothing is added. Says
    /// whose entries don't lead where they did.
    std::vector<DeviceKey> unpack(Batch &batch) const;

private:
    struct Packed {
        IndirectPacking packing;
        ControlTablePtr table;
        LineTime since{}; ///< when the entries were seen to lead there
    };
    std::map<DeviceKey, Packed> m_packed;
};

} // namespace dynascope
