// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/devicekeys.h"

namespace dynascope {

DeviceKey DeviceKeys::take(const QString &line, const Found &found)
{
    const auto former = m_former.find({line, found.baudRate, found.id, found.modelNumber, found.firmware});
    if (former == m_former.end())
        return m_next++;
    const DeviceKey key = former->second;
    m_former.erase(former);
    return key;
}

void DeviceKeys::release(const QString &line, const Device &device)
{
    m_former[{line, device.baudRate(), device.id(), device.modelNumber(), device.firmware()}] = device.key();
}

} // namespace dynascope
