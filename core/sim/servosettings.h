// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/line.h"
#include "core/protocol/protocol_values.h"

namespace dynascope::sim {

/// What the manual leaves open about a servo, and how long things take. The defaults are what users report.
struct ServoSettings {
    enum class GoalOnTorqueOn { BecomesPresentPosition, Stays };

    LineTime processing = std::chrono::microseconds(100); ///< from the last byte heard, before Return Delay Time
    LineTime eepromWrite = std::chrono::milliseconds(3);  ///< longer for a write into the EEPROM area
    LineTime bootTime = std::chrono::milliseconds(400);   ///< deaf after power-on by Reboot or Factory Reset
    LineTime clearTime = std::chrono::milliseconds(1);    ///< longer for Clear
    LineTime fastGap{};                                   ///< between the blocks of a fast reply
    bool answersDamagedRequests = false;                  ///< with CRC Error, when the damaged packet names it
    bool answersReboot = true;
    bool idChangeAnswersWithNewId = false;
    DeviceError limitError = DeviceError::DataLimit;      ///< for a goal beyond a limit register
    GoalOnTorqueOn goalOnTorqueOn = GoalOnTorqueOn::BecomesPresentPosition;
};

} // namespace dynascope::sim
