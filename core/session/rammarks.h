// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/poll_values.h"
#include "core/session/journal/journalentry.h"
#include "core/session/restartsigns.h"

#include <map>

namespace dynascope {

/// A setting that a loss of power takes: RAM that a person writes, HYBRID that isn't stored yet. Not what moves or lights
/// something now: goals and what is added to them, Torque Enable, LEDs, output pins, Indirect Data, which may be any of
/// those.
bool isLostAtPowerOff(const ControlTable &table, const Field &field);

/// What a register is to its device's power.
enum class RamState {
    NotSet,
    Set,  ///< in this session; gone at power-off
    Lost, ///< it was, and the device has restarted since
};

/// A register that was set in this session.
struct RamMark {
    std::int64_t set = 0;               ///< raw
    std::optional<std::int64_t> before; ///< what it held then; writing that again takes the mark off
    qint64 number = 0;                  ///< of the journal's entry: in this order they were set
    bool isLost = false;                ///< it restarted since
};

/// What was set in this session in one device and goes with its power: by index of its table's fields. Follows the
/// journal, whoever wrote. A value.
class RamMarks
{
public:
    /// An entry of this session's that has ended, about this device. True where a mark came or went.
    bool take(const ControlTable &table, const JournalEntry &entry);

    const std::map<int, RamMark> &all() const { return m_marks; }
    bool isEmpty() const { return m_marks.empty(); }
    const RamMark *find(int field) const;
    std::vector<int> set() const;  ///< not lost, by address
    std::vector<int> lost() const; ///< in the order in which they were set

    /// As they are read now; of those that weren't read there is none.
    std::vector<SetReading> readings(const ControlTable &table, std::span<const PollValue> values) const;
    /// It has restarted: what doesn't hold its value any more is lost. How many that are.
    int restarted(const ControlTable &table, std::span<const PollValue> values);
    /// It runs on: what doesn't hold its value any more was written by somebody else. True where a mark went.
    bool dropChanged(const ControlTable &table, std::span<const PollValue> values);
    void recovered(int field); ///< it holds its value again
    bool dropLost(); ///< nobody wants them back

private:
    void written(const Field &field, int index, std::int64_t raw, std::optional<std::int64_t> before, qint64 number);

    std::map<int, RamMark> m_marks;
};

} // namespace dynascope
