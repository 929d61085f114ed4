// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/record/recording_values.h"

namespace dynascope {

/// A batch as JSON, as PlotJuggler's UDP server and others take it: {"timestamp": seconds since 1970, "ID 1": {"Present
/// Position": 180.04}}, in the units of the recording. What did not come is left out. Empty where nothing came. More
/// than `limit` bytes become several objects.
QByteArrayList jsonSamples(const RecordedBatch &batch, const RecordingHeader &header, qsizetype limit);

} // namespace dynascope
