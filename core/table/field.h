// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>
#include <QStringList>

#include <cstdint>
#include <optional>
#include <vector>

namespace dynascope {

enum class Area { Eeprom, Ram, Hybrid };
enum class Access { Read, ReadWrite };

/// What a number in the register measures; decides the editor and the plot axis.
enum class Unit {
    None,
    Pulse,          ///< of position; 360° / ControlTable::resolution
    RevPerMin,
    RevPerMin2,
    MilliAmpere,
    Percent,
    Volt,
    Celsius,
    Microsecond,
    Millisecond,
    MilliVoltPerMs,
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
};

/// What a field becomes while another register has a value: "ms instead of rev/min while Drive Mode bit 2 is set".
struct Alternate {
    QString reg;                          ///< the deciding register
    std::uint32_t mask = 0xFFFFFFFF;      ///< bits of it that count
    std::vector<std::int64_t> values;     ///< any of these, after the mask
    Bound minimum, maximum;
    Unit unit = Unit::None;
    double scale = 1.0;
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
    std::vector<EnumValue> values;  ///< not empty: the only values allowed
    std::vector<EnumValue> special; ///< names of single values among ordinary numbers: "0 is Off"
    std::vector<BitField> bits;
    std::vector<Alternate> alternates;
    QStringList resets;    ///< registers that a write here puts back to other values
    QString help;          ///< one or two sentences

    bool isWritable() const { return access == Access::ReadWrite; }
    bool needsTorqueOff() const { return area == Area::Eeprom && isWritable(); }
    int end() const { return address + size; }
};

} // namespace dynascope
