// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>
#include <QStringList>

#include <cstdint>
#include <optional>
#include <vector>

namespace dynascope {

enum class Area {
    Eeprom,
    Ram,
    Hybrid, ///< RAM that the device stores on request (Hybrid Save, Y series)
    Unknown,
};
enum class Access {
    Read,
    ReadWrite,
    Unknown, ///< may be read; a person may try to write it, the program never does by itself
};

/// What a number in the register measures; decides the editor and the plot axis.
enum class Unit {
    None,
    Pulse,          ///< of position; 360° / ControlTable::resolution
    Degree,
    RevPerMin,
    RevPerMin2,
    MilliAmpere,
    Ampere,
    Percent,
    Volt,
    Celsius,
    Microsecond,
    Millisecond,
    MilliVoltPerMs,
    Hertz,
    PulsePerSec,
    PulsePerMs,
};

/// A limit: a number, or another register of the same table, perhaps with its sign turned.
struct Bound {
    std::optional<std::int64_t> number;
    QString reg; ///< name of a register; empty where `number` holds
    bool negated = false;

    bool isSet() const { return number.has_value() || !reg.isEmpty(); }
    friend bool operator==(const Bound &, const Bound &) = default;
};

/// One named value of an enumerated register.
struct EnumValue {
    std::int64_t value = 0;
    QString text;
};

/// One bit, or a group of neighbouring bits, of a register.
struct BitField {
    int first = 0; ///< lowest bit
    int count = 1;
    QString name;
    std::vector<EnumValue> values; ///< what the group's values mean; may be empty for one bit

    std::int64_t mask() const { return ((std::int64_t(1) << count) - 1) << first; }
};

/// What a field becomes while another register has a value: "ms instead of rev/min while Drive Mode bit 2 is set".
struct Alternate {
    QString reg;                          ///< the deciding register
    std::uint32_t mask = 0xFFFFFFFF;      ///< bits of it that count
    std::vector<std::int64_t> values;     ///< any of these, after the mask
    Bound minimum, maximum;
    Unit unit = Unit::None;
    double scale = 1.0;
    int directionBit = -1;                ///< as Field::directionBit
};

/// Registers that say how many turns of the motor make one turn as it is counted.
struct GearRatio {
    QString numerator, denominator;
    double initialTurns = 1; ///< denominator / numerator of a device fresh from the factory

    bool isSet() const { return !numerator.isEmpty(); }
};

/// One entry of a control table. Immutable once loaded.
struct Field {
    std::uint16_t address = 0;
    std::uint8_t size = 1; ///< 1, 2 or 4 bytes
    bool isSigned = false; ///< two's complement at this size
    QString name;          ///< the manufacturer's
    Area area = Area::Ram;
    Access access = Access::Read;
    std::optional<std::int64_t> initial;
    Bound minimum, maximum;
    Unit unit = Unit::None;
    double scale = 1.0;    ///< physical = raw × scale, in `unit`
    int directionBit = -1; ///< set: clockwise, which is negative, by what the bits below say; −1: no such bit
    GearRatio gearRatio;   ///< of a position in pulses, where its model has one
    double torqueConstant = 0; ///< of a current: Nm for one raw step; 0: not stated
    std::vector<EnumValue> values;  ///< not empty: the only values allowed
    std::vector<EnumValue> special; ///< names of single values among ordinary numbers: "0 is Off"
    std::vector<BitField> bits;
    std::vector<Alternate> alternates;
    QStringList resets;    ///< registers that a write here puts back to other values
    bool torqueOff = false; ///< outside the EEPROM, too, written only while torque is off
    QString help;          ///< one or two sentences
    QString doubt;         ///< what is uncertain about this entry, a sentence; empty: nothing
    QString suggested;     ///< of a byte in the table of an unknown model: the register that its neighbours have here
    bool isWritable() const { return access == Access::ReadWrite; }
    bool mayBeTried() const { return access == Access::Unknown; } ///< a person may write it, told what isn't known
    bool needsTorqueOff() const { return isWritable() && (area == Area::Eeprom || torqueOff); }
    int end() const { return address + size; }
};

} // namespace dynascope
