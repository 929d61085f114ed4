// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/record/recording_values.h"

namespace dynascope {

class ControlTable;
struct EffectiveField;
struct Field;

/// What is recorded of `field`; `effective` is its meaning now.
RecordedField recordedField(const Field &field, const EffectiveField &effective, int resolution);

/// Its raw value in registers that begin at `address`; nothing where they don't hold all of it.
std::optional<std::int64_t> recordedRaw(const RecordedField &field, int address, ByteView registers);
void putRaw(const RecordedField &field, int address, std::int64_t raw, std::span<std::uint8_t> registers);

/// In the field's unit; a direction bit beside a zero makes −0.
double physicalValue(const RecordedField &field, std::int64_t raw);
/// The raw value that physicalValue() made this of; the nearest one of any other number.
std::int64_t rawValue(const RecordedField &field, double physical);

/// With as many decimals as the field needs, a point, and no unit.
QByteArray physicalText(const RecordedField &field, std::int64_t raw);
/// "ID 1/Present Position [deg]".
QString columnTitle(const RecordedDevice &device, const RecordedField &field);

/// @name A field as one line of text, for a recording's header
/// @{
QString toLine(const RecordedField &field);
std::optional<RecordedField> fieldFromLine(QStringView line); ///< nothing where it makes no sense
/// @}

} // namespace dynascope
