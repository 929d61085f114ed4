// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/line.h"
#include "core/protocol/protocol_values.h"
#include "core/sim/jointvalues.h"

namespace dynascope::sim {

struct ServoIdentity {
    int firmware = 0;
    int id = 1;
    int baudRate = 57600;
};

/// What the manual leaves open about a servo, and how long things take. The defaults are what users report.
struct ServoSettings {
    enum class GoalOnTorqueOn { BecomesPresentPosition, Stays };

    LineTime processing = std::chrono::microseconds(100); ///< from the last byte heard, before Return Delay Time
    /// Longer for a write into the EEPROM area; power lost before its end leaves old values.
    LineTime eepromWrite = std::chrono::milliseconds(3);
    LineTime bootTime = std::chrono::milliseconds(400);   ///< deaf after power-on by Reboot or Factory Reset
    LineTime clearTime = std::chrono::milliseconds(1);    ///< longer for Clear
    LineTime fastGap{};                                   ///< between the blocks of a fast reply
    bool answersDamagedRequests = false;                  ///< with CRC Error, when the damaged packet names it
    bool answersReboot = true;
    bool idChangeAnswersWithNewId = false;
    int factoryId = -1; ///< after a Factory Reset of everything; −1: the table's
    DeviceError limitError = DeviceError::DataLimit;      ///< for a goal beyond a limit register
    DeviceError alignmentError = DeviceError::DataLength; ///< for a write that begins inside a register
    GoalOnTorqueOn goalOnTorqueOn = GoalOnTorqueOn::BecomesPresentPosition;
    double brownOut = 0.6; ///< of the factory's Min Voltage Limit: with less the servo is off, and starts anew after
    JointTuning control;
};

} // namespace dynascope::sim
