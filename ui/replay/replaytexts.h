// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/poll_values.h"

namespace dynascope {

class Replayer;

/// A time from a recording's begin: "0:07.250", "1:02:07.250".
QString replayTimeText(LineTime time);
/// "½×", "1×", "10×".
QString speedText(double speed);
/// What a recording is, in one line: of what, from when, how much, and what is wrong with it.
QString recordingText(const Replayer &replayer);

} // namespace dynascope
