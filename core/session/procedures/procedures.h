// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/busthread.h"
#include "core/bus/operations.h"
#include "core/bus/scan.h"

/// Several instructions with a meaning: functions of a JobContext and a plan, both values, that run on the bus thread.
/// They know registers by address only; who makes the plan knows the table.
namespace dynascope {

struct Field;

/// Where a device is, and how its torque is turned off.
struct DevicePlace {
    std::uint8_t id = 0;
    int baudRate = 57600;
    std::uint16_t modelNumber = 0;
    std::uint16_t torqueAddress = 64;
    QString name; ///< for messages: "XM430-W350 #3"
};

/// Reads these spans one after the other, with a checkpoint between them. A span the device refuses is left out.
struct ReadSpansPlan {
    DevicePlace place;
    std::vector<Span> spans;
};
Result<std::vector<PollValue>> readSpans(JobContext &context, const ReadSpansPlan &plan);

/// Writes one register, reads it back, then reads what the write may have changed besides.
struct WriteFieldPlan {
    DevicePlace place;
    SpanData data;
    std::vector<Span> sideEffects;
    bool leavesOnlyPing = false; ///< the value tells the device to answer nothing else: no Read will show it
    std::vector<Span> before = {}; ///< read first; what can't be read keeps nothing from being written
    Bytes becomes = {};          ///< what the device itself makes of it once it is done; empty: it stays
};
/// Manual: "Hybrid Save". It is a request and its answer in one register; nothing for every other one.
Bytes becomesLater(const Field &field, std::int64_t raw);
struct WrittenField {
    std::vector<PollValue> before;
    Result<std::vector<PollValue>> after; ///< the register itself, then the side effects; the write's failure
};
Result<WrittenField> writeField(JobContext &context, const WriteFieldPlan &plan);

/// Did the device refuse the value for a limit? Another register may have to change first.
bool isBeyondLimit(const Error &error);

/// Manual: "ID". Refused where `newId` answers already or torque is on and may not be turned off. Writes once, then
/// looks for the device at the new ID and, failing that, at the old one. STOP may come at any point: then the error is
/// Stopped, and only lookForMoved() can tell where the device is.
struct ChangeIdPlan {
    DevicePlace place;
    std::uint8_t newId = 0;
    std::uint16_t idAddress = 7;
    bool turnTorqueOff = false;
};
Result<Found> changeId(JobContext &context, const ChangeIdPlan &plan);

/// Manual: "Baud Rate". As changeId(), and tries on the port whether it can do the rate before anything is written.
struct ChangeBaudPlan {
    DevicePlace place;
    int newBaudRate = 57600;
    std::uint8_t code = 1;
    std::uint16_t baudAddress = 8;
    bool turnTorqueOff = false;
};
Result<Found> changeBaud(JobContext &context, const ChangeBaudPlan &plan);

/// Sends Factory Reset where the place it will end at is free. Where to look for the device afterwards is `after`.
struct FactoryResetPlan {
    DevicePlace place;
    ResetOption option = ResetOption::AllButIdAndBaud;
    DevicePlace after;
};
Result<void> resetToFactory(JobContext &context, const FactoryResetPlan &plan);

/// Turns torque on or off and reads it back, for devices of one baud rate. One entry per device. What torque on changes
/// besides is read before and after; torque off waits for nothing.
struct TorqueEntry {
    std::uint8_t id = 0;
    std::uint16_t address = 64;
    std::vector<Span> affected = {};
};
Result<std::vector<WrittenField>> setTorque(JobContext &context, int baudRate, const std::vector<TorqueEntry> &entries,
                                            bool on);

/// Is it there? At its own baud rate, wherever the line works.
Result<Found> look(JobContext &context, const DevicePlace &place);
/// A device of this model at the new place or else at the old one, which may be the same; NotConfirmed where it is at
/// neither.
Result<Found> lookForMoved(JobContext &context, const DevicePlace &from, const DevicePlace &to);
bool isAt(const Found &found, const DevicePlace &place);

/// Runs `operation` at the device's baud rate.
Result<void> atPlace(JobContext &context, const DevicePlace &place, const std::function<Result<void>(Bus &)> &operation);

} // namespace dynascope
