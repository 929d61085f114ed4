// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <cstdint>

namespace dynascope {

constexpr int AnyRate = 0;

/// What the bus must know of a device to speak with it. A value, made by the session from the device's table and
/// registers; the bus includes no table.
struct Traits {
    std::uint8_t id = 0;
    int baudRate = 0;                           ///< bits per second; what follows holds only there. AnyRate: always
    std::chrono::microseconds returnDelay{508}; ///< 508 µs until Return Delay Time has been read
    bool returnDelayKnown = false;              ///< it has been read
    std::uint8_t statusReturnLevel = 2;         ///< 0 Ping only, 1 Ping and Read, 2 all
    int firmware = -1;                          ///< what was learned of a device holds for this; −1: not known
    bool fastReads = false;                     ///< Fast Sync Read and Fast Bulk Read, by model and firmware
    bool groupReads = true;                     ///< Sync Read and Bulk Read
    int receiveBuffer = 1024;                   ///< bytes

    friend bool operator==(const Traits &, const Traits &) = default;
};

} // namespace dynascope
