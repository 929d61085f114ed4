// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/record/mcapformat.h"
#include "core/record/valuelayout.h"

/// What a recording says of itself in an MCAP file, both ways. What is read may be anything: nothing comes back where
/// it makes no sense.
namespace dynascope::mcap {

constexpr const char16_t *RecordingName = u"dynascope.recording"; ///< of the metadata records
constexpr const char16_t *DeviceName = u"dynascope.device";
constexpr const char16_t *EventsTopic = u"/events";

Texts textsOf(const RecordingHeader &header); ///< without its devices
std::optional<RecordingHeader> headerFrom(const Texts &texts);

Texts textsOf(const RecordedDevice &device); ///< without its fields: they are the channels'
std::optional<RecordedDevice> deviceFrom(const Texts &texts);

Texts textsOf(const ValueLayout &layout); ///< of a channel
std::optional<ValueLayout> layoutFrom(const Texts &texts);

Bytes messageOf(const RecordedEvent &event);
std::optional<RecordedEvent> eventFrom(ByteView message); ///< without its time

} // namespace dynascope::mcap
