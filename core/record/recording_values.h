// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/poll_values.h"

#include <QStringList>

/// What a recording holds, as values; any thread.
namespace dynascope {

/// A register that is recorded, with all that makes a physical value of its raw one: whoever reads a recording has no
/// control tables.
struct RecordedField {
    QString name; ///< the manufacturer's
    std::uint16_t address = 0;
    std::uint8_t size = 1; ///< 1, 2 or 4 bytes
    bool isSigned = false;
    int directionBit = -1; ///< as Field::directionBit
    QString unit;          ///< for programs: "deg"; empty for bare numbers
    double scale = 1.0;    ///< physical = raw (negative where the direction bit says so) × scale; never 0
    int decimals = 0;      ///< as many as tell neighbouring raw values apart

    int end() const { return address + size; }
    friend bool operator==(const RecordedField &, const RecordedField &) = default;
};

/// Registers as they were at one time.
struct RecordedSpan {
    std::uint16_t address = 0;
    Bytes data;

    friend bool operator==(const RecordedSpan &, const RecordedSpan &) = default;
};

struct RecordedDevice {
    quint32 key = 0; ///< PollValue::device
    QString label;   ///< what its columns and topics are called: "ID 1", or its nickname
    QString line;    ///< "/dev/ttyUSB0"
    int id = 0;
    int baudRate = 0;
    QString model; ///< "XM430-W350"
    int modelNumber = 0;
    int firmware = 0;
    std::vector<RecordedSpan> image;   ///< its whole control table, as far as it was read
    std::vector<RecordedField> fields; ///< what is recorded of it; two never the same

    friend bool operator==(const RecordedDevice &, const RecordedDevice &) = default;
};

struct RecordingHeader {
    qint64 startUnix = 0; ///< ns since 1970, UTC, when the line's clock said `startLine`
    LineTime startLine{};
    QString program; ///< that wrote it: "Dynascope 0.1.0"
    QString name;    ///< of the robot, or the port
    QString notes;
    std::vector<RecordedDevice> devices;

    qint64 unixTime(LineTime at) const { return startUnix + (at - startLine).count(); }
    LineTime lineTime(qint64 unixNs) const { return startLine + LineTime(unixNs - startUnix); }
    const RecordedDevice *device(quint32 key) const
    {
        for (const RecordedDevice &one : devices) {
            if (one.key == key)
                return &one;
        }
        return nullptr;
    }
};

/// Something that happened: "reboot", "alert", "torque", "write", "note".
struct RecordedEvent {
    LineTime at{};
    QString kind;
    QString text;

    friend bool operator==(const RecordedEvent &, const RecordedEvent &) = default;
};

/// What one reply brought, or that none came.
struct RecordedReply {
    quint32 device = 0;
    std::uint16_t address = 0;
    std::uint16_t length = 0; ///< as asked for
    Bytes data;               ///< empty: asked, did not come. Of what isn't recorded it may hold zeros
    LineTime at{};

    friend bool operator==(const RecordedReply &, const RecordedReply &) = default;
};

/// What one poll cycle brought.
struct RecordedBatch {
    std::uint32_t cycle = 0; ///< counts on, and begins anew beyond 2³²
    LineTime begin{};
    std::vector<RecordedReply> replies;

    friend bool operator==(const RecordedBatch &, const RecordedBatch &) = default;
};

} // namespace dynascope
