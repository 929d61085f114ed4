// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/result.h"
#include "core/sim/linefaults.h"

#include <QStringList>

namespace dynascope::sim {

/// How people write the faults of a line, on the command line, in a bus file and to a control channel: words, separated
/// by spaces, each NAME[:IDS][=VALUE][@SHARE][*TIMES], as in "echo latency=16ms drop:3=0.02 late=20ms@0.1". What the
/// words are faultHelp() tells. A later word of the same fault replaces nothing: both hold; single settings (latency,
/// echo, noise) take the latest.
Result<LineFaults> parseFaults(QStringView text, LineFaults onTopOf = {});

/// One line each: a word, what it does.
QStringList faultHelp();

/// "16ms", "250us", "1.5s"; 0 to one hour. Also for other languages of the simulator.
std::optional<LineTime> parseDuration(QStringView text);

} // namespace dynascope::sim
