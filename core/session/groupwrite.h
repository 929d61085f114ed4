// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/operations.h"
#include "core/table/controltable.h"

/// One register of several devices, of different models and firmware, written at once. Pure.
namespace dynascope {

struct GroupMember {
    std::uint8_t id = 0;
    const ControlTable *table = nullptr; ///< of its model and firmware; nullptr: nobody knows its registers
    QString name;                        ///< for messages: "XL330-M288 #3"
};

/// What is written where on each: a register of one name may lie elsewhere and be longer on another model or firmware.
/// In the order of `members`, for writeMany(), which takes Sync Writes for equal addresses and Bulk Writes for the rest.
/// InvalidArgument names the first that has no such register, can't have it written, or can't hold the value.
Result<std::vector<SpanData>> planGroupWrite(const std::vector<GroupMember> &members, QStringView registerName,
                                             std::int64_t raw);

/// Are the same registers at this address on all of them whose registers are known? InvalidArgument says what is there
/// on two that differ.
Result<void> checkSameMeaning(const std::vector<GroupMember> &members, int address, int length);

} // namespace dynascope
