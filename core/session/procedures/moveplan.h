// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/procedures/procedures.h"

#include <QByteArray>

#include <optional>
#include <vector>

/// New IDs and baud rates for many devices: which is changed when. Pure.
namespace dynascope {

struct MovePlace {
    int baudRate = 0;
    int id = 0;

    friend auto operator<=>(const MovePlace &, const MovePlace &) = default;
};
QString placeText(const MovePlace &place); ///< "ID 3 at 57600 bps"

/// A device of the line, whether it shall move or not.
struct MoveDevice {
    DevicePlace place; ///< where it is at the beginning
    int firmware = 0;
    int secondaryId = -1; ///< it answers to that, too; −1: to none
    MovePlace goal;       ///< where it shall be; may be where it is
    std::uint16_t idAddress = 7, baudAddress = 8;
    std::vector<std::pair<int, int>> rates; ///< what it offers: bits per second, code

    bool moves() const { return goal != MovePlace{place.baudRate, place.id}; }
};

/// One write: ID or baud rate of one device.
struct MoveStep {
    std::size_t device = 0; ///< in the plan
    MovePlace from, to;
    bool isDetour = false; ///< to a free ID, so that another one can have its place

    bool isBaud() const { return from.baudRate != to.baudRate; }
};

struct MovePlan {
    QString line, adapter; ///< as the journal has them
    bool turnTorqueOff = false;
    std::vector<MoveDevice> devices;
    std::vector<MoveStep> steps;
    std::size_t next = 0; ///< the step that is begun, or is to be

    bool isOver() const { return next >= steps.size(); }
    /// Where each device is before the step `next`, by what was done.
    MovePlace placeOf(std::size_t device) const;
};

/// In which order; swaps and cycles by way of a free ID. InvalidArgument, with the reason, where it can't end well: a
/// place taken, also as a Secondary ID, or wanted twice; a baud rate that a model doesn't offer; no free ID for a
/// detour.
Result<MovePlan> planMoves(std::vector<MoveDevice> devices);

/// @name On disk, so that a killed program's next start knows what was half done
/// @{
QByteArray toJson(const MovePlan &plan);
Result<MovePlan> movePlanFromJson(const QByteArray &json); ///< BadFile; everything in it is bounded
/// @}

} // namespace dynascope
