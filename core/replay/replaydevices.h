// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/record/recording_values.h"
#include "core/session/session.h"
#include "core/session/watch.h"

namespace dynascope {

/// A recorded register and the one of a control table that it is.
struct ReplayField {
    RecordedField recorded;
    int field = 0; ///< index in the device's table
};

struct ReplayDevice {
    quint32 recorded = 0; ///< RecordedDevice::key
    DeviceKey key = 0;    ///< in the session
    std::vector<ReplayField> fields; ///< by address
};

/// The devices of a recording, and as which they stand in a session.
struct ReplayDevices {
    std::vector<ReplayDevice> devices;
    int unplaced = 0; ///< recorded registers that no control table here has

    const ReplayDevice *find(quint32 recorded) const;
    static constexpr std::size_t Most = 2000;
    static constexpr std::size_t MostLines = 32; ///< each is a thread
};

/// Opens the recording's lines in `session`, which knows no others, and puts its devices on them, with what is known of
/// all their registers from its header. GUI thread. BadFile: more devices or lines than there can be.
Result<ReplayDevices> addDevices(Session &session, const RecordingHeader &header);

/// A raw value as a history has it, of bytes as a servo has them, and back. `registers` begin at `address`.
std::optional<std::int32_t> countedRaw(const RecordedField &field, int address, ByteView registers);
Bytes countedBytes(const RecordedField &field, std::int32_t counted);

} // namespace dynascope
