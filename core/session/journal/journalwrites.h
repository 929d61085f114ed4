// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/operations.h"
#include "core/bus/poll_values.h"
#include "core/session/journal/journalentry.h"
#include "core/table/controltable.h"

#include <functional>
#include <span>

/// From writes to entries of the journal. Pure.
namespace dynascope {

class Device;
struct Found;

/// Who this is, for the journal. `line` as the person named it.
JournalDevice journalDevice(const Found &found, const QString &model, const QString &line);
JournalDevice journalDevice(const Device &device);

/// The registers besides itself that a write to `field` may change: what the table says it resets, and what servos do
/// besides that (manual: "Torque Enable", "Operating Mode", "Drive Mode", "Homing Offset"). `torqueByGoal`: a goal may
/// turn torque on now, or nobody knows whether it may.
std::vector<const Field *> affectedBy(const ControlTable &table, const Field &field, bool torqueByGoal);

constexpr int TorqueOnByGoalBit = 3; ///< of Drive Mode, where a model and firmware has it

bool isGoalName(QStringView name); ///< a register that says what the motor is to follow
bool isGoal(const Field &field);
/// Writes through to whatever its Indirect Address names.
bool isIndirectData(const Field &field);

/// The stretches of the table to read so that every wanted field is covered, gaps of a few bytes read through, none
/// longer than `longest` bytes.
std::vector<Span> spansOf(const ControlTable &table, std::uint8_t id, const std::function<bool(const Field &)> &wanted,
                          int longest = 128);
/// Is it one of these? For spansOf().
std::function<bool(const Field &)> among(std::vector<const Field *> fields);

/// The field as an entry's change, nothing read yet.
RegisterChange changeOf(const Field &field, Bytes after);
RegisterChange changeOf(const Field &field, std::int64_t after);
/// Behind the entry's own change, what the table says that a write to `field` resets, with the values of before: should
/// nobody live to note what became of it, these are known. Not the goals, which nobody would want back unasked.
void addResets(JournalEntry &entry, const ControlTable &table, const Field &field,
               const std::function<Bytes(const Field &)> &before);
/// The bytes at `address` in what was read; empty where it isn't in there.
Bytes bytesIn(std::span<const PollValue> values, int address, std::size_t length);
/// Completes `entry.changes` of what was read before and after a write: the first change's old and read-back value, and
/// each of `affected` that changed. Of those only name, address, sign and length matter.
void takeReadings(JournalEntry &entry, const std::vector<RegisterChange> &affected, std::span<const PollValue> before,
                  std::span<const PollValue> after);
/// What a write that ended with this error has come to.
JournalState stateAfter(const Error &error);

} // namespace dynascope
