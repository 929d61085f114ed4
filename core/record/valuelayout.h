// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/record/recording_values.h"

namespace dynascope {

/// How the replies of some devices to the same question stand in one message of an MCAP file: a ROS 2 message of
/// physical values, a part for each device, so that PlotJuggler and Foxglove plot them as they are. A single-precision
/// number holds what registers of one and two bytes hold, a double what those of four do: the raw value comes back
/// exactly. A reply that did not come is one of NaNs, at which those programs break the line; its time is in whole
/// microseconds from the begin of the cycle.
class ValueLayout
{
public:
    struct Part {
        quint32 device = 0;
        QString member; ///< what it is called in the message; a ROS name
        std::vector<RecordedField> fields;
    };

    ValueLayout(std::uint16_t address, std::uint16_t length, std::vector<Part> parts);

    std::uint16_t address() const { return m_address; } ///< of the registers that were asked for
    std::uint16_t length() const { return m_length; }
    const std::vector<Part> &parts() const { return m_parts; }

    QString definition() const; ///< as a .msg file, with those of its parts behind it
    /// Replaces `message`. One reply for each part, in their order.
    void encode(const std::vector<const RecordedReply *> &replies, LineTime begin, Bytes &message) const;
    /// Appends a reply for each part. False: the message is no such one.
    bool decode(ByteView message, LineTime begin, std::vector<RecordedReply> &replies) const;

private:
    void put(const Part &part, std::size_t first, const RecordedReply &reply, Bytes &message) const;

    std::uint16_t m_address, m_length;
    std::vector<Part> m_parts;
    std::vector<std::size_t> m_offsets; ///< in the message: of each part's time, then of its fields
    std::size_t m_size = 0;             ///< of the message
};

/// As ROS has names: lower-case letters, digits, single underscores; never empty.
QString rosName(QStringView name);

} // namespace dynascope
