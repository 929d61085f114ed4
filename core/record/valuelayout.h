// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/record/recording_values.h"

namespace dynascope {

/// How the fields that one reply brings stand in a message of an MCAP file: a ROS 2 message of physical values, so that
/// PlotJuggler and Foxglove plot them as they are. A single-precision number holds what registers of one and two bytes
/// hold, a double what those of four do: the raw value comes back exactly. A reply that did not come is one of NaNs,
/// at which those programs break the line.
class ValueLayout
{
public:
    ValueLayout(std::uint16_t address, std::uint16_t length, std::vector<RecordedField> fields);

    std::uint16_t address() const { return m_address; } ///< of the registers that were asked for
    std::uint16_t length() const { return m_length; }
    const std::vector<RecordedField> &fields() const { return m_fields; }

    QString definition() const; ///< as a .msg file
    /// Replaces `message`. `registers` begin at address(); none: asked, did not come.
    void encode(ByteView registers, Bytes &message) const;
    /// Replaces `registers`; empty where none came. False: the message is no such one.
    bool decode(ByteView message, Bytes &registers) const;

private:
    std::uint16_t m_address, m_length;
    std::vector<RecordedField> m_fields;
    std::vector<std::size_t> m_offsets; ///< of each field in the message
    std::size_t m_size = 0;             ///< of the message
};

/// As ROS has names: lower-case letters, digits, single underscores; never empty.
QString rosName(QStringView name);

} // namespace dynascope
