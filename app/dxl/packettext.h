// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/protocol/requests.h"

#include <QString>

#include <optional>

namespace dynascope::dxl {

/// "FF FF FD 00 01".
QString hexText(ByteView bytes);

/// Says what packets mean, one after the other as they go over the wire: an answer is read by the request before it.
class PacketText
{
public:
    /// "Read, ID 1: 4 bytes at 132", "Status, ID 1: no error, 132: 00 08 00 00"; what is no packet is called so.
    QString describe(ByteView packet);

private:
    QString request(const InstructionPacket &packet);
    QString status(const StatusPacket &packet) const;
    QString fastStatus(ByteView parameters) const;
    QString data(std::uint8_t id, ByteView bytes) const;

    std::optional<dynascope::Command> m_asked; ///< by the last instruction packet
};

/// The blocks of an answer to a fast read that asked for these spans; fewer where it is shorter.
std::vector<FastBlock> fastBlocks(ByteView parameters, std::span<const Span> spans);

/// "no error", "Access Error (7), alert".
QString errorText(DeviceError error, bool alert);

} // namespace dynascope::dxl
